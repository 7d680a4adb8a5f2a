"""AIC finds one strong effect as the exhaustive search does; all approaches on one case; its order is the expected."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.extrapolation.approaches import (
    AIC,
    APPROACHES,
    DIAGNOSIS,
    GAUSSIAN,
    PLAIN,
    POLYNOMIAL,
    REFINED,
    TRUTH,
    Book,
    compared,
)
from pipeline.assessment.extrapolation.forward import aic, forward
from pipeline.assessment.extrapolation.yardstick import yardstick
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction
from pipeline.selection.fit_cache import FitCache
from tests.pipeline.assessment.extrapolation.stiff import stiff
from vjm.effects import catalogue
from vjm.effects.base import Effect

pytestmark = pytest.mark.long

FEW = (ALWAYS, "modulus_error", "joint_torsional_stiffness", "load_offset")

MANY = (
    *FEW,
    "dimension_error",
    "bar_initial_bow",
    "load_misalignment",
    "axis_flexibility",
    "self_weight",
)


def few() -> dict[str, Effect]:
    return {name: catalogue()[name] for name in FEW}


def shelf_with(known: Mapping[str, Effect]) -> FitCache:
    return FitCache(load_cases(stiff().campaign), Model(), known, lambda _: None)


@pytest.fixture(scope="module")
def book() -> Book:
    return compared(stiff(), few())


def exhaustive(cache: FitCache) -> frozenset[str]:
    """Forward selection that fits every candidate."""
    here: frozenset[str] = frozenset()
    while True:
        able = [name for name, effect in cache.candidates.items() if here >= set(effect.includes)]
        better = min((here | {name} for name in able), key=lambda names: aic(cache, names))
        if not aic(cache, better) < aic(cache, here):
            return here
        here = better


def test_aic_picks_the_strong_effect_as_an_exhaustive_search_does() -> None:
    found = forward(shelf_with(few()))
    assert {ALWAYS, "modulus_error"} <= found
    assert found == exhaustive(shelf_with(few()))


@pytest.mark.long
def test_what_is_not_fitted_would_not_have_been_the_best() -> None:
    """Of many candidates as well, most of which need no fit. Without kinks: a fit of those has several minima, and
    which one is found depends on where it begins."""
    known = {name: catalogue()[name] for name in MANY}
    cache, whole = shelf_with(known), shelf_with(known)
    assert forward(cache) == exhaustive(whole)
    assert len(cache.fits) < 2 * len(whole.fits) / 3


@pytest.mark.long
def test_every_approach_answers(book: Book) -> None:
    assert set(book.errors) == set(book.seconds) == set(APPROACHES) and not book.failed
    assert book.verdict == "identified" and set(book.sets[0]) == {ALWAYS, "modulus_error"}


def test_the_order_is_that_of_what_is_known(book: Book) -> None:
    """Bars without their geometric stiffness are far off; what is learned helps inside; physics extrapolates."""
    inside = {name: error.inside for name, error in book.errors.items()}
    outside = {name: error.outside for name, error in book.errors.items()}
    assert inside[PLAIN] > 10.0 * inside[REFINED]
    assert max(inside[POLYNOMIAL], inside[GAUSSIAN]) < 0.5 * inside[REFINED]
    assert outside[TRUTH] < outside[DIAGNOSIS] < 0.5 * outside[GAUSSIAN]
    assert outside[AIC] < outside[GAUSSIAN]


def test_an_approach_that_fails_says_why() -> None:
    book = Book(yardstick(stiff()))

    def fails() -> Prediction:
        raise RuntimeError("no equilibrium")

    book.enter(AIC, fails)
    assert book.failed == {AIC: "RuntimeError: no equilibrium"} and AIC not in book.errors
