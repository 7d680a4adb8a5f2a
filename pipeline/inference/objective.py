"""What a fit makes least: a function of the free parameters of a model.

At given parameters the true inputs of every row are those that fit best (`pipeline.inference.residual`), found by
Gauss-Newton steps row by row until they settle. The same parameters give the same sum of squares wherever an
evaluation begins: where it begins saves iterations, no more. At the inputs that fit best the derivatives that the
weights have by the parameters cancel (envelope theorem), so the gradient of chi-square is that of the residual alone.
What was written about the rig is eliminated along the line that the load cases have of it
(`pipeline.inference.eliminated`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.contact_branches import begun, kinked, on_best_sides
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model
from pipeline.inference.nuisances import departures, nominals
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.inference.residual import Residual, residual
from pipeline.inference.settings import INPUTS
from vjm.work import over

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Evaluation:
    """An objective at values (P,) of its free parameters.

    settled: whether the inputs are those that fit best; else the sum of squares is an estimate. rounds: predictions of
    the campaign that it took.
    """

    objective: Objective
    values: Array
    prediction: Prediction
    residual: Residual
    settled: bool
    rounds: int

    @property
    def lost(self) -> int:
        """Rows without an equilibrium."""
        return int(self.prediction.lost.sum())

    @property
    def residuals(self) -> Array:
        """(N + 1,) as `Residual.aimed`."""
        return self.residual.aimed

    @property
    def jacobian(self) -> Array:
        """(N + 1, P) as `Residual.aimed_by`."""
        return self.with_slopes.residual.aimed_by

    @cached_property
    def with_slopes(self) -> Evaluation:
        """The same, with derivatives by the free parameters."""
        if self.prediction.by_free.shape[-1] == len(self.objective.model.free):
            return self
        it = self.objective
        there = predict(
            it.model.at(self.values), it.load_cases, start=self.prediction, shift=self.prediction.shift
        )
        there = it.about(there)
        return replace(self, prediction=there, residual=residual(it.load_cases, there))

    def settle(self, within: float = 0.0) -> Evaluation:
        """The same with inputs that are settled, known as far as chi-square is wanted (`within` how much), or as far as
        the work of a fit allows."""
        it, here, found, rounds = self.objective, self.prediction, self.residual, self.rounds
        slopes = here.by_free.shape[-1] == len(it.model.free)
        model, total, same = it.model.at(self.values), float(found.aimed @ found.aimed), np.inf
        while True:
            off = _off(here, found)
            settled = off.max(initial=0.0) <= INPUTS.near or same <= INPUTS.same * max(
                1.0, total / found.aimed.size
            )
            last = over() or rounds >= self.rounds + INPUTS.rounds
            if settled or last or float(np.sum(off**2)) <= within:
                return Evaluation(it, self.values, here, found, bool(settled), rounds)
            here = it.about(predict(model, it.load_cases, slopes, start=here, shift=found.shift))
            found = residual(it.load_cases, here)
            before, total, rounds = total, float(found.aimed @ found.aimed), rounds + 1
            same = abs(total - before)


@dataclass(frozen=True, eq=False)
class Objective:
    """Whitened residuals of the rows of load cases as a function of the free parameters of a model."""

    model: Model
    load_cases: LoadCases

    def at(
        self, values: Array, near: Prediction | None = None, slopes: bool = True, within: float = 0.0
    ) -> Evaluation:
        """Its value at values (P,), found from the states and the inputs of a prediction of a like model.

        within: chi-square by which the value may be off; no input is looked for that can change it by less.
        """
        model = self.model.at(values)
        if kinked(model):
            here = on_best_sides(model, self.load_cases, near)
        else:
            shift = begun(model, self.load_cases, near)
            here = predict(model, self.load_cases, slopes, start=near, shift=shift)
        here = self.about(here)
        found = residual(self.load_cases, here)
        return Evaluation(self, values, here, found, settled=False, rounds=1).settle(within)

    def about(self, here: Prediction) -> Prediction:
        """The prediction with what was written about the rig, along the line of the load cases."""
        if self.load_cases.by_nominal is None:
            return here
        return replace(here, nominal=self.departure, by_nominal=self.load_cases.by_nominal)

    @cached_property
    def departure(self) -> Array:
        """(K,) standard deviations from what was written at which the model is."""
        return departures(self.model, nominals(self.load_cases.campaign))


def _off(here: Prediction, found: Residual) -> Array:
    """(R,) by how many of its sigmas an input that fits best is off the one near which a row was linearised, at
    most."""
    sigma = found.load_cases.input_sigma
    off = np.divide(np.abs(found.shift - here.shift), sigma, out=np.zeros_like(sigma), where=sigma > 0.0)
    return np.asarray(off.max(axis=1, initial=0.0))
