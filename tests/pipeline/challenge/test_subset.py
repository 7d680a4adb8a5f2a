"""A few cases of the challenge, whole: measured on finite elements, diagnosed, judged."""

from __future__ import annotations

import pytest

from pipeline.challenge.outcome import outcome


@pytest.mark.parametrize(
    ("number", "score"),
    [
        (28, "right"),  # nothing hidden
        (138, "right"),  # bars of different length
        # Softer bars, or a compliance in series, under axial loads alone.
        pytest.param(15, "in set", marks=pytest.mark.long),
    ],
)
def test_cases_are_answered_as_they_were(number: int, score: str) -> None:
    assert outcome(number, "", "").score == score
