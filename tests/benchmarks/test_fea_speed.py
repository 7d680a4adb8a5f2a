"""K_b of bar P on one mesh of 20-node hexahedra: this program and CalculiX, time and peak memory, in one run.

CalculiX's fair best is its *GREEN step (one factorisation, six right-hand sides); six static steps factorise six
times. Both clocks cover the whole process, ours with Python's start and its imports. The runs of both alternate and the
best of three counts: other work on the machine hits both.
The table goes to results/benchmarks/.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from meshes.resolution import Resolution
from meshes.solid import SolidMesh
from meshes.store import mesh_bar
from tests.conftest import ROOT
from tests.fem import bar_p
from tests.peers import calculix

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(calculix.CCX is None, reason="CalculiX (ccx) is not installed"),
]

# Element size in mm and refinement of meshes of about 20k, 100k and 300k unknowns.
MESHES = {"20k": Resolution(6.0, 2), "100k": Resolution(6.2, 4), "300k": Resolution(7.2, 6)}
# How many times faster than *GREEN and than six static steps, with all cores. Not reached on two of them yet: 0.95,
# 1.56 and 3.05 were measured of the first.
WANTED = {"20k": (1.0, 5.0), "100k": (2.3, 5.0), "300k": (4.0, 5.0)}
MEMORY_LIMIT = 4 * 2**30
REPEATS = 3
OUT = ROOT / "results" / "benchmarks"


@dataclass(frozen=True)
class Timing:
    """Best of the repetitions: seconds as compared, of the whole process, and peak resident memory."""

    program: str
    unknowns: int
    threads: int
    seconds: float
    process_seconds: float
    peak_gib: float


def measured(command: list[str], folder: Path, threads: int) -> tuple[float, float, str]:
    """Seconds, peak bytes and output of a child process."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    environment |= {"OMP_NUM_THREADS": str(threads), "MKL_NUM_THREADS": str(threads)}
    out = folder / "out.txt"
    with out.open("w") as file:
        start = time.perf_counter()
        child = subprocess.Popen(command, cwd=folder, stdout=file, stderr=subprocess.STDOUT, env=environment)
        _, status, usage = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0, out.read_text()[-2000:]
    return seconds, usage.ru_maxrss * 1024.0, out.read_text()


def ours(mesh: SolidMesh, folder: Path, threads: int) -> tuple[Timing, np.ndarray]:
    """One run of this program."""
    command = [sys.executable, "-m", "tests.benchmarks.one_bar_stiffness", "mesh.npz", "automatic"]
    whole, peak, text = measured(command, folder, threads)
    said = json.loads(text.splitlines()[-1])
    timing = Timing("parastiff", mesh.dofs, threads, said["seconds"], whole, peak / 2**30)
    return timing, np.array(said["stiffness"])


def theirs(mesh: SolidMesh, folder: Path, threads: int, green: bool) -> tuple[Timing, np.ndarray]:
    """One run of CalculiX."""
    name = "green" if green else "static"
    assert calculix.CCX is not None
    whole, peak, _ = measured([calculix.CCX, "-i", name], folder, threads)
    found = calculix.stiffness_of_unit_loads((folder / f"{name}.dat").read_text())
    program = "CalculiX *GREEN" if green else "CalculiX, six static steps"
    return Timing(program, mesh.dofs, threads, whole, whole, peak / 2**30), found


def written(mesh: SolidMesh, folder: Path) -> None:
    """The mesh for us and the two decks for CalculiX."""
    np.savez(folder / "mesh.npz", points=mesh.points, cells=mesh.cells, **mesh.faces)
    for name, green in (("green", True), ("static", False)):
        deck = [
            *calculix.model(mesh, bar_p.MATERIAL),
            *calculix.rigid_tip(mesh, bar_p.LENGTH),
            *calculix.unit_loads(mesh, green),
        ]
        (folder / f"{name}.inp").write_text("\n".join(deck) + "\n")


def compared(mesh: SolidMesh, folder: Path, threads: int) -> list[Timing]:
    """Best timings of ours, *GREEN and six static steps; fails where the matrices differ."""
    written(mesh, folder)
    runs: dict[str, list[Timing]] = {}
    for repeat in range(REPEATS):
        timing, k = ours(mesh, folder, threads)
        runs.setdefault("ours", []).append(timing)
        for name, green in (("green", True), ("static", False)):
            if repeat and not green:
                continue  # once: it is far from close
            timing, other = theirs(mesh, folder, threads, green)
            runs.setdefault(name, []).append(timing)
            np.testing.assert_allclose(bar_p.entries(other), bar_p.entries(k), rtol=1e-4)
    return [min(r, key=lambda t: t.process_seconds) for r in runs.values()]


def table(timings: list[Timing]) -> str:
    """A line for each timing, with the growth of time and memory since the mesh before."""
    lines = [f"{'program':28} {'unknowns':>9} {'threads':>7} {'s':>8} {'process s':>9} {'GiB':>6}"]
    lines += [
        f"{t.program:28} {t.unknowns:9d} {t.threads:7d} {t.seconds:8.2f} {t.process_seconds:9.2f} {t.peak_gib:6.2f}"
        for t in timings
    ]
    for name in dict.fromkeys((t.program, t.threads) for t in timings):
        mine = [t for t in timings if (t.program, t.threads) == name]
        for a, b in pairwise(mine):
            grown = np.log(b.unknowns / a.unknowns)
            slow, big = np.log(b.seconds / a.seconds) / grown, np.log(b.peak_gib / a.peak_gib) / grown
            lines.append(
                f"{name[0]}, {name[1]} threads, {a.unknowns} to {b.unknowns}: time ~ n^{slow:.2f}, memory ~ n^{big:.2f}"
            )
    return "\n".join(lines)


@pytest.fixture(scope="module")
def timings(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Timing]]:
    """All runs with all cores, then with one thread as information; the table is written and printed."""
    found, single = {}, []
    cores = len(os.sched_getaffinity(0))
    for name, resolution in MESHES.items():
        mesh = mesh_bar(bar_p.BAR, resolution)
        folder = tmp_path_factory.mktemp(name)
        found[name] = compared(mesh, folder, cores)
        if cores > 1 and name != "300k":
            single += compared(mesh, folder, 1)
    everything = [t for group in found.values() for t in group] + single
    OUT.mkdir(parents=True, exist_ok=True)
    (OUT / "fea_speed.json").write_text(json.dumps([asdict(t) for t in everything], indent=1) + "\n")
    (OUT / "fea_speed.txt").write_text(table(everything) + "\n")
    print("\n" + table(everything))
    return found


@pytest.mark.parametrize("name", MESHES)
def test_faster_than_calculix(name: str, timings: dict[str, list[Timing]]) -> None:
    mine, green, static = timings[name]
    quicker, than_static = (each.process_seconds / mine.process_seconds for each in (green, static))
    print(f"{name}: {quicker:.2f} x *GREEN, {than_static:.1f} x static")
    assert quicker > WANTED[name][0]
    assert than_static > WANTED[name][1]


def test_memory(timings: dict[str, list[Timing]]) -> None:
    """Of the largest mesh; this process's own limit is far away."""
    mine = timings["300k"][0]
    assert mine.unknowns > 280_000
    assert mine.peak_gib * 2**30 < MEMORY_LIMIT
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 < MEMORY_LIMIT
