"""Meshes as files: exact round trip, cache hits, damaged and foreign files."""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np
import pytest

from meshes import store
from meshes.bar import Bar, Lug
from meshes.resolution import Resolution
from meshes.section import Rectangle, Round
from meshes.solid import SolidMesh
from meshes.store import cached_mesh, mesh_bar, read_mesh, write_mesh

BARS = {
    "hexahedron20": (Bar(Rectangle(6.0, 10.0), 60.0, Lug(12.0, 8.0, 10.0)), False),
    "hexahedron27": (Bar(Round(10.0), 60.0), False),
    "tetra10": (Bar(Rectangle(6.0, 10.0), 60.0), True),
}
SIZE = Resolution(6.0, 1)


def assert_same(a: SolidMesh, b: SolidMesh) -> None:
    """The same to the last bit."""
    assert a.kind == b.kind and set(a.faces) == set(b.faces)
    np.testing.assert_array_equal(a.points, b.points)
    np.testing.assert_array_equal(a.cells, b.cells)
    for name in a.faces:
        np.testing.assert_array_equal(a.faces[name], b.faces[name])


@pytest.mark.parametrize("kind", BARS)
def test_round_trip_is_exact(kind: str, tmp_path: Path) -> None:
    bar, tetrahedra = BARS[kind]
    mesh = mesh_bar(bar, SIZE, tetrahedra)
    assert mesh.kind == kind
    path = tmp_path / "new folder" / "bar.msh"
    write_mesh(mesh, path)
    assert_same(read_mesh(path), mesh)
    # Anyone else's program reads the same body and the names of the faces.
    raw = meshio.read(path, file_format="gmsh")
    np.testing.assert_array_equal(raw.cells_dict[kind], mesh.cells)
    assert set(raw.field_data) == {"base", "tip", "side", "body"}
    assert [p.name for p in path.parent.iterdir()] == ["bar.msh"], "a part of a file was left behind"


def test_cache_hit_meshes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    bar, _ = BARS["hexahedron20"]
    first = cached_mesh(bar, SIZE, tmp_path)
    (path,) = tmp_path.iterdir()

    def refuse(*_: object) -> SolidMesh:
        raise AssertionError("the mesh was made again")

    monkeypatch.setattr(store, "mesh_bar", refuse)
    assert_same(cached_mesh(bar, SIZE, tmp_path), first)
    assert list(tmp_path.iterdir()) == [path]


def test_cache_keeps_every_input_apart(tmp_path: Path) -> None:
    bar = Bar(Rectangle(6.0, 10.0), 60.0)
    inputs = [
        (bar, SIZE, False),
        (bar, SIZE, True),
        (bar, Resolution(6.0, 2), False),
        (Bar(Rectangle(6.0, 10.5), 60.0), SIZE, False),
        (Bar(Rectangle(6.0, 10.0), 60.0, Lug(12.0, 6.0, 10.0)), SIZE, False),
    ]
    for b, resolution, tetrahedra in inputs:
        cached_mesh(b, resolution, tmp_path, tetrahedra)
    assert len(list(tmp_path.iterdir())) == len(inputs)


# meshio.read would end the process on the last two.
@pytest.mark.parametrize("damage", ["cut", "no cells", "no faces", "empty", "text"])
def test_damaged_cache_file_is_made_again(damage: str, tmp_path: Path) -> None:
    bar, _ = BARS["hexahedron20"]
    good = cached_mesh(bar, SIZE, tmp_path)
    (path,) = tmp_path.iterdir()
    whole = path.read_bytes()
    if damage == "no cells":
        meshio.write(path, meshio.Mesh(np.zeros((3, 3)), [("triangle", [[0, 1, 2]])]), file_format="gmsh22")
    else:
        path.write_bytes(
            {
                "empty": b"",
                "cut": whole[: len(whole) // 2],
                "text": b"not a mesh\n",
                "no faces": whole.replace(b'"tip"', b'"top"'),
            }[damage]
        )
    assert path.read_bytes() != whole
    assert_same(cached_mesh(bar, SIZE, tmp_path), good)
    assert_same(read_mesh(path), good)


def test_a_file_without_faces_is_refused_by_name(tmp_path: Path) -> None:
    path = tmp_path / "bar.msh"
    write_mesh(mesh_bar(*BARS["hexahedron20"][:1], SIZE), path)
    path.write_bytes(path.read_bytes().replace(b'"tip"', b'"top"'))
    with pytest.raises(ValueError, match=r"bar\.msh: face 'tip' is missing, needed are base, tip, side"):
        read_mesh(path)
    meshio.write(path, meshio.Mesh(np.zeros((3, 3)), [("triangle", [[0, 1, 2]])]), file_format="gmsh22")
    with pytest.raises(ValueError, match="no quadratic solid cells found, allowed are hexahedron20"):
        read_mesh(path)


def test_gmsh_failures_are_told_as_such(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise Exception("Could not recover boundary mesh")

    monkeypatch.setattr("meshes.sweep.build_swept", fail)
    with pytest.raises(RuntimeError, match="gmsh could not mesh the bar: Could not recover boundary mesh"):
        mesh_bar(BARS["hexahedron20"][0], SIZE)


def test_arrays_are_frozen_and_20_node_edges_stay_straight() -> None:
    mesh = mesh_bar(BARS["hexahedron20"][0], SIZE)
    with pytest.raises(ValueError, match="read-only"):
        mesh.points[0, 0] = 1.0
    moved = mesh.moved(np.random.default_rng(2).normal(size=mesh.points.shape))
    # Mid-edge node 8 lies between corners 0 and 1, node 16 between 0 and 4 (meshio's order).
    for middle, a, b in ((8, 0, 1), (16, 0, 4)):
        ends = moved.points[mesh.cells[:, [a, b]]].mean(axis=1)
        np.testing.assert_allclose(moved.points[mesh.cells[:, middle]], ends, atol=1e-12)
