"""The words about a curve."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.discover.shape import _of_curve


@pytest.mark.filterwarnings("error")
def test_a_curve_that_was_met_further_to_one_side_is_told_without_the_other_end() -> None:
    at = np.linspace(-0.5, 1.0, 61)
    assert _of_curve(at, at**3) == ["flat about zero, then steeper, as a gap or a dead band"]


@pytest.mark.filterwarnings("error")
def test_a_curve_that_differs_between_its_ends_is_told_so() -> None:
    at = np.linspace(-1.0, 1.0, 61)
    assert "not the same in both directions" in _of_curve(at, np.where(at > 0, 3.0 * at**3, at**3))
    assert "not the same in both directions" not in _of_curve(at, at**3)
