"""K_b by a chain of slices: the direct solver on the same mesh, laws, any way to cut and to join.

Relative figures are beside the entries themselves; 1e-8 of K22 is 2e-7 N/mm, where a slice has entries of 1e7.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fem.beam import Segment, stepped_stiffness
from fem.factor import SolveError
from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.material import Isotropic
from fem.section_constants import section_constants
from fem.slices import stiffness
from fem.slices.classes import mirrors, said
from fem.slices.condensed import Prism
from fem.slices.stiffness import chain_stiffness, first_half
from fem.space import Space
from meshes.bar import Bar, Lug
from meshes.extrusion import drawn, kind_of, section_mesh, stepped_thickness
from meshes.layers import Sweep, as_sweep
from meshes.plane import PlaneMesh
from meshes.resolution import Resolution
from meshes.section import Rectangle, Tube
from meshes.solid import Floats, SolidMesh
from meshes.store import mesh_bar
from tests.fem import bar_p
from tests.fem.slices.oracle import by_strain_energy
from tests.meshes.solids import section_solid, section_sweep

COARSE = Resolution(bar_p.SIZE)


def bar_p_sweep(thickness: list[float] | Floats, level: int = 1) -> Sweep:
    return section_sweep(bar_p.SECTION, Resolution(bar_p.SIZE, level), thickness)


def uniform(count: int) -> list[float]:
    return [bar_p.LENGTH / count] * count


def block(y: tuple[float, float], z: tuple[float, float], cells: int = 2) -> PlaneMesh:
    """A rectangle anywhere in the section's plane, in nine-node quadrilaterals: a section without mirrors."""
    points = section_mesh(Rectangle(1.0, 1.0), Resolution(1.0, cells))
    low, high = np.array([y[0], z[0]]), np.array([y[1], z[1]])
    return PlaneMesh(low + (points.points + 0.5) * (high - low), points.cells)


MESHES = {
    "graded by gmsh": lambda: bar_p.mesh(1),
    "lugs": lambda: mesh_bar(Bar(bar_p.SECTION, bar_p.LENGTH, Lug(6.0, 12.0, 15.5)), COARSE),
    "53 equal layers": lambda: section_solid(bar_p.SECTION, COARSE, uniform(53)).mesh,
    "stepped": lambda: section_solid(bar_p.SECTION, COARSE, stepped_thickness(310.0, (3, 2, 5))).mesh,
    "tube of 27-node cells": lambda: section_solid(Tube(12.0, 2.0), Resolution(5.0), [10.0] * 31).mesh,
}


@pytest.fixture(scope="module", params=list(MESHES))
def model(request: pytest.FixtureRequest) -> LinearModel:
    """The clamped bar with the direct solver."""
    mesh: SolidMesh = MESHES[request.param]()
    return LinearModel(single_bar(Space.of(mesh), bar_p.LENGTH), bar_p.MATERIAL)


def test_equals_the_direct_solver(model: LinearModel) -> None:
    """To 1e-8, in classes and as a whole; to 5e-9 where the energy of the direct solver's field is not rounded."""
    sweep = as_sweep(model.linkage.members[0].space.mesh).sweep
    assert mirrors(sweep) == (1, 2) and said(mirrors(sweep)) == "quarter section"
    exact = by_strain_energy(model)
    for axes in ((1, 2), (1,), (2,), ()):
        found = chain_stiffness(sweep, model.material, axes)
        np.testing.assert_array_equal(found, found.T)
        np.testing.assert_allclose(bar_p.entries(found), bar_p.entries(exact), rtol=5e-9)
        np.testing.assert_allclose(bar_p.entries(found), bar_p.entries(model.stiffness), rtol=1e-8)
        assert np.abs(bar_p.scaled(found - exact + np.diag(np.diag(exact))) - np.eye(6)).max() < 1e-8


