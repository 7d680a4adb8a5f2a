"""A declared sigma is a claim: where readings scatter ten times less than it says, the scatter counts.

The scatter is what no smooth curve along the load path explains in the residual of a model, in its sigmas: a smooth
misfit passes it without a trace. Each part of the noise of a reading, its own and that of every input through the
model's tangent, is then no larger than the scatter allows.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from pipeline.campaign import Campaign
from pipeline.campaign.names import channel_columns
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.residual import whitening
from pipeline.inference.sensor_noise import from_parabolas, from_roughness
from pipeline.inference.settings import CLAIMS, ROUGHNESS
from pipeline.inference.subsets import carried

Array = NDArray[np.float64]


def trusted(whole: Campaign, model: Model) -> Campaign:
    """The campaign with sigmas that its own scatter allows; each that was lowered is said in a remark."""
    return trusted_and_fit(whole, model)[0]


def trusted_and_fit(whole: Campaign, model: Model, near: Fit | None = None) -> tuple[Campaign, Fit | None]:
    """The same, and the model as it is beside what was written; None where a sigma was lowered, or nothing is compared.
    near: a fit of the model to other readings of the same tests."""
    cases = load_cases(whole)
    if not (cases.predicted & cases.fitted[:, None]).any():
        return whole, None
    start = None if near is None else carried(near.prediction, cases, near.residual.load_cases)
    found = unfitted(model, cases, start)
    least = dict(_by_scatter(found)) or _by_size(found)
    if not least:
        return whole, found
    noise = whole.noise
    sigmas = noise.sigmas
    names = channel_columns(whole.gauges)
    new, remarks = sigmas.copy(), []
    for channel, share in least.items():
        for own, cap in _caps(found, channel, share):
            new[own] = min(new[own], cap)
    for k in np.flatnonzero(new < sigmas):
        remarks.append(
            f"{names[k]}: a sigma of {sigmas[k]:.3g} is given, but the readings scatter far less: {new[k]:.3g} counts"
        )
    return replace(whole, noise=noise.of(new), remarks=(*whole.remarks, *remarks)), None


def _by_scatter(found: Fit) -> Iterator[tuple[int, float]]:
    """Channels of which the residual scatters far less than it should, and by what part of it, along the load paths."""
    cases = found.residual.load_cases
    kept = cases.predicted & cases.fitted[:, None] & ~found.prediction.lost[:, None]
    for channel in np.flatnonzero(kept.any(axis=0)):
        paths = []
        for k in range(len(cases.campaign.tests)):
            rows = np.flatnonzero(kept[:, channel] & (cases.test == k))
            values = found.residual.values[rows, channel]
            paths.append((np.arange(rows.size, dtype=float), values))
        it = from_roughness(paths)
        if it.differences < ROUGHNESS.fewest:
            it = from_parabolas(paths)
        if (
            it.value is not None
            and it.std is not None
            and it.value + CLAIMS.sure * it.std < 1.0 / CLAIMS.times
        ):
            yield int(channel), it.value


def _by_size(found: Fit) -> dict[int, float]:
    """The same of all channels where what is left is far less than noise leaves; none where it is not."""
    if found.degrees < 2 or found.prediction.lost.any():
        return {}
    left = found.chi_square / found.degrees
    if (
        left >= 1.0 / CLAIMS.times**2
        or left <= 0.0
        or chi2.cdf(found.chi_square, found.degrees) > CLAIMS.chance
    ):
        return {}
    cases = found.residual.load_cases
    channels = np.flatnonzero((cases.predicted & cases.fitted[:, None]).any(axis=0))
    return {int(channel): float(np.sqrt(left)) for channel in channels}


def _caps(found: Fit, channel: int, share: float) -> Iterator[tuple[int, float]]:
    """Channels whose noise is in that of a channel, and the most that each may be: all have a share of the scatter."""
    cases = found.residual.load_cases
    rows = cases.predicted[:, channel] & cases.fitted & ~found.prediction.lost
    spread = np.sqrt(
        np.sum(np.linalg.inv(whitening(cases, found.prediction).factors)[rows, channel] ** 2, axis=-1)
    )
    target = share * float(np.sqrt(np.mean(spread**2)))
    if share < CLAIMS.computed or target < CLAIMS.computed * float(
        np.max(np.abs(cases.measured[rows, channel]))
    ):
        return
    parts = {channel: (float(cases.sigma[channel]), 1.0)}
    for j in range(6):
        for own in np.unique(cases.channels[rows, j]):
            some = rows & (cases.channels[:, j] == own)
            slope = float(np.sqrt(np.mean(found.prediction.by_inputs[some, channel, j] ** 2)))
            if slope > 0.0 and cases.sigma[own] > 0.0:
                parts[int(own)] = (slope * float(cases.sigma[own]), slope)
    beyond = {k: slope for k, (size, slope) in parts.items() if size > target}
    for k, slope in beyond.items():
        yield k, target / np.sqrt(len(beyond)) / slope
