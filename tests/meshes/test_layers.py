"""Sweeps: recognised in meshes of gmsh, drawn without it, and refused where a mesh is none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from meshes.bar import Bar, Lug
from meshes.extrusion import section_mesh, stepped_thickness
from meshes.layers import as_sweep, clusters
from meshes.resolution import Resolution
from meshes.section import Rectangle, Round, Section, Tube
from meshes.solid import SolidMesh
from meshes.store import mesh_bar
from tests.fem import bar_p
from tests.meshes.solids import section_solid, section_sweep

SECTIONS = [bar_p.SECTION, Rectangle(6.0, 10.0), Round(12.0), Tube(12.0, 2.0)]
NAMES = ["I", "rectangle", "round", "tube"]


def moved(mesh: SolidMesh, node: int, by: float) -> SolidMesh:
    """The mesh with one node elsewhere along x."""
    points = mesh.points.copy()
    points[node, 0] += by
    return replace(mesh, points=points)


@pytest.mark.parametrize("level", [1, 2])
def test_graded_mesh_of_gmsh(level: int) -> None:
    """Drawn anew through the same layers, the section has the very nodes that gmsh gives it."""
    mesh = bar_p.mesh(level)
    found = as_sweep(mesh)
    sweep = found.sweep
    assert len(sweep.shapes) == 1 and len(sweep.thickness) == 16 * level
    assert sweep.dofs == mesh.dofs and sweep.length == pytest.approx(bar_p.LENGTH, rel=1e-12)
    assert sweep.shapes[0].even
    every = np.concatenate((*found.planes, *found.middles))
    np.testing.assert_array_equal(np.sort(every), np.arange(len(mesh.points)))
    drawn = section_sweep(bar_p.SECTION, Resolution(bar_p.SIZE, level), sweep.thickness)
    assert drawn.dofs == mesh.dofs
    np.testing.assert_allclose(drawn.shapes[0].first_places, sweep.shapes[0].first_places, atol=1e-9)
    np.testing.assert_allclose(drawn.shapes[0].middle_places, sweep.shapes[0].middle_places, atol=1e-9)


def test_lugs_are_layers_of_another_shape() -> None:
    """The body and its lugs, and one layer at each step that knows of the places it has not."""
    lug = Lug(6.0, 12.0, 15.5)
    sweep = as_sweep(mesh_bar(Bar(bar_p.SECTION, 100.0, lug), Resolution(6.0))).sweep
    assert len(sweep.shapes) == 4
    assert [shape.even for shape in sweep.shapes].count(False) == 2
    assert sweep.shape_of[0] == sweep.shape_of[-1] != sweep.shape_of[len(sweep.shape_of) // 2]
    steps = [s for s in sweep.shapes if not s.even]
    for step in steps:
        assert min(step.first.min(), step.last.min()) == -1
        assert len(step.first) == len(step.first_places) and len(step.last) == len(step.last_places)


@pytest.mark.parametrize("section", SECTIONS, ids=NAMES)
def test_drawn_section(section: Section) -> None:
    """Its area to the error of parabolas on arcs, its solid mesh recognised as what it was drawn from."""
    plane = section_mesh(section, Resolution(3.0))
    made = section_solid(section, Resolution(3.0), [1.0, 2.0, 2.0, 1.5])
    assert made.sweep.dofs == made.mesh.dofs
    area = float(np.sum(quadrature(plane.points[plane.cells])))
    assert area == pytest.approx(section.area, rel=2e-4 if isinstance(section, Round | Tube) else 1e-12)
    found = as_sweep(made.mesh)
    assert [(r.start, r.count) for r in found.sweep.runs()] == [(0, 1), (1, 2), (3, 1)]
    for mine, theirs in zip((*found.planes, *found.middles), (*made.planes, *made.middles), strict=True):
        np.testing.assert_array_equal(mine, theirs)


def quadrature(corners: np.ndarray) -> np.ndarray:
    """Areas (m,) of nine-node quadrilaterals (m, 9, 2) by Gauss's three points in each direction."""
    grid = corners[:, [0, 4, 1, 7, 8, 5, 3, 6, 2]].reshape(-1, 3, 3, 2)
    total = np.zeros(len(corners))
    points, weights = np.polynomial.legendre.leggauss(3)
    for u, wu in zip(points, weights, strict=True):
        for v, wv in zip(points, weights, strict=True):
            (nu, du), (nv, dv) = shapes(u), shapes(v)
            by_u = np.einsum("j,i,mija->ma", nv, du, grid.transpose(0, 2, 1, 3))
            by_v = np.einsum("j,i,mija->ma", dv, nu, grid.transpose(0, 2, 1, 3))
            total += wu * wv * np.abs(by_u[:, 0] * by_v[:, 1] - by_u[:, 1] * by_v[:, 0])
    return total


def shapes(t: float) -> tuple[np.ndarray, np.ndarray]:
    """The three parabolas on -1, 0, 1 at t, and their derivatives."""
    return np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2]), np.array([t - 0.5, -2 * t, t + 0.5])


def test_stepped_thickness() -> None:
    found = stepped_thickness(31.0, (2, 1, 3))
    assert found.sum() == pytest.approx(31.0, rel=1e-14)
    np.testing.assert_allclose(found / found[0], [1, 1, 2, 4, 4, 4, 4, 4, 4, 2, 1, 1], rtol=1e-14)
    with pytest.raises(ValueError, match="not above 0 mm"):
        section_sweep(Rectangle(6.0, 10.0), Resolution(3.0), [1.0, 0.0])


def test_values_close_together_are_one_group() -> None:
    group, firsts = clusters(np.array([2.0, 1.0, 2.0 + 1e-9, 3.0]), 1e-6)
    np.testing.assert_array_equal(group, [1, 0, 1, 2])
    np.testing.assert_array_equal(firsts, [1.0, 2.0, 3.0])


def test_what_is_no_sweep_is_refused() -> None:
    straight = section_solid(Rectangle(6.0, 10.0), Resolution(6.0), [2.0, 3.0, 4.0]).mesh
    corner = int(straight.cells[0, 4])
    between = int(straight.cells[0, 16])
    refused = [
        (bar_p.mesh(1, tetrahedra=True), "its cells are tetra10"),
        (moved(straight, between, 0.2), "neither on a plane nor half-way"),
        (moved(straight, corner, 0.5), "a cell reaches over a plane"),
        (replace(straight, faces={**straight.faces, "tip": straight.faces["tip"][:1, :4]}), "face 'tip'"),
    ]
    for mesh, said in refused:
        with pytest.raises(ValueError, match=said):
            as_sweep(mesh)
    points = straight.points.copy()
    points[:, 1] *= 1.0 + 0.1 * points[:, 0] / 9.0
    with pytest.raises(ValueError, match="two planes are not alike"):
        as_sweep(replace(straight, points=points))
