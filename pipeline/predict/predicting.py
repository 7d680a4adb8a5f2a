"""From a campaign and a model to predicted readings with their intervals."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t

from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.compare.error import Discrepancy
from pipeline.inference.declared_sigmas import trusted
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.fit import Fit, fit, unfitted
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.inference.solvers import far
from pipeline.inference.subsets import carried
from pipeline.inference.suitable import check_suitable, sized_model
from pipeline.predict.asked import Asked, filled
from pipeline.predict.bands import Bands, Tangent, Z
from pipeline.predict.posterior import Posterior
from pipeline.predict.sampling import bent, sampled
from pipeline.selection.adequacy.judgement import judge
from pipeline.selection.adequacy.untested import untested
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.reading_noise import AS_DECLARED, Readings

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Fitted:
    """A model at its best fit to a campaign. whole: the campaign with its sigmas, every reading in it. readings: what
    they are about the fit. factor: by which noise and parameters are wider, where more is left than noise. untested:
    why nothing was tested, or ""."""

    whole: Campaign
    fit: Fit
    readings: Readings
    factor: float
    noise: bool
    untested: str

    @property
    def sigmas(self) -> Array:
        """(12 + G,) times the declared noise that a reading scatters by."""
        factors = np.full(12 + len(self.whole.gauges), self.factor)
        for each in self.readings.scatter:
            factors[each.channel] *= each.factor
        tails = self.readings.tails
        if tails is not None:
            # Of Student's law, the normal noise with the same 95 % interval.
            factors *= tails.scale * t.ppf(0.975, tails.degrees) / Z
        return factors


@dataclass(frozen=True, eq=False)
class Predicted:
    """Intervals of the rows that were asked for. wanted: (R, C) readings that are predicted. measured: (R, C), NaN
    where nothing was read."""

    fitted: Fitted
    tangent: Tangent
    asked: Asked
    bands: Bands
    wanted: Mask
    measured: Array

    @property
    def cases(self) -> LoadCases:
        """The rows, with the noise that counts."""
        return self.tangent.cases

    @property
    def inside(self) -> Mask:
        """(R, C) readings that were made and lie inside."""
        return np.asarray((self.measured >= self.bands.low) & (self.measured <= self.bands.high))

    @property
    def judged(self) -> Mask:
        """(R, C) readings that are predicted and were made."""
        return np.asarray(self.wanted & np.isfinite(self.measured) & ~self.bands.lost[:, None])


def fitted_to(campaign: Campaign, model: Model, on_progress: OnProgress = lambda _: None) -> Fitted:
    """The model at its best fit. InputError for an effect that the campaign cannot have."""
    model = sized_model(model, campaign)
    check_suitable([term.effect for term in model.terms], campaign)
    whole = trusted(completed(campaign), model)
    on_progress("the fit")
    cases = load_cases(whole)
    there = bool((cases.predicted & cases.fitted[:, None]).any())
    found = fit(model, cases, None, None, CRITERIA.plausible) if there else unfitted(model, cases)
    on_progress("the noise of the sensors")
    readings = AS_DECLARED.again(found, cases, CRITERIA) if there else AS_DECLARED
    if not readings.plain:
        rest = load_cases(readings.applied(whole))
        start = carried(found.prediction, rest, cases)
        found = fit(found.model, rest, start, None, CRITERIA.plausible)
    return fitted_as(found, whole, readings)


def fitted_as(found: Fit, whole: Campaign, readings: Readings = AS_DECLARED) -> Fitted:
    """A best fit that is there already, judged."""
    nothing = untested(found)
    if nothing:
        return Fitted(whole, found, readings, 1.0, True, nothing)
    judged = judge(found)
    factor = judged.scatter if judged.noise else max(1.0, found.rms)
    return Fitted(whole, found, readings, factor, judged.noise, "")


def predicted(it: Fitted, asked: Asked, seed: int = 0, on_progress: OnProgress = lambda _: None) -> Predicted:
    """The readings that are asked for. seed: of the samples, where these are needed."""
    posterior = Posterior.of(it.fit, it.factor)
    noise = it.whole.noise.times(it.sigmas)
    campaign = replace(it.whole, tests=asked.tests, noise=noise)
    cases = load_cases(campaign)
    measured = np.where(_outputs(cases), cases.measured, np.nan)
    if not asked.own:
        # What a sensor of each column would read: its gain and its share of the reading count.
        first = predict(posterior.model, cases, slopes=False)
        cases = load_cases(replace(campaign, tests=filled(asked.tests, first.values)))
    wanted = np.isfinite(measured) if asked.own else _outputs(cases)
    on_progress("intervals")
    tangent = Tangent.of(posterior, cases)
    off = far(it.fit.chi_square, it.fit.whitened.size)
    # Intervals of a model that is far off are as wide as what it leaves; where they end exactly says nothing.
    turned = np.zeros(len(asked.tests), dtype=bool) if off else bent(tangent, wanted, seed)
    bands = sampled(tangent, turned, seed, on_progress)
    return Predicted(it, tangent, asked, bands, wanted, _less_zeros(tangent, measured))


def _less_zeros(at: Tangent, measured: Array) -> Array:
    """(R, C) readings, those of tests with unknown zeros less the zeros that fit the test best: no model foretells
    them."""
    cases = at.cases
    unknown = cases.loose[cases.test]
    if not unknown.any():
        return measured
    left = Discrepancy(cases, at.found).units
    kept = unknown & np.isfinite(measured) & cases.predicted
    return np.where(kept, at.found.values + left, measured)


def _outputs(cases: LoadCases) -> Mask:
    """(R, C) channels that are not prescribed; what a support holds does not move."""
    out = np.ones(cases.measured.shape, dtype=bool)
    np.put_along_axis(out, cases.channels, False, axis=1)
    return out
