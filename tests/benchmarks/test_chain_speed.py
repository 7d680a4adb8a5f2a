"""K_b of bar P by the chain of slices: seconds and peak memory of the whole process, and how exact it is for them.

Beside it the meshes of `test_fea_speed`, graded towards the ends, and CalculiX's *GREEN step on them. The best of three
runs counts. The table goes to results/benchmarks/.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from fem.convergence import extrapolate
from fem.slices.stiffness import chain_stiffness
from meshes.extrusion import stepped_thickness
from meshes.layers import as_sweep
from meshes.resolution import Resolution
from meshes.solid import Floats, SolidMesh
from meshes.store import mesh_bar
from tests.benchmarks.test_fea_speed import MESHES, OUT, REPEATS, measured, theirs, written
from tests.fem import bar_p
from tests.meshes.solids import section_sweep
from tests.peers import calculix

pytestmark = pytest.mark.long

GIB = 2.0**30
# Level, layers by thickness, part of the section; most seconds and GiB allowed.
UNIFORM = {
    "116k": (2, "105", "quarter", 2.0, 0.3),
    "475k": (4, "127", "quarter", 3.0, 0.3),
    "1014k": (6, "128", "quarter", 6.0, 0.5),
    "1014k, whole": (6, "128", "whole", 40.0, 2.5),
}
# A chain beside each graded mesh, and how many times faster than *GREEN there.
BESIDE = {"100k": (4, "8,8,16,16", 7.0), "300k": (6, "8,8,8,32", 15.0)}


@dataclass(frozen=True)
class Run:
    """Best of the repetitions: unknowns, seconds and bytes of the whole process, K_b."""

    unknowns: int
    seconds: float
    peak: float
    stiffness: Floats


def run(level: int, counts: str, part: str, folder: Path, threads: int = 1) -> Run:
    """Some processes of the chain."""
    command = [
        sys.executable,
        "-m",
        "tests.benchmarks.chain_stiffness",
        str(bar_p.SIZE),
        str(level),
        counts,
        part,
    ]
    runs = [measured(command, folder, threads) for _ in range(REPEATS)]
    said = json.loads(runs[0][2].splitlines()[-1])
    stiffness = np.array(said["stiffness"])
    return Run(said["unknowns"], min(r[0] for r in runs), max(r[1] for r in runs), stiffness)


def note(line: str) -> None:
    """A line of the table, printed and kept."""
    OUT.mkdir(parents=True, exist_ok=True)
    with (OUT / "chain_speed.txt").open("a") as file:
        file.write(line + "\n")
    print(line)


@pytest.mark.parametrize("name", UNIFORM)
def test_time_and_memory(name: str, tmp_path: Path) -> None:
    level, counts, part, seconds, gib = UNIFORM[name]
    found = run(level, counts, part, tmp_path)
    note(f"chain, {part}: {found.unknowns} unknowns, {found.seconds:.2f} s, {found.peak / GIB:.2f} GiB")
    assert found.unknowns == pytest.approx(1e3 * float(name.split("k")[0]), rel=5e-3)
    assert found.seconds < seconds
    assert found.peak < gib * GIB


@cache
def limit() -> Floats:
    """The eight entries without mesh error: levels 2, 4 and 8, steps of layers at the ends refined with them."""
    found = []
    for level in (2, 4, 8):
        thickness = stepped_thickness(bar_p.LENGTH, [4 * level] * 5)
        sweep = section_sweep(bar_p.SECTION, Resolution(bar_p.SIZE, level), thickness)
        found.append(bar_p.entries(chain_stiffness(sweep, bar_p.MATERIAL)))
    return np.array([extrapolate([1 / 2, 1 / 4, 1 / 8], values).limit for values in np.transpose(found)])


@cache
def graded(name: str) -> SolidMesh:
    return mesh_bar(bar_p.BAR, MESHES[name])


@pytest.mark.parametrize("name", BESIDE)
def test_at_least_as_exact_as_the_graded_mesh(name: str, tmp_path: Path) -> None:
    """In every entry; the graded mesh's K_b by a chain too, of layers that all differ."""
    level, counts, _ = BESIDE[name]
    mine = run(level, counts, "quarter", tmp_path)
    errors = np.abs(bar_p.entries(mine.stiffness) / limit() - 1.0)
    theirs_ = bar_p.entries(chain_stiffness(as_sweep(graded(name)).sweep, bar_p.MATERIAL))
    there = np.abs(theirs_ / limit() - 1.0)
    note(f"{name} graded, {graded(name).dofs} unknowns: errors {np.array2string(there, precision=2)}")
    note(f"{name} chain, {mine.unknowns} unknowns: errors {np.array2string(errors, precision=2)}")
    assert np.all(errors <= there)


@pytest.mark.skipif(calculix.CCX is None, reason="CalculiX (ccx) is not installed")
@pytest.mark.parametrize("name", BESIDE)
def test_faster_than_calculix(name: str, tmp_path: Path) -> None:
    """Whole process against whole process, each with two threads."""
    level, counts, wanted = BESIDE[name]
    written(graded(name), tmp_path)
    green, _ = theirs(graded(name), tmp_path, 2, True)
    mine = run(level, counts, "quarter", tmp_path, 2)
    note(
        f"{name}: *GREEN {green.process_seconds:.1f} s, {green.peak_gib:.2f} GiB; chain {mine.seconds:.2f} s, "
        f"{mine.peak / GIB:.2f} GiB: {green.process_seconds / mine.seconds:.1f} times faster"
    )
    assert green.process_seconds / mine.seconds > wanted


def test_the_size_is_that_of_the_benchmark() -> None:
    assert bar_p.SIZE == 6.0 and MESHES["300k"] == Resolution(7.2, 6)