@pytest.mark.long
@pytest.mark.parametrize("layers", [64, 200])
def test_many_layers_keep_their_digits(layers: int) -> None:
    """101 000 unknowns and more: 1e-9 after six and seven doublings, and each mirrored bar's K26 = -K22 L/2."""
    made = section_solid(bar_p.SECTION, Resolution(bar_p.SIZE, 2), uniform(layers))
    exact = by_strain_energy(LinearModel(single_bar(Space.of(made.mesh), bar_p.LENGTH), bar_p.MATERIAL))
    for axes in ((1, 2), ()):
        found = chain_stiffness(made.sweep, bar_p.MATERIAL, axes)
        np.testing.assert_allclose(bar_p.entries(found), bar_p.entries(exact), rtol=1e-9)


@pytest.mark.parametrize("count", [2, 3, 37, 512, 2048])
def test_bending_of_a_bar_that_is_its_own_mirror_image(count: int) -> None:
    """K26 = -K22 L/2 and K35 = K33 L/2 to 2e-9 after up to eleven doublings; what vanishes by symmetry is zero."""
    k = chain_stiffness(bar_p_sweep(uniform(count)), bar_p.MATERIAL)
    assert k[1, 5] == pytest.approx(-k[1, 1] * bar_p.LENGTH / 2, rel=2e-9)
    assert k[2, 4] == pytest.approx(k[2, 2] * bar_p.LENGTH / 2, rel=2e-9)
    zero = np.ones((6, 6), dtype=bool)
    for i, j in bar_p.ENTRIES.values():
        zero[i, j] = zero[j, i] = False
    assert np.abs(bar_p.scaled(k)[zero]).max() == 0.0


@given(count=st.integers(1, 60))
@settings(max_examples=8, deadline=None)
def test_doubling_equals_joining_one_by_one(count: int) -> None:
    """To 1e-10 beside the entries' own size, with the middle plane of an even number or without."""
    sweep = bar_p_sweep([0.9] * count)
    k = chain_stiffness(sweep, bar_p.MATERIAL)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stiffness, "powers", lambda unit, n, rigid: [unit] * n)
        patch.setattr(stiffness, "first_half", lambda sweep: None)
        other = chain_stiffness(sweep, bar_p.MATERIAL)
    np.testing.assert_allclose(bar_p.entries(k), bar_p.entries(other), rtol=1e-10)


