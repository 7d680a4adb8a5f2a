"""Fits that stay far above noise and hardly fall are ended; those that may still matter are not."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.inference.levenberg_marquardt import LATE, drags
from pipeline.inference.solvers import DRAGGING

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
