"""Intervals by samples of the posterior, each predicted through the mechanism: where its tangent does not do.

A kink, such as the stop of a play or the slip of a hinge, has another tangent on either side, and what a hinge
remembers follows from all rows before. So parameters within their bounds, what was written, and the true inputs of
every row are drawn together, and the readings of each draw are solved for: a few draws tell where the tangent misses
them, and more of them make the intervals of those histories.

A reading scatters about the samples by its own noise, which is not drawn: its law is a mixture of normal laws, whose
quantiles are the interval. Where samples are few they are given a width of their own and moved towards their mean, so
that their variance stays (M. West, J. R. Statist. Soc. B 55, 1993, 409-422): the 2.5 % quantile of sixty samples alone
would be too near.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr

from pipeline.callbacks import OnProgress
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.prediction import predict
from pipeline.predict.bands import Bands, Tangent
from vjm.work import spent

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
LOOKS, SAMPLES = 6, 60
"""Draws that show where the tangent misses; draws that make intervals."""
FEWEST = 20
"""Draws that make them where each takes long."""
WORK = 12_000.0
"""Of the solver, after which no draw is begun beyond the fewest: rows beyond a bifurcation take most of it."""
EACH = 3
"""One draw of so many is solved for at the measured inputs as well, to part the model from the noise."""
SHARE, OFF = 0.05, 0.25
"""The tangent does not do for a history where it misses more than this share of the readings of any column by more than
this part of their standard deviation."""
LEVELS = (0.025, 0.5, 0.975)
HALVINGS = 40
"""Of the bracket of a quantile: it is then known to rounding."""
KERNEL = 1.06
"""Width of a sample, in standard deviations, times S^0.2: Silverman's for a normal law (Density Estimation, 1986,
section 3.4.2)."""


def bent(at: Tangent, wanted: Mask, seed: int) -> Mask:
    """(tests,) histories in which the mechanism leaves its tangent, at the readings (R, C) that are wanted."""
    linear = at.bands()
    scale = np.hypot(linear.model, linear.noise)
    off = np.zeros((LOOKS, *scale.shape), dtype=bool)
    it, generator = at.posterior, np.random.default_rng([seed, 1])
    values, departures = it.draws(LOOKS, generator)
    for number, (own, departure) in enumerate(zip(values, departures, strict=True)):
        shift = generator.standard_normal(at.cases.input_sigma.shape) * at.cases.input_sigma
        found = predict(
            it.model_at(own, departure), at.cases, slopes=False, start=at.found, shift=shift, order=0
        )
        straight = (
            linear.value
            + at.found.by_free @ (own - it.model.values)
            + at.by_nominal @ (departure - it.departure)
            + np.einsum("rci,ri->rc", at.found.by_inputs, shift)
        )
        missed = np.abs(found.values - straight) > OFF * scale
        off[number] = missed | (found.lost != at.found.lost)[:, None]
    kept = wanted & ~at.found.lost[:, None]
    out = np.zeros(len(at.cases.campaign.tests), dtype=bool)
    for k in range(len(out)):
        own_rows = kept & (at.cases.test == k)[:, None]
        count = own_rows.sum(axis=0)
        share = np.where(own_rows, off.mean(axis=0), 0.0).sum(axis=0) / np.maximum(count, 1)
        out[k] = bool(np.any(share > SHARE))
    return out


def sampled(
    at: Tangent, tests: Mask, seed: int, on_progress: OnProgress = lambda _: None, count: int = SAMPLES
) -> Bands:
    """Intervals from the tangent, and by so many samples in these histories (tests,)."""
    rows = np.flatnonzero(tests[at.cases.test])
    linear = at.bands()
    if not rows.size:
        return linear
    cases = at.cases.only(rows)
    alone, whole = _samples(at, cases, seed, on_progress, count)
    spread = np.nan_to_num(at.spread)[rows]
    ends = quantiles(whole, spread, LEVELS)
    model, inputs = np.nanvar(alone, axis=0), np.nanvar(whole, axis=0)
    # The samples say how far off what is there may be; the tangent, which part is left by exact numbers.
    total = linear.model[rows] ** 2
    share = np.divide(linear.parameters[rows] ** 2, total, out=np.ones_like(total), where=total > 0.0)
    noise = np.sqrt(spread**2 + np.maximum(inputs - model, 0.0))
    new = (ends[1], ends[0], ends[2], np.sqrt(share * model), np.sqrt((1.0 - share) * model), noise)
    out = replace(linear, sampled=tests[at.cases.test])
    for name, own in zip(("value", "low", "high", "parameters", "tolerances", "noise"), new, strict=True):
        array = getattr(linear, name).copy()
        array[rows] = own
        out = replace(out, **{name: array})
    return out


def _samples(
    at: Tangent, cases: LoadCases, seed: int, on_progress: OnProgress, count: int
) -> tuple[Array, Array]:
    """(S / 3, R, C) readings at what was prescribed, and (S, R, C) at inputs that were drawn, of some histories; where
    a draw has no state, what the tangent says of the fit. S is the count, or fewer where that takes too much work."""
    it, generator = at.posterior, np.random.default_rng([seed, 2])
    values, departures = it.draws(count, generator)
    start = predict(it.model, cases, slopes=False, order=0)
    alone: list[Array] = []
    whole: list[Array] = []
    ends = spent() + WORK
    for number, (own, departure) in enumerate(zip(values, departures, strict=True)):
        if number >= FEWEST and spent() > ends:
            break
        on_progress(f"sample {number + 1} of {count}")
        model = it.model_at(own, departure)
        shift = generator.standard_normal(cases.input_sigma.shape) * cases.input_sigma
        for kept, by in ((whole, shift), *([(alone, None)] if number % EACH == 0 else [])):
            found = predict(model, cases, slopes=False, start=start, shift=by, order=0)
            kept.append(np.where(found.lost[:, None], start.values, found.values))
    return np.array(alone), np.array(whole)


def quantiles(samples: Array, spread: Array, levels: Sequence[float]) -> list[Array]:
    """(R, C) each, of a reading that scatters by a standard deviation (R, C) about samples (S, R, C)."""
    width = KERNEL * len(samples) ** -0.2
    mean, std = samples.mean(axis=0), samples.std(axis=0)
    moved = mean + np.sqrt(1.0 - width**2) * (samples - mean)
    least, most = moved.min(axis=0), moved.max(axis=0)
    size = np.maximum(np.maximum(np.abs(least), np.abs(most)), 1.0)
    sigma = np.maximum(np.hypot(spread, width * std), 1e-12 * size)
    out = []
    for level in levels:
        low, high = least - 6.0 * sigma, most + 6.0 * sigma
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            below = ndtr((middle - moved) / sigma).mean(axis=0) < level
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        out.append(0.5 * (low + high))
    return out
