"""Fits that stay far above noise and hardly fall are ended; those that may still matter are not."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.inference.levenberg_marquardt import LATE, PACE, beaten, drags
from pipeline.inference.solvers import ALL, DRAGGING, NO_NEARER, Effort, idle

ROWS = 100


@pytest.mark.parametrize(
    ("first", "share", "ends"),
    [
        # Sums of squares that fall by this part of the excess in all.
        (5000.0, 0.5 * DRAGGING, True),
        (5000.0, 3.0 * DRAGGING, False),
        # Less than twice noise: a verdict may hang on it.
        (150.0, 0.0, False),
    ],
)
def test_what_drags_far_above_noise_ends(first: float, share: float, ends: bool) -> None:
    past = list(np.linspace(first, first - share * (first - ROWS), LATE + 1))
    assert drags(past, ROWS) == ends
    assert not drags(past[1:], ROWS)


@pytest.mark.parametrize(
    ("known", "fall", "left", "ends"),
    [
        # By a tenth in three evaluations, and thirty more: a twenty-fourth of a thousand times what is known.
        (1e3, 0.9, 30, True),
        # By half: a thousandth of it.
        (1e3, 0.5, 30, False),
        (1e3, 0.5, 3, True),
        # Less than ten times what is known, where it stays.
        (2e5, 1.0, 30, False),
    ],
)
def test_what_would_not_come_near_a_known_sum_of_squares_ends(
    known: float, fall: float, left: int, ends: bool
) -> None:
    past = [1e6 * fall ** (k / PACE - 1.0) for k in range(PACE + 1)]
    assert past[-1] == pytest.approx(1e6)
    assert beaten(past, left, ROWS, Effort(known=known)) == ends
    assert not beaten(past[1:], left, ROWS, Effort(known=known)), "too early to say"
    assert not beaten(past, left, ROWS, ALL), "nothing is known"


def test_noise_is_as_good_as_anything_known() -> None:
    assert not Effort(known=1e-9).beats(NO_NEARER * ROWS, ROWS)
    assert Effort(known=1e-9).beats(1.01 * NO_NEARER * ROWS, ROWS)


def test_only_far_from_noise_a_thousandth_of_what_is_left_is_nothing() -> None:
    assert idle(1.9 * ROWS, ROWS) == 0.0
    assert idle(1e6 + ROWS, ROWS) == pytest.approx(0.1 * DRAGGING * 1e6)
