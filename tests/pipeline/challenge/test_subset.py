"""A few cases of the challenge, whole: measured on finite elements, diagnosed, judged."""

from __future__ import annotations

import pytest

from pipeline.challenge.cases import Kind
from pipeline.challenge.outcome import outcome
from tests.pipeline.challenge.small import first


@pytest.mark.parametrize(
    ("kind", "effect", "scores"),
    [
        ("clean", "", {"right"}),
        ("single", "modulus_error", {"right", "in set"}),
        # Softer bars, or a compliance in series, under axial loads alone.
        ("untold", "modulus_error", {"in set"}),
    ],
)
def test_small_cases_are_answered_rightly(kind: Kind, effect: str, scores: set[str]) -> None:
    assert outcome(first(kind, effect, 0.02 if effect else 0.0), "", "").score in scores
