"""Decks for CalculiX (G. Dhondt, http://www.calculix.de) on our own meshes of 20-node hexahedra, and its answers.

C3D20 has full integration, like ours. CalculiX reads twenty characters of a number, no more, and its .dat file
carries seven digits.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from fem.material import Isotropic
from meshes.solid import Floats, Ints, SolidMesh

CCX = shutil.which("ccx")
COORDINATES = tuple((node, axis) for node in (1, 2) for axis in (1, 2, 3))


def numbers(nodes: Ints) -> str:
    """Node numbers from 1, sixteen a line."""
    return "\n".join(",".join(str(n + 1) for n in nodes[i : i + 16]) for i in range(0, len(nodes), 16))


def model(mesh: SolidMesh, material: Isotropic) -> list[str]:
    """Nodes, cells, sets TIP and BASE, material, base held."""
    lines = ["*NODE"]
    lines += [f"{n},{x:.12g},{y:.12g},{z:.12g}" for n, (x, y, z) in enumerate(mesh.points, 1)]
    lines += ["*ELEMENT, TYPE=C3D20, ELSET=BODY"]
    for e, cell in enumerate(mesh.cells, 1):
        text = [str(n + 1) for n in cell]
        lines += [f"{e},{','.join(text[:10])},", ",".join(text[10:])]
    lines += ["*NSET, NSET=TIP", numbers(mesh.face_nodes("tip"))]
    lines += ["*NSET, NSET=BASE", numbers(mesh.face_nodes("base"))]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", f"{material.E},{material.nu}", "*DENSITY", "2.7e-9"]
    return [*lines, "*SOLID SECTION, ELSET=BODY, MATERIAL=M", "*BOUNDARY", "BASE,1,3"]


def rigid_tip(mesh: SolidMesh, length: float) -> list[str]:
    """The tip face as CalculiX's rigid body about its middle: nodes n + 1 (displacement), n + 2 (rotation), set REF."""
    first = len(mesh.points) + 1
    return [
        "*NODE, NSET=REF",
        *(f"{n},{length:.12g},0.,0." for n in (first, first + 1)),
        f"*RIGID BODY, NSET=TIP, REF NODE={first}, ROT NODE={first + 1}",
    ]


def moved_tip(mesh: SolidMesh, motions: Floats) -> list[str]:
    """A static step for each column of `motions`, (3 tip nodes, c): the tip's nodes moved, its reactions printed."""
    lines = []
    for motion in motions.T:
        lines += ["*STEP", "*STATIC", "*BOUNDARY"]
        for node, u in zip(mesh.face_nodes("tip"), motion.reshape(-1, 3), strict=True):
            lines += [f"{node + 1},{a + 1},{a + 1},{u[a]:.12g}" for a in range(3)]
        lines += ["*NODE PRINT, NSET=TIP", "RF", "*END STEP"]
    return lines


def unit_loads(mesh: SolidMesh, one_step: bool) -> list[str]:
    """Six unit wrenches on the rigid tip: one *GREEN step (one factorisation), or six static steps."""
    count = len(mesh.points)
    loads = [f"{count + node},{axis},1." for node, axis in COORDINATES]
    if one_step:
        return ["*STEP", "*GREEN", "*CLOAD", *loads, "*NODE PRINT, NSET=REF", "U", "*END STEP"]
    lines = []
    for load in loads:
        lines += ["*STEP", "*STATIC", "*CLOAD, OP=NEW", load, "*NODE PRINT, NSET=REF", "U", "*END STEP"]
    return lines


def run(deck: Sequence[str], folder: Path, threads: int = 1, seconds: float = 120.0) -> Path:
    """Run CalculiX on a deck in a folder; the path of its .dat file. Fails with its last words."""
    (folder / "job.inp").write_text("\n".join(deck) + "\n")
    assert CCX is not None
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    done = subprocess.run(
        [CCX, "-i", "job"],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=seconds,
        check=False,
        env=environment,
    )
    assert done.returncode == 0, done.stdout[-2000:]
    return folder / "job.dat"


def nodal(text: str, count: int) -> Floats:
    """(steps, nodes, 3) of a .dat file's nodal tables, nodes in rising order."""
    rows = [line.split() for line in text.splitlines()]
    values = [[float(v) for v in row] for row in rows if len(row) == 4 and row[0].isdigit()]
    table = np.array(values).reshape(-1, count, 4)
    assert np.all(np.diff(table[:, :, 0], axis=1) > 0)
    return table[:, :, 1:]


def stiffness_of_unit_loads(text: str) -> Floats:
    """(6, 6) stiffness from the motions of the rigid tip under six unit wrenches."""
    compliance = nodal(text, 2).reshape(6, 6)
    return np.asarray(np.linalg.inv(0.5 * (compliance + compliance.T)))


def buckling_factors(text: str) -> Floats:
    """The load factors of a *BUCKLE step."""
    rows = [line.split() for line in text[text.index("B U C K L I N G") :].splitlines()]
    return np.array([float(row[1]) for row in rows if len(row) == 2 and row[0].isdigit()])
