"""What a model predicts for the rows of a campaign, as a record."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.load_cases import INPUTS, LoadCases
from vjm.equilibrium import Equilibrium

Array = NDArray[np.float64]
PLAYS = 2
"""Plays of a bench, at most: one in each bar. Manipulators may have more."""


@dataclass(frozen=True, eq=False)
class Prediction:
    """Readings of a model, rows and channels as in `LoadCases`.

    values: (R, C); pose channels are displacements. by_inputs: (R, C, 7) derivative by what is prescribed at the
    same step, and by its temperature. by_free: (R, C, P), empty where not asked for. shift: (R, 7) by which
    inputs differ from the measured ones. stops: (R, K, 8) force, N, by which a stop is pressed at each play, with the
    sign of the stop and zero where none is, and its derivatives by the inputs; infinite where there is no play.
    slides: (R, K, 9) strain of each play, mm, half its width, and derivatives of the strain by the inputs; the width is
    infinite where there is no play.
    lost: (R,) rows without a stable equilibrium. reasons: of the lost rows, as in `vjm.reasons`. states: of
    each group, to start from again. nominal: (K,) standard deviations from what was written about the rig, at which the
    prediction is; by_nominal: (R, C, K) its derivative by them. Empty where all is exact.
    """

    values: Array
    by_inputs: Array
    by_free: Array
    shift: Array
    stops: Array
    slides: Array
    lost: np.ndarray
    reasons: dict[int, str]
    states: tuple[Equilibrium, ...]
    nominal: Array = field(default_factory=lambda: np.zeros(0))
    by_nominal: Array = field(default_factory=lambda: np.zeros((0, 0, 0)))

    @property
    def as_written(self) -> Array:
        """(R, C) readings where what was written about the rig is true, along the line of the prediction."""
        return self.values - self.by_nominal @ self.nominal if self.nominal.size else self.values

    @property
    def as_measured(self) -> Array:
        """(R, C) the same where the inputs are as they were measured, along the tangent."""
        return np.asarray(self.as_written - np.einsum("rci,ri->rc", self.by_inputs, self.shift))


def moved_along(found: Prediction, shift: Array) -> Prediction:
    """A prediction at inputs shifted by (R, 7), along its own tangent: exact where that is constant."""
    values = found.values + np.einsum("rci,ri->rc", found.by_inputs, shift)
    return replace(found, values=values, shift=shift)


def no_stops(rows: int, plays: int = PLAYS) -> Array:
    """`Prediction.stops` (R, K, 8) of plays that are not there."""
    return np.concatenate([np.full((rows, plays, 1), np.inf), np.zeros((rows, plays, INPUTS))], axis=-1)


def no_slides(rows: int, plays: int = PLAYS) -> Array:
    """`Prediction.slides` (R, K, 9) of plays that are not there."""
    out = np.zeros((rows, plays, 2 + INPUTS))
    out[..., 1] = np.inf
    return out


def zeroed(prediction: Prediction, load_cases: LoadCases) -> Prediction:
    """Readings less those of the first row, in tests that were zeroed there; what is prescribed stays."""
    values = prediction.values.copy()
    by_free = prediction.by_free.copy()
    for k, test in enumerate(load_cases.campaign.tests):
        if test.zero != "first_row":
            continue
        rows = slice(int(load_cases.first[k]), int(load_cases.first[k + 1]))
        out = np.ones(values.shape[1], dtype=bool)
        out[load_cases.channels[rows.start]] = False
        for array in (values, by_free):
            array[rows] -= np.where(out.reshape(-1, *[1] * (array.ndim - 2)), array[rows.start], 0.0)
    return replace(prediction, values=values, by_free=by_free)
