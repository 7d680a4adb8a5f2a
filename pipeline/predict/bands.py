"""Readings of a model with 95 % intervals, from its tangent at the fit."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from pipeline.inference.load_cases import LoadCases
from pipeline.inference.nuisances import lined, nominals
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.predict.posterior import Posterior

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Z = float(norm.ppf(0.975))


@dataclass(frozen=True, eq=False)
class Bands:
    """Readings (R, C), in the units of their columns. value: at the fit, or the median of the samples. low, high: ends
    of the 95 % interval of a reading. parameters, tolerances, noise: its three parts, each as a standard deviation.
    lost: (R,) rows without a stable equilibrium; reasons: of those. sampled: (R,) rows whose intervals are by samples
    and not from the tangent."""

    value: Array
    low: Array
    high: Array
    parameters: Array
    tolerances: Array
    noise: Array
    lost: Mask
    reasons: dict[int, str]
    sampled: Mask

    @property
    def model(self) -> Array:
        """(R, C) standard deviation of what is there, without the noise of a reading."""
        return np.asarray(np.hypot(self.parameters, self.tolerances))


@dataclass(frozen=True, eq=False)
class Tangent:
    """Of a model at rows that are asked for. found: its prediction at what was prescribed, with derivatives by its P
    parameters. by_nominal: (R, C, K) by what was written, in its standard deviations."""

    posterior: Posterior
    cases: LoadCases
    found: Prediction
    by_nominal: Array

    @classmethod
    def of(cls, posterior: Posterior, cases: LoadCases, near: Prediction | None = None) -> Tangent:
        """Near: a prediction of a like model at the same rows."""
        found = predict(posterior.model, cases, start=near)
        return cls(posterior, cases, found, _by_nominal(posterior, cases, found))

    @property
    def spread(self) -> Array:
        """(R, C) noise of each reading by itself; NaN where no sigma is known."""
        return self.cases.spread

    @property
    def through_inputs(self) -> Array:
        """(R, C) standard deviation by the noise of what is prescribed."""
        through = self.found.by_inputs * self.cases.input_sigma[:, None, :]
        return np.asarray(np.sqrt(np.sum(through**2, axis=2)))

    def bands(self) -> Bands:
        """Intervals of a normal law."""
        given, added = self.posterior.variances(self.found.by_free, self.by_nominal)
        noise = np.hypot(np.nan_to_num(self.spread), self.through_inputs)
        half = Z * np.sqrt(given + added + noise**2)
        value = self.found.values
        return Bands(
            value,
            value - half,
            value + half,
            np.sqrt(given),
            np.sqrt(added),
            noise,
            self.found.lost,
            self.found.reasons,
            np.zeros(len(value), dtype=bool),
        )


def _by_nominal(posterior: Posterior, cases: LoadCases, found: Prediction) -> Array:
    """(R, C, K) in the order of the posterior's numbers; zero for those of sensors that these rows do not have."""
    out = np.zeros((*found.values.shape, len(posterior.numbers)))
    if not posterior.numbers:
        return out
    line = lined(posterior.model, cases, replace(found, shift=np.zeros_like(found.shift))).by_nominal
    places = {each.path: k for k, each in enumerate(nominals(cases.campaign))}
    for k, each in enumerate(posterior.numbers):
        if each.path in places:
            out[..., k] = line[..., places[each.path]]
    return out
