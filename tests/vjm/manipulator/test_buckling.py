"""Legs that buckle: Euler's columns, the whole against a leg between held ends, and lumped bars."""

from __future__ import annotations

import numpy as np
import pytest

from tests.vjm.manipulator.example import LENGTH, POINTS, beam, orthoglide, pair, without_load
from vjm import paper
from vjm.equilibrium import equilibrium
from vjm.manipulator.buckling import critical_load, linear_factor
from vjm.manipulator.legs import critical_forces, segmented, shares
from vjm.manipulator.machine import posture_inputs
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest
from vjm.parts import Leg, elastic
from vjm.stability import negative_eigenvalues

EI_Y, EI_Z = 1.98e8, 4.51e7
SLENDER = beam(6.82e6, EI_Y, EI_Z, 1.08e7, LENGTH)
STIFF = {"drive": 1e6, "bending": 1e12}


def push(k: int) -> np.ndarray:
    return -np.eye(6)[k]


@pytest.mark.parametrize(("about_y", "about_z"), [(EI_Y, EI_Z), (0.5 * EI_Z, EI_Z)])
def test_a_leg_of_stiff_neighbours_is_eulers_column(about_y: float, about_z: float) -> None:
    """Hinges about y let both bars bend in the plane of the linkage, those about z let it bend out of it as one:
    pinned columns both ways. Shear is absent in a slender bar; four segments are 0.1 % good, the stiff neighbours,
    1e6 N/mm against pi² EI / L³ = 15 N/mm, shift less."""
    bar = beam(6.82e6, about_y, about_z, 1.08e7, LENGTH)
    whole = orthoglide(pair(bar, segments=4), **STIFF)
    of = without_load(whole, postures(whole, np.zeros(3)))
    euler = 2 * np.pi**2 * min(about_y, about_z) / LENGTH**2
    assert linear_factor(of, push(0)) == pytest.approx(euler, rel=2e-3)
    found = critical_load(of, push(0))
    assert found.found and found.leg == 0
    assert found.factor == pytest.approx(euler, rel=5e-3)
    assert "leg x loses stability" in found.reason


def test_a_sharp_factor_lies_between_stable_and_unstable() -> None:
    whole = orthoglide(pair(segments=2))
    at = postures(whole, POINTS[0])
    of = without_load(whole, at)
    found = critical_load(of, push(0))
    assert found.sharp and found.leg == 0
    for share, unstable in ((0.9999, 0), (1.0001, 1)):
        state = equilibrium(
            of.mechanism,
            share * found.factor * push(0),
            (),
            found.state,
            follow=True,
            drives=posture_inputs(at),
        )
        assert state.converged and state.unstable == unstable == negative_eigenvalues(state, ())
    assert found.linear == pytest.approx(found.factor, rel=0.02)


@pytest.mark.long
def test_a_leg_that_is_bent_as_it_is_pushed_gives_way_smoothly() -> None:
    """Away from symmetry moments bend the leg: the tangent is least stiff near the linear estimate and then stiffens
    again on a bent path; a tenth of the load takes the platform further than all the load before."""
    whole = orthoglide(pair(segments=2))
    at = postures(whole, POINTS[1])
    of = without_load(whole, at)
    found = critical_load(of, push(0))
    assert found.found and not found.sharp and "smoothly" in found.reason
    assert 0.0 < found.left < 0.05
    assert found.factor == pytest.approx(found.linear, rel=0.03)
    state = found.state
    before = float(np.linalg.norm((state.pose - of.pose)[:3]))
    for share in np.arange(1.0, 1.06, 0.004):
        load = share * found.factor * push(0)
        state = equilibrium(of.mechanism, load, (), state, drives=posture_inputs(at))
        assert state.converged and state.unstable == 0
    assert np.linalg.norm((state.pose - found.state.pose)[:3]) > 5 * before


def test_bars_lumped_at_their_tips_do_not_buckle_in_compression() -> None:
    """As for the single parallelogram: Eq. 1 has no geometric stiffness; far above Euler's load nothing happens."""
    whole = orthoglide(pair())
    of = without_load(whole, postures(whole, np.zeros(3)))
    found = critical_load(of, push(0), largest=3e4)
    assert not found.found and np.isnan(found.factor)
    assert "stable up to 30000" in found.reason and found.left > 0.0


@pytest.mark.parametrize("number", [0, pytest.param(2, marks=pytest.mark.long)])
def test_a_leg_between_held_ends_stands_for_the_whole(number: int) -> None:
    """The sweep's critical force leaves out how the platform gives way: a few per cent, on the path of the worst
    direction."""
    whole = orthoglide(pair())
    at = postures(whole, POINTS[number : number + 1])
    share = shares(whole, at, stiffness_at_rest(whole, at))
    force = critical_forces(whole, at, share.direction).force / np.linalg.norm(share.force, axis=-1)
    leg = int(np.argmin(force[0]))
    direction = -share.force[0, leg] / np.linalg.norm(share.force[0, leg])
    bent = Manipulator("bent", tuple(segmented(each) for each in whole.legs), LENGTH)
    found = critical_load(without_load(bent, at.take(0)), np.concatenate([direction, np.zeros(3)]))
    assert found.factor == pytest.approx(force[0, leg], rel=0.06)


def test_shares_are_the_legs_of_a_statically_determinate_platform() -> None:
    """Without moments a force of the isotropic posture along x is leg x's alone."""
    whole = orthoglide(pair())
    at = postures(whole, np.zeros((1, 3)))
    share = shares(whole, at, stiffness_at_rest(whole, at))
    np.testing.assert_allclose(share.direction[0], np.eye(3), atol=1e-12)
    np.testing.assert_allclose(share.force[0], np.eye(3), atol=1e-12)


def test_one_posture_at_a_time() -> None:
    whole = orthoglide(pair(segments=1))
    with pytest.raises(ValueError, match="one posture at a time"):
        critical_load(without_load(whole, postures(whole, POINTS[:2])), push(0))


def test_bars_lumped_at_their_tips_fail_in_tension() -> None:
    """Spurious, as in the plane of the single parallelogram, and sooner: its closed form with the hinges about z,
    2 L (K22 - K26²/K66). The neighbours and the axial give of leg and drive are left out: 310 mm against 0.8 mm."""
    k = paper.BAR_STIFFNESS
    whole = orthoglide(pair())
    of = without_load(whole, postures(whole, np.zeros(3)))
    expected = 2 * LENGTH * (k[1, 1] - k[1, 5] ** 2 / k[5, 5])
    assert linear_factor(of, -push(0)) == pytest.approx(expected, rel=2e-3)
    assert critical_load(of, -push(0)).factor == pytest.approx(expected, rel=1e-2)


def test_what_never_buckles_needs_a_bound() -> None:
    """Springs at a point have no lever to buckle about."""
    leg = Leg("spring", (elastic(0.0, paper.BAR_STIFFNESS),))
    whole = Manipulator("spring", (leg,), LENGTH)
    of = without_load(whole, postures(whole, np.zeros(3)))
    assert np.isinf(linear_factor(of, push(0)))
    with pytest.raises(ValueError, match="give the largest factor"):
        critical_load(of, push(0))
