"""K_b of a part by CalculiX on the same mesh: its end nodes moved as rigid faces, the reactions summed to a wrench."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np

from fem.anisotropic import Orthotropic, Regional
from fem.material import Isotropic
from fem.part_bar import PartBar
from fem.rigid_motions import rigid_motions
from meshes.solid import Floats

CCX = shutil.which("ccx")
TYPES = {"tetra10": "C3D10", "wedge15": "C3D15", "hexahedron20": "C3D20"}


def stiffness(bar: PartBar, folder: Path) -> Floats:
    """(6, 6) at the tip point, N, mm, rad."""
    (folder / "part.inp").write_text(deck(bar), encoding="utf-8")
    subprocess.run([str(CCX), "part"], cwd=folder, check=True, capture_output=True, timeout=300)
    text = (folder / "part.dat").read_text(encoding="utf-8")
    blocks = re.split(r"forces \(fx,fy,fz\) for set TIP.*\n", text)[1:]
    assert len(blocks) == 6
    point = np.array([bar.length, 0.0, 0.0])
    columns = []
    for block in blocks:
        rows = [line.split() for line in block.splitlines() if re.match(r"\s*\d+\s", line)]
        found = np.array([[float(x) for x in row] for row in rows])
        arms = bar.mesh.points[found[:, 0].astype(int) - 1] - point
        columns.append(np.concatenate((found[:, 1:].sum(axis=0), np.cross(arms, found[:, 1:]).sum(axis=0))))
    return np.stack(columns, axis=1)


def deck(bar: PartBar) -> str:
    """The part with six steps, a unit motion of the tip in each."""
    mesh = bar.mesh
    lines = ["*NODE"]
    # It reads twenty characters of a number, without the end of a longer one.
    places = np.round(mesh.points, 10)
    lines += [f"{n},{x:.13g},{y:.13g},{z:.13g}" for n, (x, y, z) in enumerate(places, 1)]
    start = 1
    regions: dict[int, list[int]] = {}
    for kind, cells in mesh.blocks:
        lines.append(f"*ELEMENT,TYPE={TYPES[kind]}")
        for cell in cells + 1:
            numbers = [str(start), *map(str, cell)]
            lines += [",".join(numbers[:11]) + ("," if len(numbers) > 11 else "")]
            lines += [",".join(numbers[11:])] if len(numbers) > 11 else []
            regions.setdefault(int(mesh.region_of[start - 1]), []).append(start)
            start += 1
    lines += _materials(bar, regions)
    for name in ("BASE", "TIP"):
        lines += [f"*NSET,NSET={name}", *(f"{n + 1}," for n in mesh.face_nodes(name.lower()))]
    tip = mesh.face_nodes("tip")
    arms = mesh.points[tip] - np.array([bar.length, 0.0, 0.0])
    motions = rigid_motions(arms).reshape(-1, 3, 6)
    for j in range(6):
        lines += ["*STEP", "*STATIC", "*BOUNDARY,OP=NEW", "BASE,1,3"]
        lines += [
            f"{n + 1},{a + 1},{a + 1},{motions[k, a, j]:.12g}" for k, n in enumerate(tip) for a in range(3)
        ]
        lines += ["*NODE PRINT,NSET=TIP", "RF", "*END STEP"]
    return "\n".join(lines) + "\n"


def _materials(bar: PartBar, regions: dict[int, list[int]]) -> list[str]:
    law = bar.material
    every = law.materials if isinstance(law, Regional) else (law,)
    lines = []
    for region, numbers in regions.items():
        material = every[region if len(every) > 1 else 0]
        lines += [f"*ELSET,ELSET=R{region}", *(f"{n}," for n in numbers), f"*MATERIAL,NAME=M{region}"]
        turned = ""
        if isinstance(material, Isotropic):
            lines += ["*ELASTIC", f"{material.E},{material.nu}"]
        else:
            lines += _engineering(material)
            turned = f",ORIENTATION=O{region}"
            axes = np.array(material.axes)
            lines += [f"*ORIENTATION,NAME=O{region}", ",".join(f"{v:.12g}" for v in (*axes[0], *axes[1]))]
        lines.append(f"*SOLID SECTION,ELSET=R{region},MATERIAL=M{region}{turned}")
    return lines


def _engineering(m: Orthotropic) -> list[str]:
    first = (m.E1, m.E2, m.E3, m.nu12, m.nu13, m.nu23, m.G12, m.G13)
    return ["*ELASTIC,TYPE=ENGINEERING CONSTANTS", ",".join(f"{v:.12g}" for v in first), f"{m.G23:.12g}"]
