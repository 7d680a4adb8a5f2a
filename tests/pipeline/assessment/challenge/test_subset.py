"""A few cases of the challenge, whole: measured on finite elements, diagnosed, judged."""

from __future__ import annotations

import pytest

from pipeline.assessment.challenge.cases import Kind
from pipeline.assessment.challenge.outcome import outcome
from tests.pipeline.assessment.challenge.small import first


@pytest.mark.parametrize(
    ("kind", "effect", "least", "score"),
    [
        ("clean", "", 0.0, "right"),
        pytest.param("single", "load_offset", 0.0, "right", marks=pytest.mark.long),
        # Softer bars, or a compliance in series, under axial loads alone.
        pytest.param("untold", "modulus_error", 0.045, "in set", marks=pytest.mark.long),
        pytest.param("untold", "axis_flexibility", 0.0, "in set", marks=pytest.mark.long),
    ],
)
def test_small_cases_are_answered_as_they_were(kind: Kind, effect: str, least: float, score: str) -> None:
    assert outcome(first(kind, effect, least), "", "").score == score


@pytest.mark.long
@pytest.mark.parametrize("number", [249, 274, 286, 346])
def test_what_looks_like_a_mistake_of_the_table_is_named(number: int) -> None:
    """A length beside a second effect is no zero of a sensor, and what a play does at a turn is no bad reading."""
    assert outcome(number, "", "").score == "right"


@pytest.mark.long
def test_a_length_for_which_a_zero_would_do_is_not_named_alone() -> None:
    """A bow, fitted to the readings without a constant of x, leaves 157.7 where bow and length leave 150.1 with one
    number more: less than what tells them apart."""
    it = outcome(474, "", "")
    assert it.score == "in set" and {frozenset(names) for names in it.sets} == {
        frozenset({"bar_initial_bow", "dimension_error"}),
        frozenset({"bar_initial_bow"}),
    }


def test_a_bench_without_a_state_is_an_answer_less_and_no_end(monkeypatch: pytest.MonkeyPatch) -> None:
    def breaks(*_: object) -> None:
        raise RuntimeError("the bench finds no state")

    monkeypatch.setattr("pipeline.assessment.challenge.outcome.true_readings", breaks)
    it = outcome(first("clean"), "", "")
    assert it.score == "failed" and it.error.startswith("bench: case") and "finds no state" in it.error
