"""What a user could do with a campaign, each as a prediction of what is asked, with its error and its time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from time import process_time

import numpy as np
from numpy.typing import NDArray
from sklearn.linear_model import Ridge
from sklearn.model_selection import KFold
from sklearn.preprocessing import PolynomialFeatures

from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.extrapolation.bench import Measured
from pipeline.assessment.extrapolation.correction import Learned, corrected
from pipeline.assessment.extrapolation.forward import forward
from pipeline.assessment.extrapolation.yardstick import Error, Yardstick, yardstick
from pipeline.discrepancy.gaussian import gaussian
from pipeline.discrepancy.regressors import Samples
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
Array = NDArray[np.float64]
DEGREES = (1, 2, 3)
DAMPINGS = (1e-6, 1e-2, 1.0, 1e2)
"""Ridge, in squared sigmas for a coefficient of one sigma: from none to as much as a hundred readings."""
FOLDS = 5


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


def polynomial(own: Samples) -> Learned:
    """A polynomial of all inputs by ridge regression, its degree and its damping by cross-validation; nothing but a
    constant where no polynomial predicts left-out rows better."""
    best, least = (0, 0.0), _left_out(np.zeros((own.values.size, 1)), own, 1.0)
    for degree in DEGREES if own.inputs.shape[1] else ():
        columns = PolynomialFeatures(degree, include_bias=False).fit_transform(own.inputs)
        for damping in DAMPINGS:
            error = _left_out(columns, own, damping)
            if error < least:
                best, least = (degree, damping), error
    return _fitted(own, *best)


def _fitted(own: Samples, degree: int, damping: float) -> Learned:
    mean = float(own.values.mean())
    if not degree:
        return lambda inputs: np.full(len(inputs), mean)
    powers = PolynomialFeatures(degree, include_bias=False).fit(own.inputs)
    ridge = Ridge(damping).fit(powers.transform(own.inputs), own.values)
    return lambda inputs: np.asarray(ridge.predict(powers.transform(inputs)))


def _left_out(columns: Array, own: Samples, damping: float) -> float:
    """Sum of squares, in sigmas, of rows that a fold leaves out; columns (N, K)."""
    count = own.values.size
    if count < 2:
        return 0.0
    total = 0.0
    for kept, left in KFold(min(FOLDS, count), shuffle=True, random_state=0).split(columns):
        ridge = Ridge(damping).fit(columns[kept], own.values[kept])
        total += float(np.sum((own.values[left] - ridge.predict(columns[left])) ** 2))
    return total
