"""What a user could do with a campaign, each as a prediction of what is asked, with its error and its time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from time import process_time

from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.extrapolation.bench import Measured
from pipeline.assessment.extrapolation.correction import corrected
from pipeline.assessment.extrapolation.forward import forward
from pipeline.assessment.extrapolation.polynomial import polynomial
from pipeline.assessment.extrapolation.yardstick import Error, Yardstick, yardstick
from pipeline.discrepancy.gaussian import gaussian
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.selection.diagnosis import Diagnosis, diagnose, suitable
from pipeline.selection.fit_cache import FitCache
from vjm.effects import catalogue
from vjm.effects.base import Effect

PLAIN, REFINED, POLYNOMIAL, GAUSSIAN = "plain", "refined", "polynomial", "Gaussian process"
AIC, DIAGNOSIS, TRUTH = "forward AIC", "diagnosis", "true model"
APPROACHES = (PLAIN, REFINED, POLYNOMIAL, GAUSSIAN, AIC, DIAGNOSIS, TRUTH)
"""In the order of tables. The true model has the hidden effects at their true values: what is left to the best."""


@dataclass(eq=False)
class Book:
    """Errors and seconds of processor time by approach; failed: reasons of those that gave no prediction."""

    yard: Yardstick
    errors: dict[str, Error] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    failed: dict[str, str] = field(default_factory=dict)
    verdict: str = ""
    sets: tuple[tuple[str, ...], ...] = ()
    selected: tuple[str, ...] = ()

    def enter(self, name: str, make: Callable[[], Prediction]) -> None:
        """Judge what an approach predicts."""
        began = process_time()
        try:
            self.errors[name] = self.yard.error(make())
        except (RuntimeError, ArithmeticError, ValueError) as error:
            self.failed[name] = f"{type(error).__name__}: {error}"
        self.seconds[name] = round(process_time() - began, 2)


def compared(it: Measured, known: Mapping[str, Effect] | None = None) -> Book:
    """All approaches on one case; known: effects that can be added, the catalogue by default."""
    book = Book(yardstick(it))
    book.enter(TRUTH, lambda: book.yard.truth)
    book.enter(PLAIN, lambda: predict(Model(), it.asked, slopes=False))
    _residual_ones(it, book)
    _selecting_ones(it, book, catalogue() if known is None else known)
    return book


def _residual_ones(it: Measured, book: Book) -> None:
    """The refined model as it is, and with what was learned from its residual."""
    model = Model().with_effects([catalogue()[ALWAYS]])
    cases = load_cases(it.campaign)
    there = predict(model, it.asked, slopes=False)
    base = predict(model, cases, slopes=False)
    book.enter(REFINED, lambda: there)
    book.enter(POLYNOMIAL, lambda: corrected(polynomial, cases, base, it.asked, there))
    book.enter(GAUSSIAN, lambda: corrected(gaussian, cases, base, it.asked, there))


def _selecting_ones(it: Measured, book: Book, known: Mapping[str, Effect]) -> None:
    """The diagnosis, and AIC, which goes on with the fits that the diagnosis has made."""
    found: list[Diagnosis] = []

    def diagnosed() -> Prediction:
        found.append(diagnose(it.campaign, Model(), known))
        return predict(found[0].model, it.asked, slopes=False)

    def selected() -> Prediction:
        cache = found[0].cache if found else _shelf(it, known)
        names = forward(cache)
        book.selected = cache.order(names)
        return predict(cache.fit(names).model, it.asked, slopes=False)

    book.enter(DIAGNOSIS, diagnosed)
    book.enter(AIC, selected)
    for each in found:
        book.verdict, book.sets = each.verdict, each.sets


def _shelf(it: Measured, known: Mapping[str, Effect]) -> FitCache:
    candidates, _ = suitable(it.campaign, Model(), known)
    return FitCache(load_cases(it.campaign), Model(), candidates, lambda _: None)
