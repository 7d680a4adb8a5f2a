"""Stiffness of a whole manipulator at rest: closed forms, symmetry, explicit loops, and bars added in parallel."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.vjm.manipulator.example import (
    ABOUT_Y,
    ABOUT_Z,
    AXIAL,
    BENDING,
    DRIVE,
    FOOT,
    LENGTH,
    POINTS,
    WIDTH,
    orthoglide,
    pair,
    relative,
    under,
    universal,
)
from tests.vjm.strategies import bar_stiffness, fixed_seed
from vjm import paper
from vjm.frames import POSE_NAMES
from vjm.manipulator.freedom import LOOSE, RIGID
from vjm.manipulator.measures import principal, rotational, translational
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest
from vjm.parts import Actuator, Frame, Leg, Part, elastic, hinge
from vjm.stiffness import loaded_stiffness

K = paper.BAR_STIFFNESS
points = st.tuples(*[st.floats(-90.0, 90.0)] * 3).map(np.array)


def at_rest(whole: Manipulator, point: np.ndarray) -> np.ndarray:
    found = stiffness_at_rest(whole, postures(whole, point))
    assert np.all(found.found), found.reason
    return found.total


def test_isotropic_posture_in_closed_form() -> None:
    """There a leg carries its own axial force, Mx and My, each through springs in series: drive, foot, Eq. 11."""
    k = at_rest(orthoglide(pair()), np.zeros(3))
    axial = 1 / (1 / DRIVE + FOOT / AXIAL + 1 / (2 * K[0, 0]))
    torsion = 1 / (FOOT / (BENDING / 1.3) + 1 / (2 * K[3, 3] + WIDTH**2 / 2 * K[1, 1]))
    bending = 1 / (FOOT / BENDING + 1 / (WIDTH**2 / 2 * K[0, 0]))
    np.testing.assert_allclose(np.diag(k), [axial] * 3 + [torsion + bending] * 3, rtol=1e-12)
    assert relative(k, np.diag(np.diag(k))) < 1e-12


@pytest.mark.parametrize("linkage", [pair(), pair(radial=1e-5, tilt=1e-7), universal(2 * K)])
def test_isotropic_posture_is_equal_in_all_directions(linkage: tuple[Part, ...]) -> None:
    k = at_rest(orthoglide(linkage), np.zeros(3))
    for block in (translational(k), rotational(k)):
        values = principal(block)
        assert np.ptp(values) < 1e-9 * values[0]


@fixed_seed(21)
@given(bar_stiffness(), points, st.sampled_from([0.0, 1e-5]))
def test_pseudo_rigid_bars_are_explicit_loops(bar: np.ndarray, point: np.ndarray, give: float) -> None:
    whole = orthoglide(pair(bar, radial=give, tilt=1e-2 * give))
    state = under(whole, postures(whole, point[None]), np.zeros(6))
    assert state.converged.all() and state.unstable.tolist() == [0]
    assert relative(loaded_stiffness(state)[0], at_rest(whole, point)) < 1e-6


def test_refined_bars_have_the_same_stiffness_at_rest() -> None:
    lumped, refined = (orthoglide(pair(segments=n)) for n in (0, 3))
    k = loaded_stiffness(under(refined, postures(refined, POINTS), np.zeros(6)))
    assert relative(k, at_rest(lumped, POINTS)) < 1e-9


def offset_bar(bar: np.ndarray, side: float) -> tuple[Part, ...]:
    """One bar of the parallelogram on its own pins."""
    there, back = (Frame(np.array([0.0, 0.0, sign * side * WIDTH / 2])) for sign in (1.0, -1.0))
    return ABOUT_Z, there, ABOUT_Y, elastic(LENGTH, bar), ABOUT_Y, back, ABOUT_Z


@fixed_seed(22)
@given(bar_stiffness(), points)
def test_a_second_bar_on_the_same_pins_lowers_no_stiffness(bar: np.ndarray, point: np.ndarray) -> None:
    """Parallel springs add positive semi-definite matrices, and series and elimination keep their order.

    It holds against one bar on its pins, and against both bars put together as one of 2 K_b in the middle.
    """
    two = at_rest(orthoglide(pair(bar)), point)
    root = np.sqrt(np.diag(two))
    for one in (offset_bar(bar, -1.0), offset_bar(bar, 1.0), universal(2 * bar)):
        more = (two - at_rest(orthoglide(one), point)) / root / root[:, None]
        assert np.linalg.eigvalsh(more)[0] > -1e-9
        assert np.trace(more) > 1e-3


def test_measures_are_what_single_forces_and_moments_meet() -> None:
    k = at_rest(orthoglide(pair()), POINTS[1])
    compliance = np.linalg.inv(k)
    np.testing.assert_allclose(translational(k), np.linalg.inv(compliance[:3, :3]), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(rotational(k), np.linalg.inv(compliance[3:, 3:]), rtol=1e-9, atol=1e-3)


def test_flexible_axes_lower_both() -> None:
    for point in POINTS:
        solid, soft = (at_rest(orthoglide(pair(radial=r, tilt=0.0)), point) for r in (0.0, 1e-5))
        assert np.all(principal(translational(soft)) < principal(translational(solid)))
        assert np.all(principal(rotational(soft)) < principal(rotational(solid)))


def test_unreached_and_rigid_members_say_so_and_spoil_no_other() -> None:
    whole = orthoglide(pair())
    found = stiffness_at_rest(whole, postures(whole, [[0.0, 400.0, 0.0], [10.0, 0.0, 0.0]]))
    assert found.found.tolist() == [False, True]
    assert not found.by_leg[0].any()
    np.testing.assert_array_equal(found.total[1], at_rest(whole, np.array([10.0, 0.0, 0.0])))
    idle = (ABOUT_Z, *pair())
    loose = orthoglide(idle)
    said = stiffness_at_rest(loose, postures(loose, [[0.0, 0.0, 0.0]])).reason
    assert said.tolist() == [f"leg x {LOOSE}"]


def test_two_refined_links_of_a_leg_are_two() -> None:
    """Segments change nothing at rest, however many bars of a leg have them."""
    arm = Manipulator("arm", (Leg("arm", _two_links(0)),), LENGTH)
    fine = Manipulator("arm", (Leg("arm", _two_links(3)),), LENGTH)
    at = postures(arm, np.array([[LENGTH + FOOT, 0.0, 0.0]]))
    expected = stiffness_at_rest(arm, at).total[0]
    assert relative(loaded_stiffness(under(fine, at, np.zeros(6)))[0], expected) < 1e-8


def _two_links(segments: int) -> tuple[Part, ...]:
    return elastic(LENGTH, K, segments), elastic(FOOT, 2.0 * K, segments)


def test_two_refined_parallelograms_of_a_leg_are_two() -> None:
    """Second bars too have coordinates of their own."""
    across = Frame(rotation=np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]))
    k = []
    for segments in (0, 2):
        linkage = pair(segments=segments)[1]
        whole = Manipulator("two", (Leg("two", (linkage, across, linkage)),), LENGTH)
        at = postures(whole, np.array([[2.0 * LENGTH, 0.0, 0.0, np.pi / 2, 0.0, 0.0]]))
        k.append(loaded_stiffness(under(whole, at, at.pose, POSE_NAMES))[0])
    # Turns about the hinges have no stiffness, so entries are compared with the largest of their kind.
    sizes = np.array([1.0] * 3 + [LENGTH] * 3)
    scaled = [each / (sizes[:, None] * sizes) for each in k]
    assert np.max(np.abs(scaled[1] - scaled[0])) < 1e-8 * np.max(np.abs(scaled[0]))


def test_a_leg_that_is_rigid_or_loose_says_which() -> None:
    """Balls at both ends let a link turn about itself; a drive and rigid parts resist in most directions rigidly."""
    spin = hinge((1.0, 0.0, 0.0))
    loose = Manipulator("m", (Leg("a", (spin, elastic(LENGTH, K), spin)),), LENGTH)
    rigid = Manipulator("m", (Leg("a", (Actuator("translation", (0.0, 0.0, 1.0), 9.0),)),), LENGTH)
    for whole, point, why in ((loose, LENGTH, LOOSE), (rigid, 0.0, RIGID)):
        said = stiffness_at_rest(whole, postures(whole, [[point, 0.0, 0.0]])).reason
        assert said.tolist() == [f"leg a {why}"]
