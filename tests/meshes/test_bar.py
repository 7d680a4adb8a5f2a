"""Bars as geometry and as meshes: exact volume and moments, faces in their place, conformal lugs, plain refusals."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshes.bar import Bar, Lug
from meshes.discrete import FUNCTIONS, discretise
from meshes.quality import quality
from meshes.resolution import Resolution
from meshes.section import ISection, Rectangle, Round, Section, Tube
from meshes.solid import SolidMesh
from meshes.store import mesh_bar

I_SECTION = ISection(12.0, 2.2, 15.5, 4.0)
COARSE = Resolution(6.0, 1)
LUGS = {
    "flush": Lug(20.0, 12.0, 15.5),
    "wider": Lug(20.0, 16.0, 18.0),
    "lower": Lug(20.0, 12.0, 10.0),
    "within": Lug(20.0, 3.0, 9.0),
}


def errors(mesh: SolidMesh, bar: Bar) -> np.ndarray:
    q = quality(mesh, bar)
    return np.abs([q.volume, q.moment_y, q.moment_z])


def face_area(mesh: SolidMesh, x: float) -> float:
    """Area of the end face at `x`, mm²: the rigid translation's ∫ N_i N_j dA summed."""
    return float(discretise(mesh).face_mass(x).sum())


@pytest.mark.parametrize("tetrahedra", [False, True])
@pytest.mark.parametrize("section", [Rectangle(6.0, 10.0), I_SECTION], ids=["rectangle", "I"])
def test_straight_sections_are_exact(section: Section, tetrahedra: bool) -> None:
    bar = Bar(section, 100.0)
    mesh = mesh_bar(bar, COARSE, tetrahedra)
    assert mesh.kind == ("tetra10" if tetrahedra else "hexahedron20")
    assert errors(mesh, bar).max() < 1e-12


@pytest.mark.parametrize("section", [Round(10.0), Tube(12.0, 2.0)], ids=["round", "tube"])
def test_curved_sections_converge_with_order_four(section: Section) -> None:
    """Quadratic arcs: the chord error falls with h⁴."""
    bar = Bar(section, 60.0)
    found = np.array([errors(mesh_bar(bar, Resolution(4.0, level)), bar) for level in (1, 2, 4)])
    orders = np.log2(found[:-1] / found[1:])
    assert np.all(np.abs(orders - 4.0) < 0.2), orders