@given(order=st.permutations([0.5, 0.5, 0.5, 2.0, 2.0, 8.0, 8.0, 8.0]))
@settings(max_examples=5, deadline=None)
def test_order_of_joining(order: list[float]) -> None:
    """The same layers from tip to base: the bar mirrored along x, moved at what was its base."""
    k = chain_stiffness(bar_p_sweep(order), bar_p.MATERIAL)
    back = chain_stiffness(bar_p_sweep(order[::-1]), bar_p.MATERIAL)
    # How the tip moves with the base of a rigid bar, and how a motion looks in the mirror x -> -x.
    carried, mirror = np.eye(6), np.diag([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
    carried[1, 5], carried[2, 4] = sum(order), -sum(order)
    wanted = mirror @ carried.T @ k @ carried @ mirror
    np.testing.assert_allclose(bar_p.scaled(back), scaled_like(wanted, back), atol=1e-9)


def scaled_like(k: Floats, other: Floats) -> Floats:
    """A 6x6 divided by the roots of another one's diagonal."""
    root = np.sqrt(np.diag(other))
    return np.asarray(k / np.outer(root, root))


def test_section_without_mirrors_and_its_mirror_image() -> None:
    """A block off the axis: one class, the direct solver, and the mirrored section's K_b is the mirrored K_b."""
    here = drawn(block((1.0, 7.0), (-2.0, 8.0)), "hexahedron20", [5.0] * 8)
    there = drawn(block((-7.0, -1.0), (-2.0, 8.0)), "hexahedron20", [5.0] * 8)
    assert mirrors(here) == () and said(mirrors(here)) == "whole section"
    k, mirrored = (chain_stiffness(s, bar_p.MATERIAL) for s in (here, there))
    flip = np.diag([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    np.testing.assert_allclose(scaled_like(flip @ mirrored @ flip, k), bar_p.scaled(k), atol=1e-11)
    assert abs(bar_p.scaled(k)[0, 5]) > 0.1
    half = drawn(block((-3.0, 3.0), (-2.0, 8.0)), "hexahedron20", [5.0] * 8)
    assert mirrors(half) == (1,) and said(mirrors(half)) == "half section"
    one, other = (chain_stiffness(half, bar_p.MATERIAL, axes) for axes in ((1,), ()))
    np.testing.assert_allclose(bar_p.scaled(one), scaled_like(other, one), atol=1e-10)
    with pytest.raises(ValueError, match="not their own mirror images"):
        chain_stiffness(half, bar_p.MATERIAL, (2,))


@given(scale=st.floats(0.01, 100.0))
@settings(max_examples=6, deadline=None)
def test_lengths_and_modulus(scale: float) -> None:
    """All lengths times s: forces per length grow with s, moments per length with s², moments per angle with s³."""
    section = Rectangle(6.0, 10.0)
    large = Rectangle(6.0 * scale, 10.0 * scale)
    k = chain_stiffness(section_sweep(section, Resolution(3.0), [4.0] * 11), bar_p.MATERIAL)
    found = chain_stiffness(
        section_sweep(large, Resolution(3.0 * scale), [4.0 * scale] * 11),
        replace(bar_p.MATERIAL, E=2.0 * bar_p.MATERIAL.E),
    )
    powers = np.array([0.5] * 3 + [1.5] * 3)
    wanted = 2.0 * k * scale ** (powers[:, None] + powers)
    np.testing.assert_allclose(bar_p.scaled(found), scaled_like(wanted, found), atol=1e-10)


def test_beside_the_beam() -> None:
    """Timoshenko with restrained warping: rigid ends hold the contraction and the warping, 0.1 to 1.5 % more."""
    constants = section_constants(bar_p.SECTION, bar_p.MATERIAL.nu)
    beam = stepped_stiffness([Segment.of(constants, bar_p.MATERIAL, bar_p.LENGTH)])
    k = chain_stiffness(bar_p_sweep(stepped_thickness(bar_p.LENGTH, (8, 8, 8)), 2), bar_p.MATERIAL)
    ratio = bar_p.entries(k) / bar_p.entries(beam)
    assert np.all(ratio > 1.001) and np.all(ratio < 1.03)


def test_halves_are_found_only_where_they_are() -> None:
    assert first_half(bar_p_sweep([1.0, 2.0, 2.0, 1.0])) is not None
    assert first_half(bar_p_sweep([1.0, 2.0, 1.0])) is None
    assert first_half(bar_p_sweep([1.0, 2.0, 1.0, 2.0])) is None


def test_a_material_without_stiffness_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """What Cholesky refuses is a SolveError, not a number."""
    monkeypatch.setattr(Isotropic, "shear_modulus", property(lambda self: -1.0))
    with pytest.raises(SolveError, match="not positive definite"):
        chain_stiffness(bar_p_sweep(uniform(4)), bar_p.MATERIAL)


def test_rigid_motions_of_a_slice_bear_no_force() -> None:
    """What is left is the rounding of one product, 2e-15; without `without_rigid` it doubles, to 7e-14 here."""
    sweep = section_sweep(bar_p.SECTION, COARSE, [0.5])
    assert kind_of(bar_p.SECTION) == "hexahedron20"
    view = stiffness.ClassOfLayer(sweep.shapes[0], {})
    matrix = stiffness.LayerMatrix.of(sweep.shapes[0], bar_p.MATERIAL).stiffness(0.5)
    prism = view.slice(matrix, 0.5).ends
    assert isinstance(prism, Prism)
    rigid = view.rigid[0]
    for count in (1, 2, 4, 8, 16):
        behind = stiffness.rigid_at(rigid, prism.length)
        force = prism.first @ rigid + prism.coupling @ behind
        size = np.abs(prism.first).max() * np.abs(behind).max(axis=0)
        assert np.abs(force / size).max() < 1e-14, count
        prism = stiffness.doubled(prism, rigid)[0]
