"""The shipped Orthoglide by virtual springs against its finite elements: three linkages, five postures."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.manipulator.description import read
from pipeline.manipulator.frame import frame_stiffness
from pipeline.manipulator.linkages import Relink, parallelogram, relinked, two_fold_bar
from pipeline.manipulator.table import POSTURES
from tests.vjm.manipulator.example import relative, under
from vjm.effects import catalogue
from vjm.manipulator.effects import with_effect
from vjm.manipulator.measures import principal, rotational, translational
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest
from vjm.stiffness import read_stiffness

LINKAGES = {
    "2x-bar": two_fold_bar(),
    "solid axes": parallelogram(),
    "flexible axes": parallelogram(1.5e-5),
}


@pytest.mark.parametrize("relink", LINKAGES.values(), ids=LINKAGES)
def test_both_models_at_five_postures(relink: Relink) -> None:
    """The bars of both are the 6x6 of Eq. 12 and their theory is linear, so all that may differ is rounding; the two
    share no code beyond the list of parts. 3 % is what the models of the paper differ by."""
    whole = relinked(read("orthoglide").manipulator, relink)
    at = postures(whole, np.array(POSTURES))
    ours = stiffness_at_rest(whole, at).total
    for k in range(len(POSTURES)):
        theirs = frame_stiffness(whole, at.pose[k], tuple(x[k] for x in at.coordinates))
        for block in (translational, rotational):
            np.testing.assert_allclose(principal(block(ours[k])), principal(block(theirs)), rtol=0.03)
        assert relative(ours[k], theirs) < 1e-9


def test_a_leg_that_misses_the_platform_is_refused() -> None:
    whole = read("orthoglide").manipulator
    at = postures(whole, np.zeros(3))
    with pytest.raises(ValueError, match="leg y ends 5 mm from the platform"):
        frame_stiffness(
            whole, at.pose, tuple(x + 5.0 * (k == 1) * np.eye(4)[0] for k, x in enumerate(at.coordinates))
        )


LINEAR = {
    "modulus_error": {"scale": 0.8},
    "bar_stiffness_asymmetry": {"ratio": 1.4},
    "axis_flexibility": {"radial_mm_per_N": 2e-5, "tilt_rad_per_Nmm": 3e-7},
    "joint_torsional_stiffness": {"stiffness_Nmm_per_rad": 2e4},
    "dimension_error": {"length_mm": 0.0, "width_mm": 6.0},
    "base_compliance": {
        "x_mm_per_N": 3e-5,
        "y_mm_per_N": 1e-5,
        "z_mm_per_N": 2e-5,
        "rx_rad_per_Nmm": 1e-9,
        "ry_rad_per_Nmm": 3e-9,
        "rz_rad_per_Nmm": 2e-9,
    },
}


@pytest.mark.parametrize("name", LINEAR)
def test_effects_in_both_models(name: str) -> None:
    """Linear effects at rest: what differs is rounding, and every one of them moves the stiffness by far more."""
    drawn = read("orthoglide").manipulator
    whole = with_effect(drawn, catalogue()[name], LINEAR[name])
    at = postures(drawn, np.array(POSTURES))
    state = under(whole, at, np.zeros(6))
    assert state.converged.all()
    ours, plain = read_stiffness(state), stiffness_at_rest(drawn, at).total
    for k in range(len(POSTURES)):
        theirs = frame_stiffness(whole, at.pose[k], tuple(x[k] for x in at.coordinates))
        assert relative(ours[k], theirs) < 1e-8
        assert relative(ours[k], plain[k]) > 1e-4


@pytest.mark.parametrize(
    "name", ["joint_friction", "bar_initial_bow", "joint_clearance", "bar_length_mismatch"]
)
def test_what_a_linear_frame_cannot_have_is_refused(name: str) -> None:
    drawn, effect = read("orthoglide").manipulator, catalogue()[name]
    at = postures(drawn, np.zeros(3))
    with pytest.raises(ValueError, match="finite elements at rest have"):
        frame_stiffness(with_effect(drawn, effect, effect.typicals), at.pose, at.coordinates)
