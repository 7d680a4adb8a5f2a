"""Each law against its formula, and its stiffness against differences of its force."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from fem.frame.fibres import HARDENING, plastic_strain
from fem.frame.joints import CENTRING, LINEAR_BELOW, STOP, contact, friction, play, spring
from meshes.solid import Floats

C = np.array([2e-5])
PLACES = {
    "spring": (lambda q: spring(q, C), [-0.03, 0.0, 0.01]),
    "play": (lambda q: play(q, np.array([0.05])), [-0.06, -0.03, 0.0, 0.02, 0.055]),
    "contact": (lambda q: contact(q, C), [-4e-3, -3e-5, 0.0, 1e-5, 1e-5, 2e-3]),
    "friction": (
        lambda q: friction(q, np.zeros(1), np.array([300.0]), np.array([1e-3]))[:2],
        [-3e-3, -5e-4, 2e-3],
    ),
}


@pytest.mark.parametrize("law", PLACES)
def test_stiffness_is_the_slope_of_the_force(law: str) -> None:
    force: Callable[[Floats], tuple[Floats, Floats]] = PLACES[law][0]
    for q in PLACES[law][1]:
        at = np.array([q])
        step = 1e-7 * max(abs(q), 1e-5)
        slope = (force(at + step)[0] - force(at - step)[0]) / (2 * step)
        np.testing.assert_allclose(force(at)[1], slope, rtol=1e-6, atol=1e-6)


def test_no_compliance_is_no_spring() -> None:
    force, stiffness = spring(np.array([1.0]), np.zeros(1))
    assert force[0] == stiffness[0] == 0.0
    assert contact(np.array([1.0]), np.zeros(1))[0][0] == 0.0


def test_contact_is_hertz() -> None:
    loads = np.array([-4000.0, -10.0, 2.0, 900.0])
    approach = C * np.sign(loads) * np.abs(loads) ** (2 / 3)
    np.testing.assert_allclose(contact(approach, C)[0], loads, rtol=1e-12)
    assert contact(C * LINEAR_BELOW ** (2 / 3) / 2, C)[0][0] == pytest.approx(LINEAR_BELOW / 2)


def test_play_is_soft_inside_and_stops_outside() -> None:
    half = np.array([0.05])
    assert play(np.array([0.04]), half)[0][0] == pytest.approx(0.04 * CENTRING)
    assert play(np.array([-0.05 - 4e-5]), half)[0][0] == pytest.approx(-4000.0 - 0.05004 * CENTRING, rel=1e-6)
    assert 4000.0 / STOP <= 4e-5


def test_friction_runs_through_masings_loop() -> None:
    T, presliding = np.array([300.0]), np.array([1e-3])
    slider = np.zeros(1)
    seen = []
    for q in (0.5e-3, 5e-3, 4e-3, 3e-3, 0.0, 5e-3):
        force, _, slider = friction(np.array([q]), slider, T, presliding)
        seen.append(float(force[0]))
    # Up to T, then back by 2 T over twice the presliding.
    np.testing.assert_allclose(seen, [150.0, 300.0, 0.0, -300.0, -300.0, 300.0], atol=1e-9)


def test_a_fibre_hardens_kinematically() -> None:
    limit = np.array([1e-3])
    plastic = np.zeros(1)
    stress = []
    for strain in (0.5e-3, 3e-3, 1.5e-3, -1e-3):
        plastic, _ = plastic_strain(np.array([strain]), plastic, limit)
        stress.append(strain - float(plastic[0]))
    up = 1e-3 + HARDENING * 2e-3
    # It yields back when the stress has fallen by twice the yield stress.
    back = up - 2e-3 + HARDENING * (-1e-3 - (3e-3 - 2e-3))
    np.testing.assert_allclose(stress, [0.5e-3, up, up - 1.5e-3, back], atol=1e-15)
