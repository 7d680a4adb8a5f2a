"""Inertia, critical loads and branches against closed forms derived by hand from the geometry."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.vjm.closed_forms import middle_uniform, tip_tension_branch
from tests.vjm.strategies import LENGTH, WIDTH, angles, bar_stiffness, fixed_seed
from vjm import closed_forms, paper
from vjm.branch import branch_amplitude, buckled_path
from vjm.critical import critical_load, drive
from vjm.frames import move_stiffness
from vjm.lagrangian import layout
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stability import negative_eigenvalues, reduced_modes

GUIDED = ("z", "rx", "ry", "rz")
PLACES = ("tip", "middle", "base")


def linkage(q: float = 0.0, place: str = "tip", k: np.ndarray = paper.BAR_STIFFNESS) -> Parallelogram:
    return Parallelogram(LENGTH, WIDTH, k, q, spring_at=place)  # type: ignore[arg-type]


def uniform_bar(bending: float, axial: float) -> np.ndarray:
    """K_b of a slender bar with EI_y given in plane; sideways the same."""
    k = np.diag([axial, 12 / LENGTH**2, 12 / LENGTH**2, 1.0, 4.0, 4.0])
    k[1, 5] = k[5, 1] = -6 / LENGTH
    k[2, 4] = k[4, 2] = 6 / LENGTH
    k[1:, 1:] *= bending / LENGTH
    return k


@pytest.mark.parametrize("held", [GUIDED, ("y", *GUIDED)])
@pytest.mark.parametrize("degrees", [0, 30, pytest.param(-30, marks=pytest.mark.long)])
@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("sign", [-1, 1])
def test_critical_load_of_every_spring_placement(sign: int, place: str, degrees: int, held: tuple) -> None:
    mechanism = linkage(np.radians(degrees), place)
    expected = closed_forms.in_plane_critical(mechanism)
    load = expected.compression if sign < 0 else expected.tension
    found = critical_load(mechanism, held, sign)  # type: ignore[arg-type]
    assert found.found == (load is not None)
    if load is None:
        assert found.searched_load < -1e5 and "none found" in found.reason
    else:
        assert found.load == pytest.approx(load, rel=1e-8)
        assert found.unstable == 2


@fixed_seed(10)
@given(bar_stiffness(), angles, st.sampled_from(["middle", "base"]))
def test_critical_compression_of_any_bar(k: np.ndarray, q: float, place: str) -> None:
    mechanism = linkage(q, place, k)
    load = closed_forms.in_plane_critical(mechanism).compression
    assert load is not None
    travel = -load / (2 * k[0, 0] * np.cos(q) ** 2) / LENGTH
    found = critical_load(mechanism, ("y", *GUIDED), -1, max_strain=1.5 * travel)
    assert found.load == pytest.approx(load, rel=1e-7)


def test_tip_springs_fail_in_tension_only() -> None:
    k = paper.BAR_STIFFNESS
    found = critical_load(linkage(), ("z",), 1)
    rigid = 2 * LENGTH * (k[2, 2] - k[2, 4] ** 2 / k[4, 4])
    # The bar stretches by P/K11 before it turns: the axially rigid formula is low by (K33 - K35²/K55)/K11.
    assert found.load == pytest.approx(rigid / (1 - rigid / (2 * LENGTH * k[0, 0])), rel=1e-9)
    assert found.load == pytest.approx(rigid, rel=1e-3)
    assert not critical_load(linkage(), ("z",), -1).found


def test_base_springs_meet_their_axially_rigid_condition() -> None:
    k = paper.BAR_STIFFNESS.copy()
    k[0, 0] = 1e9
    moved = move_stiffness(k, [-LENGTH, 0, 0])
    p = -0.5 * critical_load(linkage(place="base", k=k), ("y", *GUIDED), -1, max_strain=1e-7).load
    left = (moved[2, 2] + p / LENGTH) * moved[4, 4]
    assert left == pytest.approx((moved[2, 4] - p) ** 2, rel=1e-6)
    assert 2 * p == pytest.approx(5.67e3, rel=2e-3)


def test_middle_springs_of_uniform_bars() -> None:
    bending = 2.0e8
    mechanism = linkage(place="middle", k=uniform_bar(bending, 1e9))
    expected = middle_uniform(bending, LENGTH)
    found = critical_load(mechanism, ("y", *GUIDED), -1, max_strain=1e-7)
    # 1e-6: the axial spring of 1e9 N/mm still gives 2e-8 of the length.
    assert found.load == pytest.approx(expected, rel=1e-6)
    assert closed_forms.in_plane_critical(mechanism).compression == pytest.approx(expected, rel=1e-6)


def test_middle_springs_with_a_rigid_transverse_spring_are_the_two_link_column() -> None:
    bending = 2.0e8
    middle = move_stiffness(uniform_bar(bending, 1e9), [-LENGTH / 2, 0, 0])
    middle[2, 2] = 1e8
    k = move_stiffness(middle, [LENGTH / 2, 0, 0])
    found = critical_load(linkage(place="middle", k=k), ("y", *GUIDED), -1, max_strain=1e-7)
    # The remaining give of the transverse spring, P²/(4 K33 K55), is 4e-7.
    assert found.load == pytest.approx(closed_forms.middle_hinge_only(k, LENGTH), rel=1e-6)
    assert found.load == pytest.approx(-8 * bending / LENGTH**2, rel=1e-6)


@pytest.mark.parametrize("place", PLACES)
def test_sideways_instability_needs_a_lever_behind_the_spring(place: str) -> None:
    mechanism = linkage(place=place)
    expected = closed_forms.out_of_plane_cantilever(mechanism)
    found = critical_load(mechanism, ("z",), -1)
    if expected is None:
        assert not found.found
        return
    assert found.load == pytest.approx(expected, rel=1e-8)
    assert found.unstable == 1
    assert found.direction is not None
    direction = found.direction[layout(mechanism).platform]
    # It moves in y and turns about z, nothing else.
    assert np.abs(direction[[0, 2, 3, 4]]).max() < 1e-6 * np.abs(direction[1])


@pytest.mark.parametrize(
    ("place", "held", "shares", "counts"),
    [
        ("base", ("z",), (0.5, 1.2), (0, 1)),
        ("base", ("y", *GUIDED), (0.9, 0.999, 1.001), (0, 0, 2)),
        ("middle", GUIDED, (0.9, 1.1), (0, 2)),
    ],
)
def test_both_routes_count_the_same_negatives(place: str, held: tuple, shares: tuple, counts: tuple) -> None:
    mechanism = linkage(place=place)
    critical = critical_load(mechanism, held, -1)
    held = ("x", *held)
    for share, count in zip(shares, counts, strict=True):
        state = drive(mechanism, share * critical.displacement, held)
        assert negative_eigenvalues(state, held) == count
        assert np.sum(reduced_modes(state, held).values < 0) == count


def test_modes_keep_the_loops_closed() -> None:
    mechanism = linkage(0.4, "middle")
    held = ("x", "z")
    state = drive(mechanism, -0.02, held)
    vector = reduced_modes(state, held).vectors[:, 0]
    motion = vector[16:22]
    for i, chain in enumerate(mechanism.chains):
        moved = chain.chain.jacobian(state.coordinates[i]) @ vector[8 * i : 8 * i + 8]
        np.testing.assert_allclose(moved, motion, atol=1e-9 * np.abs(vector).max())


def test_post_critical_branch_of_tip_springs() -> None:
    mechanism = linkage()
    critical = critical_load(mechanism, ("y", *GUIDED), 1)
    displacements = critical.displacement + np.array([0.001, 0.01, 0.1, 1.0])
    branch = buckled_path(critical, displacements)
    assert np.all(branch.converged)
    expected = tip_tension_branch(mechanism, branch.pose[:, 0])
    np.testing.assert_allclose(branch.load[:, 0], expected, rtol=1e-9)
    # Both bars turn to the same side: cos a = K11 L / ((K11 - k) x).
    k = paper.BAR_STIFFNESS
    soft = k[2, 2] - k[2, 4] ** 2 / k[4, 4]
    angle = np.arccos(k[0, 0] * LENGTH / ((k[0, 0] - soft) * branch.pose[:, 0]))
    np.testing.assert_allclose(np.abs(branch.q[0][:, 0]), angle, rtol=1e-6)
    np.testing.assert_allclose(branch.q[1][:, 0], branch.q[0][:, 0], rtol=1e-6)


@pytest.mark.parametrize("place", ["middle", "base"])
def test_post_critical_branch_leaves_the_primary_path(place: str) -> None:
    mechanism = linkage(np.pi / 6, place)
    critical = critical_load(mechanism, GUIDED, -1)
    displacements = critical.displacement * np.array([1.001, 1.01, 1.1])
    branch = buckled_path(critical, displacements)
    assert np.all(branch.converged)
    for i, displacement in enumerate(displacements):
        primary = drive(mechanism, displacement, critical.held)
        assert primary.converged and negative_eigenvalues(primary, critical.held) == 2
        assert negative_eigenvalues(branch.member(i), critical.held) == 0
        assert branch.energy[i] < primary.energy
        assert abs(branch_amplitude(critical, branch.unknowns[i])) > 1e-3


def test_branch_is_not_invented_before_the_critical_load() -> None:
    critical = critical_load(linkage(place="base"), ("y", *GUIDED), -1)
    before = buckled_path(critical, [0.5 * critical.displacement])
    assert not before.converged[0]


def test_no_branch_without_critical_load() -> None:
    with pytest.raises(ValueError, match="no branch"):
        buckled_path(critical_load(linkage(), ("z",), -1, steps=4), [-0.1])


def test_a_state_without_a_tangent_has_no_eigenvalues_beside_one_that_has() -> None:
    """A law may have no numbers where a linkage was last tried."""
    mechanism = linkage(place="base")
    state = drive(mechanism, -0.01, GUIDED)
    unknowns = np.stack([state.unknowns, np.full_like(state.unknowns, np.nan)])
    both = replace(
        state,
        unknowns=unknowns,
        memory=np.stack([state.memory] * 2),
        drives=np.stack([state.drives] * 2),
    )
    values = reduced_modes(both, GUIDED).values
    np.testing.assert_array_equal(values[0], reduced_modes(state, GUIDED).values)
    assert np.isnan(values[1]).all()


def test_a_free_mechanism_is_refused() -> None:
    with pytest.raises(ValueError, match="hold z"):
        critical_load(linkage(), ("y",), -1)
    with pytest.raises(ValueError, match="sign"):
        critical_load(linkage(), ("z",), 0)  # type: ignore[arg-type]


def test_euler_loads_of_the_paper_bar() -> None:
    """Section and supports of Timoshenko and Gere; the rounded values use EI of K33 and K22 in Eq. 12."""
    k = paper.BAR_STIFFNESS
    loads = closed_forms.euler_loads(k[2, 2] * LENGTH**3 / 12, k[1, 1] * LENGTH**3 / 12, LENGTH)
    found = (loads.in_plane, loads.guided, loads.clamped, loads.cantilever)
    np.testing.assert_allclose(found, (-40.1e3, -9.23e3, -36.9e3, -2.31e3), rtol=2e-3)
