"""The chain as a solver: fields, stress, geometric stiffness and buckling by the code that is there, on one mesh."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import scipy.sparse as sp

from fem.axial import axial_stiffness
from fem.buckling import buckling
from fem.elasticity import stiffness_matrix, stress
from fem.factor import SolveError
from fem.linear import LinearModel, submatrix
from fem.linkage import PLATFORM, Linkage, parallelogram, single_bar
from fem.rigid_motions import rigid_motions
from fem.slices.chain import Chain
from fem.slices.solver import ChainFactor, ChainSolver
from fem.solvers import direct
from fem.space import Space
from meshes.bar import Bar, Lug
from meshes.extrusion import stepped_thickness
from meshes.layers import as_sweep
from meshes.resolution import Resolution
from meshes.solid import SolidMesh
from meshes.store import mesh_bar
from tests.fem import bar_p
from tests.meshes.solids import section_solid

LUG = Lug(6.0, 12.0, 15.5)


@cache
def mesh(name: str) -> SolidMesh:
    """Bar P: graded by gmsh, in runs of equal layers (of which one has 11), with lugs."""
    if name == "graded":
        return bar_p.mesh(1)
    if name == "lugs":
        return mesh_bar(Bar(bar_p.SECTION, bar_p.LENGTH, LUG), Resolution(bar_p.SIZE))
    return section_solid(bar_p.SECTION, Resolution(bar_p.SIZE), stepped_thickness(310.0, (3, 2, 11))).mesh


def two(linkage: Linkage) -> tuple[LinearModel, LinearModel]:
    """The linkage with the direct solver, and with its chains."""
    chain = ChainSolver(linkage, bar_p.MATERIAL)
    return LinearModel(linkage, bar_p.MATERIAL, direct), LinearModel(linkage, bar_p.MATERIAL, chain)


def bars(name: str, pinned: bool = False) -> tuple[LinearModel, LinearModel]:
    return two(single_bar(Space.of(mesh(name)), bar_p.LENGTH, pinned))


@pytest.mark.parametrize("name", ["graded", "stepped", "lugs"])
def test_unit_fields_and_stress(name: str) -> None:
    """Displacements to 1e-8 of the largest, stress to 1e-6 of its own largest."""
    model, _ = bars(name)
    (expected,) = model.reduction.fields(model.motions(PLATFORM, ()), model.reduction.rest)
    swept = as_sweep(mesh(name))
    space = model.linkage.members[0].space
    for axes in (None, (1,), ()):
        places = swept.sweep.shapes[swept.sweep.shape_of[-1]].last_places
        tip = rigid_motions(np.insert(places, 0, 0.0, axis=1))
        found = Chain.of(swept, bar_p.MATERIAL, axes).solve(np.zeros((swept.mesh.dofs, 6)), tip)
        assert np.abs((found - expected) / np.abs(expected).max(axis=0)).max() < 1e-8
        for mine, theirs in zip(found.T, expected.T, strict=True):
            sigma = stress(space, bar_p.MATERIAL, theirs)
            error = np.abs(stress(space, bar_p.MATERIAL, mine) - sigma).max()
            assert error < 1e-6 * np.abs(sigma).max()


@pytest.mark.parametrize("name", ["graded", "stepped", "lugs"])
def test_product_is_that_of_the_whole_matrix(name: str) -> None:
    swept = as_sweep(mesh(name))
    u = np.random.default_rng(0).standard_normal(swept.mesh.dofs)
    expected = stiffness_matrix(Space.of(swept.mesh), bar_p.MATERIAL) @ u
    found = Chain.of(swept, bar_p.MATERIAL).product(u)
    assert np.abs(found - expected).max() < 1e-11 * np.abs(expected).max()


@pytest.mark.parametrize("name", ["graded", "stepped", "lugs"])
def test_solves_like_the_direct_solver(name: str) -> None:
    """Loads everywhere, pinned and free ends: the generalised coordinates come by their Schur complement."""
    for pinned, held in ((False, ("x",)), (True, PLATFORM)):
        one, other = bars(name, pinned)
        free = one.reduction.others(held)
        a, b = one.factor(free), other.factor(free)
        assert isinstance(b, ChainFactor) and b.name == "slice chain, quarter section"
        assert b.negative_eigenvalues == 0
        rhs = np.random.default_rng(1).standard_normal((len(free), 3))
        expected = a(rhs)
        assert np.abs(b(rhs) - expected).max() < 1e-7 * np.abs(expected).max()
        np.testing.assert_allclose(b(rhs[:, 1]), b(rhs)[:, 1], rtol=0, atol=1e-9 * np.abs(expected).max())
        assert b.record.residual < 1e-7 and b.record.unknowns == len(free)


@pytest.mark.parametrize("name", ["graded", "stepped", "lugs"])
def test_stiffness_and_its_derivative_by_axial_force(name: str) -> None:
    one, other = (axial_stiffness(m) for m in bars(name))
    np.testing.assert_allclose(bar_p.entries(other.elastic), bar_p.entries(one.elastic), rtol=1e-10)
    np.testing.assert_allclose(bar_p.entries(other.geometric), bar_p.entries(one.geometric), rtol=1e-6)


@pytest.mark.parametrize(
    ("name", "supports"),
    [
        ("graded", "free"),
        ("stepped", "pinned"),
        pytest.param("stepped", "guided", marks=pytest.mark.long),
        pytest.param("lugs", "clamped", marks=pytest.mark.long),
    ],
)
def test_buckling(name: str, supports: str) -> None:
    """Loads to 1e-6, where 1e-3 would do, and the planes of the modes."""
    held = {"free": (), "guided": ("rx", "ry", "rz")}.get(supports, bar_p.ALL_BUT_X)
    one, other = (buckling(m, held, 4) for m in bars(name, supports == "pinned"))
    np.testing.assert_allclose([m.load for m in other], [m.load for m in one], rtol=1e-6)
    assert [m.plane for m in other] == [m.plane for m in one]


@pytest.mark.long
def test_parallelogram() -> None:
    """Two bars share one chain."""
    one, other = two(parallelogram(bar_p.space(1), bar_p.LENGTH, bar_p.WIDTH, 0.5))
    assert isinstance(other.solver, ChainSolver)
    assert other.solver.chains[0] is other.solver.chains[1]
    size = np.abs(one.stiffness).max()
    np.testing.assert_allclose(other.stiffness, one.stiffness, rtol=1e-9, atol=1e-12 * size)
    loads = [[m.load for m in buckling(m, bar_p.GUIDED, 3)] for m in (one, other)]
    np.testing.assert_allclose(loads[1], loads[0], rtol=1e-6)


def test_any_other_matrix_goes_to_the_other_solver() -> None:
    """A tangent, another material, another size; a change of one entry by 1e-7 of the largest is enough."""
    _, model = bars("graded")
    free = model.reduction.others(PLATFORM)
    own = submatrix(model.reduced, free)
    solver = model.solver
    assert isinstance(solver, ChainSolver) and isinstance(solver(own), ChainFactor)
    changed = own + sp.csr_matrix(([1e-7 * abs(own).max()], ([40], [40])), shape=own.shape)
    for other in (changed, 1.0001 * own, own[:-3, :-3]):
        factor = solver(sp.csr_matrix(other))
        assert not isinstance(factor, ChainFactor)
        rhs = np.ones(other.shape[0])
        np.testing.assert_allclose(other @ factor(rhs), rhs, atol=1e-5)
    renewed = solver(own).renewed(sp.csr_matrix(changed))
    assert not isinstance(renewed, ChainFactor)


def test_what_is_not_held_is_an_error() -> None:
    for model in bars("graded", pinned=True):
        with pytest.raises(SolveError):
            model.factor(model.reduction.others(("x",)))


def test_a_mesh_that_is_no_sweep_is_refused() -> None:
    linkage = single_bar(Space.of(bar_p.mesh(1, tetrahedra=True)), bar_p.LENGTH)
    with pytest.raises(ValueError, match="no sweep"):
        _ = LinearModel(linkage, bar_p.MATERIAL, ChainSolver(linkage, bar_p.MATERIAL)).stiffness
