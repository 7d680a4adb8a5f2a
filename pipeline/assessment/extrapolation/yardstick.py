"""The error of any prediction in sigmas, with the same weights for all approaches."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.assessment.challenge.cases import ALWAYS, Case
from pipeline.assessment.extrapolation.bench import Measured
from pipeline.compare.error import Discrepancy
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.record import Record
from vjm.effects import catalogue

Mask = NDArray[np.bool_]


class Error(Record):
    """Whitened RMS of exact readings less predicted ones; lost: of the rows outside, those without a prediction."""

    inside: float
    outside: float
    lost: int


@dataclass(frozen=True, eq=False)
class Yardstick:
    """What is asked, and the model with the hidden effects at their true values, whose tangent weighs.

    An input's noise reaches several channels by the stiffness that the rig has, not by that which an approach
    believes: so all are weighed alike. A row that is lost counts `pipeline.inference.residual.LOST` sigmas a channel.
    """

    asked: LoadCases
    inside: Mask
    outside: Mask
    truth: Prediction

    def error(self, found: Prediction) -> Error:
        """Of a prediction of what is asked."""
        # Where the true model itself is lost it has no tangent, and the prediction's own has to do.
        own = self.truth.lost[:, None, None]
        tangent = np.where(own, found.by_inputs, self.truth.by_inputs)
        gap = Discrepancy(self.asked, replace(found, by_inputs=tangent))
        lost = int(found.lost[self.outside].sum())
        return Error(inside=_rms(gap, self.inside), outside=_rms(gap, self.outside), lost=lost)


def yardstick(it: Measured) -> Yardstick:
    """Of a case."""
    truth = predict(true_model(it.case), it.asked, slopes=False)
    return Yardstick(it.asked, it.inside, it.outside, truth)


def true_model(it: Case) -> Model:
    """The model with what is hidden at its true values, and with what every bench has."""
    model = Model().with_effects([catalogue()[name] for name in (ALWAYS, *it.effects)])
    return model.at(np.array([np.clip(it.hidden[each.name], *each.bounds) for each in model.free]))


def _rms(gap: Discrepancy, rows: Mask) -> float:
    found = gap.rms(rows)
    if found is None:
        raise RuntimeError("no row is asked for")
    return found
