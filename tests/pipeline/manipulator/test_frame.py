"""The shipped Orthoglide by virtual springs against its finite elements: three linkages, five postures."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.manipulator.description import read
from pipeline.manipulator.frame import frame_stiffness
from pipeline.manipulator.linkages import Relink, parallelogram, relinked, two_fold_bar
from pipeline.manipulator.table import POSTURES
from tests.vjm.manipulator.example import relative
from vjm.manipulator.measures import principal, rotational, translational
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest

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
