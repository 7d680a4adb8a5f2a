"""An optional part that fails is a sentence of the field; the words of a library say nothing to a user."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from pipeline.answer.record import NominalValue
from pipeline.attempt import Attempts
from vjm.work import TooMuch


def too_long() -> None:
    raise TooMuch("it would take too long")


def of_a_record() -> NominalValue:
    known = {
        "name": "",
        "nominal": 0.0,
        "tolerance": 1.0,
        "value": 0.0,
        "pull": 0.0,
        "unit": "",
        "meaning": "",
    }
    return NominalValue.model_validate({**known, "std": np.nan, "seen": False})


@pytest.mark.parametrize(
    ("work", "said"),
    [
        (too_long, "it would take too long"),
        (lambda: np.linalg.inv(np.zeros((2, 2))), "its equations have no single solution"),
        (lambda: 1.0 / 0, "its numbers leave the range of arithmetic"),
        (
            lambda: np.hstack([np.zeros((2, 1)), np.zeros((3, 1))]),
            "an error that was not foreseen (ValueError)",
        ),
        (of_a_record, "an error that was not foreseen (ValidationError)"),
    ],
)
def test_what_failed_is_said_and_the_rest_stays(work: Callable[[], Any], said: str) -> None:
    attempts = Attempts()
    assert attempts.get("the next test", work, "nothing") == "nothing"
    (sentence,) = attempts.failed
    assert sentence.startswith(f"the next test could not be worked out: {said}")
    assert "dimension" not in sentence and "finite" not in sentence
