"""Mesh files of every format give the bar that was written; what a reader would have to drop is refused by name."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import gmsh
import numpy as np
import pytest

from fem.anisotropic import Regional
from fem.material import Isotropic
from fem.part_bar import PartBar
from meshes.brought import abaqus, nastran, vtu
from meshes.brought.abaqus import blocks
from meshes.brought.nastran import cards
from meshes.brought.raised import raised
from meshes.gmsh_session import session
from tests.meshes.brought import parts, written
from tests.meshes.brought.made import ALUMINIUM, bars, box, brought, difference, framed, plane

ENDS = (plane(0, 0, 0), plane(60, 0, 0))
STEEL = Isotropic(210e3, 0.3)


def stiff(path: Path, unit: str = "mm", ends: tuple[Any, Any] = ENDS) -> Any:
    """K_b of a file whose second region, in the order of their names, is of steel."""
    it = brought(path, *ends, unit=unit)
    (mesh,) = it.meshes
    frame = framed(it)
    law = Regional((ALUMINIUM, STEEL), mesh.region_of)
    return PartBar(mesh.placed(frame.to_bar(mesh.points)), frame.length, law, (False, False)).stiffness(
        "rigid"
    )


@pytest.mark.parametrize(
    ("kind", "quadratic"),
    [
        ("mixed", False),
        *(pytest.param(k, q, marks=pytest.mark.long) for k in ("hexahedron", "wedge") for q in (False, True)),
        pytest.param("mixed", True, marks=pytest.mark.long),
    ],
)
def test_text_formats_and_vtu_hold_the_same_bar(kind: str, quadratic: bool, tmp_path: Path) -> None:
    raw = parts.mixed() if kind == "mixed" else parts.block(kind)
    mesh = parts.part(raw)
    law = Regional((ALUMINIUM, STEEL), mesh.region_of)
    expected = PartBar(mesh, 60.0, law, (False, False)).stiffness("rigid")
    whole = raised(raw) if quadratic else raw
    files = [
        written.inp(whole, tmp_path / "a.inp"),
        written.bdf(whole, tmp_path / "free.bdf"),
        written.bdf(whole, tmp_path / "small.bdf", "small"),
        written.bdf(whole, tmp_path / "large.bdf", "large"),
        written.vtu(whole, tmp_path / "a.vtu"),
    ]
    for path in files if kind == "mixed" else files[:1]:
        # VTK keeps numbers of single precision.
        assert difference(stiff(path), expected) < 1e-6, path.name


@pytest.mark.long
def test_metres_names_and_sets(tmp_path: Path) -> None:
    raw = parts.block("hexahedron")
    metres = written.inp(replace(raw, points=raw.points / 1000.0), tmp_path / "m.inp")
    in_mm = written.inp(raw, tmp_path / "mm.inp")
    assert difference(stiff(metres, "m"), stiff(in_mm)) < 1e-9
    by_set = stiff(in_mm, ends=({"name": "FOOT"}, ENDS[1]))
    assert difference(by_set, stiff(in_mm)) < 1e-9
    with pytest.raises(ValueError, match="has no unit of its own"):
        brought(in_mm, *ENDS)


@pytest.mark.long
@pytest.mark.parametrize("suffix", ["msh", "unv", "med"])
@pytest.mark.parametrize("order", [1, 2])
def test_formats_of_gmsh(suffix: str, order: int, tmp_path: Path) -> None:
    path = tmp_path / f"a.{suffix}"
    with session("made"):
        gmsh.option.setNumber("General.Verbosity", 0)
        box()
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(3, [1], name="body")
        foot = gmsh.model.getEntitiesInBoundingBox(-1, -9, -9, 1, 9, 9, 2)
        gmsh.model.addPhysicalGroup(2, [tag for _, tag in foot], name="foot")
        gmsh.option.setNumber("Mesh.MeshSizeMax", 5)
        gmsh.option.setNumber("Mesh.ElementOrder", order)
        gmsh.model.mesh.generate(3)
        gmsh.write(str(path))
    it = brought(path, *ENDS, unit="mm")
    (bar,) = bars(it)
    assert bar.mesh.kind == "tetra10" and bar.stiffness("rigid")[0, 0] == pytest.approx(70e3, rel=0.03)
    assert ("its linear cells were raised" in " ".join(it.told["remarks"])) == (order == 1)
    if suffix != "unv":
        named = brought(path, {"name": "foot"}, ENDS[1], unit="mm")
        assert np.abs(named.base.at).max() < 1e-9


def asked(path: Path) -> dict[str, Any]:
    """What the child is asked, to ask it here."""
    return {"path": str(path), "unit": "mm", "size": None, "base": ENDS[0], "tip": ENDS[1]}


REFUSED_INP = {
    "second instance": ("*INSTANCE, NAME=a, PART=p\n*INSTANCE, NAME=b, PART=p", "second *INSTANCE"),
    "moved instance": ("*INSTANCE, NAME=a, PART=p\n10., 0., 0.", "*INSTANCE is moved"),
    "shifted system": ("*SYSTEM\n1., 0., 0.", "*SYSTEM is not read"),
    "transformed": ("*TRANSFORM, NSET=ALL\n1., 0., 0., 0., 1., 0.", "*TRANSFORM is not read"),
    "tie": ("*TIE, NAME=t\na, b", "*TIE is not read"),
    "equation": ("*EQUATION\n2\n1,1,1.,2,1,-1.", "*EQUATION is not read"),
    "symmetry": ("*BOUNDARY\nfoot, XSYMM", "half model"),
    "held": ("*BOUNDARY\nfoot, 1, 3", "allowed is a free part"),
    "plane elements": ("*ELEMENT, TYPE=CPS6\n900, 10, 11, 12, 13, 14, 15", "type CPS6"),
    "shells": ("*ELEMENT, TYPE=S8R\n900, 10, 11, 12, 13", "type S8R"),
    "other tetrahedra": ("*ELEMENT, TYPE=C3D10HS\n900, 10, 11", "type C3D10HS"),
    "cylinder": ("*NODE, SYSTEM=C\n900, 1., 2., 3.", "rectangular coordinates"),
    "no such node": ("*ELEMENT, TYPE=C3D8\n900, 10, 11, 12, 13, 14, 15, 16, 999999", "node 999999"),
    "uneven": ("*ELEMENT, TYPE=C3D8\n900, 10, 11, 12", "do not come out even"),
    "no number": ("*NODE\n900, one, 2., 3.", "'one' is no number"),
}


@pytest.mark.parametrize("name", REFUSED_INP)
def test_what_an_input_file_would_lose_is_refused(name: str, tmp_path: Path) -> None:
    more, said = REFUSED_INP[name]
    path = written.inp(parts.block("hexahedron"), tmp_path / "a.inp", after=more)
    with pytest.raises(ValueError) as caught:
        abaqus.work(asked(path))
    assert said in str(caught.value), str(caught.value)


@pytest.mark.parametrize(
    ("card", "said"),
    [
        ("GRID,900,1,0.,0.,0.", "coordinate system 1"),
        ("GRID,900,,0.,0.,0.,,123", "held in 123"),
        ("CQUAD4,900,1,1,2,3,4", "CQUAD4 is a shell"),
        ("RBE2,900,1,123,2,3", "RBE2 is not read"),
        ("SPC1,1,1,1,2,3", "half model"),
        ("CHEXA,900,1,1,2,3", "has 3 nodes"),
        ("PSOLID,1,1,5", "material frame CORDM"),
        ("GRID,x,,0.,0.,0.", "'x' is no whole number"),
    ],
)
def test_what_bulk_data_would_lose_is_refused(card: str, said: str, tmp_path: Path) -> None:
    path = written.bdf(parts.block("hexahedron"), tmp_path / "a.bdf", before=card)
    with pytest.raises(ValueError) as caught:
        nastran.work(asked(path))
    assert said in str(caught.value), str(caught.value)


@pytest.mark.long
def test_pieces_shells_and_folded_meshes_are_refused(tmp_path: Path) -> None:
    import pyvista

    raw = parts.block("hexahedron", (6, 1, 1))
    half = raw.region_of == 0
    left, right = raw.blocks[0][1][half], raw.blocks[0][1][~half]
    points = np.concatenate((raw.points, raw.points + [0.5, 0.0, 0.0]))
    cells = np.concatenate((left, right + len(raw.points)))
    apart = replace(raw, points=points, blocks=(("hexahedron", cells),))
    with pytest.raises(ValueError, match="in 2 pieces that share no node"):
        brought(written.inp(apart, tmp_path / "apart.inp"), plane(0, 0, 0), plane(60.5, 0, 0), unit="mm")
    pyvista.Plane().cast_to_unstructured_grid().save(tmp_path / "plane.vtu")
    with pytest.raises(ValueError, match="plane cells and no solid ones"):
        brought(tmp_path / "plane.vtu", *ENDS, unit="mm")
    twisted = raw.blocks[0][1][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    path = written.inp(replace(raw, blocks=(("hexahedron", twisted),)), tmp_path / "twisted.inp")
    with pytest.raises(ValueError, match="inside out"):
        stiff(path)


def test_fields_of_both_text_formats() -> None:
    (head, *_) = list(blocks("*NODE,\nNSET=A\n1, 2., 3.\n\n** x\n*STEP\n"))
    assert head == (2, "NODE", {"NSET": "A"}, [(3, ["1", "2.", "3."])])
    text = (
        "BEGIN BULK\nGRID,7,,1.5-3,2.,3.\n$ x\nGRID    8               1.      2.      3.\nENDDATA\nrubbish\n"
    )
    found = list(cards(text))
    assert [f[:6] for _, f in found] == [
        ["GRID", "7", "", "1.5-3", "2.", "3."],
        ["GRID", "8", "", "1.", "2.", "3."],
    ]


def test_cells_of_nodes_that_are_not_there_and_points_that_are_no_numbers(tmp_path: Path) -> None:
    """Whatever the format: VTK and gmsh hand over what they read."""
    raw = parts.block("hexahedron")
    for wrong in (-1, len(raw.points)):
        cells = raw.blocks[0][1].copy()
        cells[2, 3] = wrong
        with pytest.raises(ValueError, match=r"cells of 1 nodes that are not in the file, which holds 42"):
            replace(raw, blocks=(("hexahedron", cells),))
    with pytest.raises(ValueError, match="no finite numbers"):
        replace(raw, points=raw.points * np.nan)
    path = written.vtu(raw, tmp_path / "a.vtu", text=True)
    path.write_text(path.read_text().replace("41", "43"))
    with pytest.raises(ValueError, match="are not in the file"):
        vtu.work(asked(path))
    path = written.vtu(raw, tmp_path / "b.vtu", text=True)
    path.write_text(path.read_text().replace("8 16 24", "8 17 24"))
    with pytest.raises(ValueError, match="has hexahedron cells of other than 8 nodes"):
        vtu.work(asked(path))


def test_metres_are_a_thousand_times_as_long(tmp_path: Path) -> None:
    """A mesh has the unit that is declared; the quick one of `test_metres_names_and_sets`."""
    raw = parts.block("hexahedron")
    path = written.inp(replace(raw, points=raw.points / 1000.0), tmp_path / "m.inp")
    _, arrays = abaqus.work({**asked(path), "unit": "m"})
    assert np.ptp(arrays["0 points"], axis=0) == pytest.approx([60.0, 6.0, 10.0])


def test_hostile_words_are_a_sentence(tmp_path: Path) -> None:
    """Written by hand; `test_mutated_files` has those by chance."""
    hostile: list[tuple[str, bytes]] = [
        ("a.step", b"ISO-10303-21;\nHEADER;\n" + bytes(range(256)) * 20),
        ("a.msh", b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 999999999999 1 1\n"),
        ("a.inp", b"*NSET, NSET=a, GENERATE\n1, 999999999999, 1\n"),
        ("a.bdf", b"GRID,1,,1e999,0.,0.\n"),
        ("a.vtu", b"<VTKFile"),
    ]
    for name, content in hostile:
        (tmp_path / name).write_bytes(content)
        with pytest.raises(ValueError) as caught:
            brought(tmp_path / name, *ENDS, unit=None if name.endswith("step") else "mm")
        assert str(caught.value)
