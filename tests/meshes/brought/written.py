"""Mesh files of one part in every format, written here and by other programs' own libraries."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from meshes.brought.raw import Raw

ABAQUS = {"tetra": "C3D4", "tetra10": "C3D10", "wedge": "C3D6", "wedge15": "C3D15"}
ABAQUS |= {"hexahedron": "C3D8", "hexahedron20": "C3D20"}
VTK = {"tetra": 10, "tetra10": 24, "wedge": 13, "wedge15": 26, "hexahedron": 12, "hexahedron20": 25}
NASTRAN = {"tetra": "CTETRA", "wedge": "CPENTA", "hexahedron": "CHEXA"}


def inp(raw: Raw, path: Path, before: str = "", after: str = "") -> Path:
    """With a set of elements for each region, and one of the nodes at x = 0."""
    lines = ["** a part", "*HEADING", "a part", before, "*NODE, NSET=ALL"]
    lines += [f"{n + 10}, {x!r}, {y!r}, {z!r}" for n, (x, y, z) in enumerate(raw.points.tolist())]
    start = 1
    for kind, cells in raw.blocks:
        lines.append(f"*Element, type={ABAQUS[kind]}")
        for cell in cells:
            numbers = [str(start), *(str(n + 10) for n in cell)]
            lines += [", ".join(numbers[:9]) + ("," if len(numbers) > 9 else ""), ", ".join(numbers[9:])]
            start += 1
    for k, name in enumerate(raw.regions):
        members = np.flatnonzero(raw.region_of == k) + 1
        lines += [f"*ELSET, ELSET={name}", *(f"{m}," for m in members)]
        lines += [f"*SOLID SECTION, ELSET={name},", f"MATERIAL=M{k}"]
    lines += ["*NSET, NSET=foot", *(f"{n + 10}," for n in np.flatnonzero(raw.points[:, 0] < 1e-9))]
    lines += ["*MATERIAL, NAME=M0", "*ELASTIC", "70000, 0.33", after]
    path.write_text("\n".join(line for line in lines if line) + "\n")
    return path


def bdf(raw: Raw, path: Path, fields: str = "free", before: str = "") -> Path:
    """In free, small or large fields."""
    lines = ["SOL 101", "CEND", "BEGIN BULK", before]
    order = {
        "hexahedron20": [*range(12), 16, 17, 18, 19, 12, 13, 14, 15],
        "wedge15": [*range(9), 12, 13, 14, 9, 10, 11],
    }

    def put(name: str, values: list[str]) -> None:
        if fields == "free":
            for k in range(0, len(values), 8):
                lines.append(",".join([name if k == 0 else "+", *values[k : k + 8]]))
        elif fields == "small":
            for k in range(0, len(values), 8):
                lines.append(
                    (name if k == 0 else "+").ljust(8) + "".join(v.ljust(8) for v in values[k : k + 8])
                )
        else:
            for k in range(0, len(values), 4):
                lines.append(
                    (f"{name}*" if k == 0 else "*").ljust(8) + "".join(v.ljust(16) for v in values[k : k + 4])
                )

    for n, at in enumerate(raw.points.tolist()):
        put("GRID", [str(n + 1), "", *(f"{v:.3f}" if fields == "small" else f"{v:.9f}" for v in at)])
    start = 0
    for kind, cells in raw.blocks:
        for cell in cells:
            nodes = [str(n + 1) for n in cell[order.get(kind, range(len(cell)))]]
            name = NASTRAN[kind.rstrip("0125")]
            put(name, [str(start + 1), str(raw.region_of[start] + 1), *nodes])
            start += 1
    lines += ["PSOLID,1,1", "PSOLID,2,1", "MAT1,1,7.+4,,.33", "ENDDATA"]
    path.write_text("\n".join(line for line in lines if line) + "\n")
    return path


def vtu(raw: Raw, path: Path, text: bool = False) -> Path:
    """Compressed, or as text."""
    import pyvista

    cells, types = [], []
    for kind, own in raw.blocks:
        cells += [np.concatenate(([len(cell)], cell)) for cell in own]
        types += [VTK[kind]] * len(own)
    grid = pyvista.UnstructuredGrid(np.concatenate(cells), np.array(types), raw.points)
    grid.cell_data["region"] = raw.region_of
    if not text:
        grid.save(path)
        return path
    writer = pyvista._vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    writer.SetDataModeToAscii()
    writer.Write()
    return path