@pytest.mark.parametrize("tetrahedra", [False, True])
def test_named_faces(tetrahedra: bool) -> None:
    """Base and tip are flat and have the area of the section; the faces together are the whole surface."""
    bar = Bar(I_SECTION, 100.0)
    mesh = mesh_bar(bar, COARSE, tetrahedra)
    for name, x in (("base", 0.0), ("tip", 100.0)):
        nodes = mesh.face_nodes(name)
        np.testing.assert_allclose(mesh.points[nodes, 0], x, atol=1e-12)
        np.testing.assert_array_equal(nodes, np.flatnonzero(np.abs(mesh.points[:, 0] - x) < 1e-9))
        assert face_area(mesh, x) == pytest.approx(bar.section.area, rel=1e-12)
    corners = {"hexahedron20": 4, "tetra10": 3}[mesh.kind]
    facets = np.concatenate([mesh.faces[n][:, :corners] for n in ("base", "tip", "side")])
    edges = np.sort(np.concatenate([facets[:, [i, (i + 1) % corners]] for i in range(corners)]), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    # A closed surface: every edge belongs to exactly two facets.
    assert np.all(counts == 2)


def test_faces_refuse_a_wrong_name() -> None:
    mesh = mesh_bar(Bar(Rectangle(6.0, 10.0), 40.0), COARSE)
    with pytest.raises(KeyError, match="'end' is not in this mesh, known are base, tip, side"):
        mesh.face_nodes("end")
    with pytest.raises(ValueError, match="no face of the mesh lies at x = 39 mm"):
        discretise(mesh).face_mass(39.0)
    with pytest.raises(ValueError, match="cell kind is 'quad4', allowed are hexahedron20"):
        SolidMesh(np.zeros((4, 3)), np.zeros((1, 4), dtype=np.int64), "quad4", {})


@pytest.mark.parametrize("tetrahedra", [False, True])
def test_same_input_gives_the_same_mesh(tetrahedra: bool) -> None:
    bar = Bar(I_SECTION, 100.0, LUGS["wider"])
    first, second = (mesh_bar(bar, COARSE, tetrahedra) for _ in range(2))
    np.testing.assert_array_equal(first.points, second.points)
    np.testing.assert_array_equal(first.cells, second.cells)
    for name in first.faces:
        np.testing.assert_array_equal(first.faces[name], second.faces[name])


@pytest.mark.parametrize("lug", [None, LUGS["flush"]], ids=["plain", "flush"])
def test_levels_are_nested(lug: Lug | None) -> None:
    """Every level has level³ times the cells, and the corners of level 1 are among those of level 2 and 3."""
    bar = Bar(I_SECTION, 200.0, lug)
    meshes = [mesh_bar(bar, Resolution(6.0, level)) for level in (1, 2, 3)]
    assert [len(m.cells) / len(meshes[0].cells) for m in meshes] == [1, 8, 27]
    coarse = np.unique(np.round(meshes[0].points[meshes[0].cells[:, :8].ravel(), 0], 6))
    for finer in meshes[1:]:
        stations = np.unique(np.round(finer.points[finer.cells[:, :8].ravel(), 0], 6))
        gaps = np.abs(coarse[:, None] - stations).min(axis=1)
        # The grading divides a cell by a geometric row of its own: stations agree to a share of the cell.
        assert np.all(gaps < 1e-3 * 200.0), gaps.max()


@pytest.mark.parametrize("name", LUGS)
def test_lugs_are_conformal(name: str) -> None:
    """Right volume and moments, end faces of the lug's size, and no crack between lug and body."""
    bar = Bar(I_SECTION, 200.0, LUGS[name])
    mesh = mesh_bar(bar, COARSE)
    assert mesh.kind == "hexahedron20"
    assert errors(mesh, bar).max() < 1e-12
    assert face_area(mesh, 0.0) == pytest.approx(LUGS[name].width * LUGS[name].height, rel=1e-12)
    # Two bodies that only touch would have a node each at the same place.
    assert len(np.unique(np.round(mesh.points, 6), axis=0)) == len(mesh.points)
    sides = mesh.cells[
        :, [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    ]
    _, counts = np.unique(np.sort(sides.reshape(-1, 4), axis=1), axis=0, return_counts=True)
    named = sum(len(facets) for facets in mesh.faces.values())
    # Sides that belong to one cell only are the surface that has a name, no more.
    assert np.count_nonzero(counts == 1) == named
    assert counts.max() == 2


def test_a_lug_is_where_the_section_ends() -> None:
    mesh = mesh_bar(Bar(I_SECTION, 200.0, LUGS["wider"]), COARSE)
    outside = np.abs(mesh.points[:, 1]) > 6.0 + 1e-9
    x = mesh.points[outside, 0]
    assert np.count_nonzero(outside) and np.all((x < 20.0 + 1e-9) | (x > 180.0 - 1e-9))


def test_a_block_lug_on_a_curved_section_is_meshed_with_tetrahedra() -> None:
    bar = Bar(Tube(12.0, 2.0), 100.0, Lug(12.0, 14.0, 14.0))
    assert not bar.sweepable
    mesh = mesh_bar(bar, Resolution(4.0, 1))
    assert mesh.kind == "tetra10"
    # The chords of the tube's arcs; the lugs themselves are exact.
    assert errors(mesh, bar).max() < 1e-3
    assert face_area(mesh, 100.0) == pytest.approx(14.0**2, rel=1e-12)
    with pytest.raises(ValueError, match="a block lug on a curved section cannot be swept"):
        bar.zones()


def test_a_block_lug_on_a_round_is_right_side_out_on_a_coarse_mesh() -> None:
    bar = Bar(Round(10.0), 310.0, Lug(20.0, 12.0, 12.0))
    assert quality(mesh_bar(bar, COARSE), bar).worst_cell > 0.1


def test_exact_moments_of_a_bar_with_lugs() -> None:
    """30 mm of 10 x 20 and 2 x 5 mm of 12 x 8, by hand."""
    bar = Bar(Rectangle(10.0, 20.0), 40.0, Lug(5.0, 12.0, 8.0))
    expected = (
        30 * 200 + 10 * 96,
        30 * 10 * 20**3 / 12 + 10 * 12 * 8**3 / 12,
        30 * 20 * 10**3 / 12 + 10 * 8 * 12**3 / 12,
    )
    np.testing.assert_allclose(bar.exact_moments(), expected, rtol=1e-14)


def test_quality_sees_a_wrong_bar_and_a_bad_cell() -> None:
    bar = Bar(Rectangle(6.0, 10.0), 40.0)
    mesh = mesh_bar(bar, COARSE)
    good = quality(mesh, bar)
    assert good.worst_cell == pytest.approx(1.0, abs=1e-9)
    longer = quality(mesh, Bar(Rectangle(6.0, 10.0), 50.0))
    assert longer.volume == pytest.approx(-0.2, rel=1e-9)
    shake = np.random.default_rng(0).uniform(-0.5, 0.5, mesh.points.shape)
    assert quality(mesh.moved(shake), bar).worst_cell < 0.95
    upside_down = mesh.points * np.where(np.arange(len(mesh.points)) == mesh.cells[0, 6], -3.0, 1.0)[:, None]
    with pytest.raises(ValueError, match="zero or negative volume"):
        quality(SolidMesh(upside_down, mesh.cells, mesh.kind, mesh.faces), bar)


def test_mid_edge_nodes_off_the_middle_are_refused() -> None:
    mesh = mesh_bar(Bar(Rectangle(6.0, 10.0), 40.0), COARSE)
    points = mesh.points.copy()
    points[mesh.cells[0, 8]] += 0.1
    with pytest.raises(ValueError, match="mid-edge nodes off the middle of straight edges"):
        discretise(SolidMesh(points, mesh.cells, mesh.kind, mesh.faces))


def test_cells_grow_towards_the_middle() -> None:
    """End cells are about eight times shorter than middle ones, neighbours never jump, and the bar is mirrored."""
    mesh = mesh_bar(Bar(I_SECTION, 310.0), Resolution(6.0, 2))
    stations = np.unique(np.round(mesh.points[mesh.cells[:, :8].ravel(), 0], 6))
    steps = np.diff(stations)
    np.testing.assert_allclose(steps, steps[::-1], rtol=1e-4)
    assert 6.0 < steps.max() / steps.min() < 12.0
    assert all(max(a / b, b / a) < 2.0 for a, b in pairwise(steps))


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Bar(I_SECTION, -310.0), "length is -310, allowed is a length above 0 mm"),
        (lambda: Bar(I_SECTION, float("nan")), "length is nan, allowed is a length above 0 mm"),
        (
            lambda: Bar(I_SECTION, 40.0, LUGS["flush"]),
            "lug length is 20 mm, allowed is less than half of length = 40 mm",
        ),
        (lambda: Lug(0.0, 1.0, 1.0), "length is 0, allowed is a length above 0 mm"),
        (lambda: Resolution(0.0), "mesh size is 0, allowed is a length above 0 mm"),
        (lambda: Resolution(float("nan")), "mesh size is nan, allowed is a length above 0 mm"),
        (lambda: Resolution(3.0, 0), "mesh level is 0, allowed is a whole number from 1"),
        (
            lambda: mesh_bar(Bar(I_SECTION, 100.0), Resolution(26.0)),
            "mesh size is 26 mm, allowed is at most a quarter of the bar's length, 25 mm",
        ),
        (
            lambda: mesh_bar(Bar(I_SECTION, 310.0), Resolution(0.1, 2)),
            "mesh size is 0.1 mm, at level 2 that makes about 7.2e+07 cells; allowed are 500000: take a larger size",
        ),
    ],
)
def test_bad_input(make: object, sentence: str) -> None:
    with pytest.raises(ValueError) as caught:
        make()  # type: ignore[operator]
    assert str(caught.value) == sentence


lengths = st.floats(4.0, 20.0)


@st.composite
def sections(draw: st.DrawFn) -> Section:
    """Rectangles and I-sections of ordinary proportions."""
    width, height = draw(lengths), draw(lengths)
    if draw(st.booleans()):
        return Rectangle(width, height)
    web, thickness = draw(st.floats(0.15, 0.8)), draw(st.floats(0.1, 0.4))
    return ISection(width, thickness * height, height, web * width)


@settings(max_examples=8, derandomize=True, deadline=None, database=None)
@given(sections(), st.floats(60.0, 400.0), st.sampled_from([None, 0.6, 1.0, 1.4]))
def test_any_bar_has_its_volume_and_moments(section: Section, length: float, lug: float | None) -> None:
    y, z = section.size
    bar = Bar(section, length, None if lug is None else Lug(12.0, lug * y, lug * z))
    assert errors(mesh_bar(bar, COARSE), bar).max() < 1e-11


def test_the_order_of_functions_is_that_of_scikit_fem() -> None:
    from skfem.io.meshio import INV_HEX_MAPPING

    assert list(INV_HEX_MAPPING) == FUNCTIONS
