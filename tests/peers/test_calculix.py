"""K_b of bar P by CalculiX (G. Dhondt, http://www.calculix.de) on the very same mesh of 20-node hexahedra.

Six static steps, each with the nodes of the tip face moved by one unit rigid motion and the base face held. The
reactions of the tip nodes, summed to a wrench about its middle, are a column of K_b: nothing but a displacement
boundary condition is asked of CalculiX, no coupling. Its .dat file carries seven digits.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from fem.virtual_experiments import rigid_motions
from meshes.solid import SolidMesh
from tests.fem import bar_p

CCX = shutil.which("ccx")
pytestmark = pytest.mark.skipif(CCX is None, reason="CalculiX (ccx) is not installed")


def numbers(nodes: np.ndarray) -> str:
    """Node numbers from 1, sixteen a line."""
    return "\n".join(",".join(str(n + 1) for n in nodes[i : i + 16]) for i in range(0, len(nodes), 16))


def deck(mesh: SolidMesh, tip: np.ndarray, motions: np.ndarray) -> str:
    """CalculiX's input: C3D20 with full integration, like ours. It reads twenty characters of a number, no more."""
    lines = ["*NODE"]
    lines += [f"{n},{x:.12g},{y:.12g},{z:.12g}" for n, (x, y, z) in enumerate(mesh.points, 1)]
    lines += ["*ELEMENT, TYPE=C3D20, ELSET=BODY"]
    for e, cell in enumerate(mesh.cells, 1):
        text = [str(n + 1) for n in cell]
        lines += [f"{e},{','.join(text[:10])},", ",".join(text[10:])]
    lines += ["*NSET, NSET=TIP", numbers(tip), "*NSET, NSET=BASE", numbers(mesh.face_nodes("base"))]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", f"{bar_p.MATERIAL.E},{bar_p.MATERIAL.nu}"]
    lines += ["*SOLID SECTION, ELSET=BODY, MATERIAL=M", "*BOUNDARY", "BASE,1,3"]
    for motion in motions.T:
        lines += ["*STEP", "*STATIC", "*BOUNDARY"]
        for node, u in zip(tip, motion.reshape(-1, 3), strict=True):
            lines += [f"{node + 1},{a + 1},{a + 1},{u[a]:.12g}" for a in range(3)]
        lines += ["*NODE PRINT, NSET=TIP", "RF", "*END STEP"]
    return "\n".join(lines) + "\n"


def reactions(text: str, count: int) -> np.ndarray:
    """(steps, nodes, 3) of the .dat file, nodes in rising order."""
    rows = [line.split() for line in text.splitlines()]
    values = [[float(v) for v in row] for row in rows if len(row) == 4 and row[0].isdigit()]
    table = np.array(values).reshape(-1, count, 4)
    assert np.all(np.diff(table[:, :, 0], axis=1) > 0)
    return table[:, :, 1:]


def test_bar_stiffness(coarse: SolidMesh, tmp_path: Path) -> None:
    tip = coarse.face_nodes("tip")
    motions = rigid_motions(coarse.points[tip] - np.array([bar_p.LENGTH, 0.0, 0.0]))
    (tmp_path / "bar.inp").write_text(deck(coarse, tip, motions))
    assert CCX is not None
    run = subprocess.run(
        [CCX, "-i", "bar"], cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False
    )
    assert run.returncode == 0, run.stdout[-2000:]
    found = reactions((tmp_path / "bar.dat").read_text(), len(tip))
    assert len(found) == 6
    theirs = np.stack([motions.T @ forces.ravel() for forces in found], axis=1)
    ours = bar_p.model(1).stiffness
    np.testing.assert_allclose(bar_p.entries(theirs), bar_p.entries(ours), rtol=1e-5)
    # Entries that vanish by symmetry do so in both, beside the diagonal.
    assert np.abs(theirs - ours).max() < 1e-5 * ours.max()
    root = np.sqrt(np.diag(ours))
    assert np.abs((theirs - ours) / np.outer(root, root)).max() < 1e-4


@pytest.fixture(scope="module")
def coarse() -> SolidMesh:
    return bar_p.mesh(1)
