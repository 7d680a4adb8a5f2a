"""The sigma of a sensor from its own readings, where the campaign does not say it."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammaln

from pipeline.inference.noise import MEDIAN
from pipeline.inference.rounding import EQUAL
from pipeline.inference.settings import DRAWS, ROUGHNESS

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SigmaEstimate:
    """An estimate, its standard error and from how many differences it is; None with a reason where there is none."""

    value: float | None
    std: float | None
    differences: int
    reason: str = ""


def from_repeats(readings: Array, group: NDArray[np.int64]) -> SigmaEstimate:
    """Sigma from steps that were done more than once; equal `group` (N,) marks them.

    Pooled: s² = sum (y - mean of its group)² / nu, nu = N - number of groups. Unbiased for normal noise: divided by
    c4(nu) = sqrt(2 / nu) gamma((nu + 1) / 2) / gamma(nu / 2), with the standard error value * sqrt(1 / c4² - 1).
    ValueError for readings that are not finite.
    """
    if not np.isfinite(readings).all():
        raise ValueError("the readings have values that are not finite")
    names, place = np.unique(group, return_inverse=True)
    nu = readings.size - names.size
    if nu < 1:
        return SigmaEstimate(None, None, 0, "no step was repeated")
    means = np.bincount(place, readings) / np.bincount(place)
    return _pooled(float(np.sum((readings - means[place]) ** 2)), nu)


def from_lines(paths: Sequence[tuple[Array, Array]]) -> SigmaEstimate:
    """Sigma from the scatter about a straight line over the load, one line a path: loads and readings (n,) of each.

    Pooled and unbiased as in `from_repeats`, nu = sum of readings less two a path, at least `ROUGHNESS.about_lines`.
    What bends or loops only adds to it. ValueError for loads or readings that are not finite.
    """
    return _about(paths, 1, ROUGHNESS.about_lines, "straight lines")


def from_parabolas(paths: Sequence[tuple[Array, Array]]) -> SigmaEstimate:
    """The same about a parabola, one a path (n,), at least `ROUGHNESS.about_parabolas` degrees of freedom: of
    paths that are too short for the differences of `from_roughness`."""
    return _about(paths, 2, ROUGHNESS.about_parabolas, "parabolas")


def _about(paths: Sequence[tuple[Array, Array]], degree: int, fewest: int, what: str) -> SigmaEstimate:
    """Pooled scatter about polynomials of this degree over the load."""
    total, nu = 0.0, 0
    for load, y in paths:
        if not (np.isfinite(load).all() and np.isfinite(y).all()):
            raise ValueError("the loads or the readings have values that are not finite")
        if np.unique(load).size < degree + 2:
            continue
        # The bend free of level and slope, as these are of each other: no rounding of a fit to large numbers.
        columns, left = np.zeros((load.size, 0)), y
        for power in range(degree + 1):
            column = ((load - load.mean()) / np.ptp(load)) ** power
            column = column - columns @ (columns.T @ column)
            column = column / np.linalg.norm(column)
            left = left - column * float(column @ left)
            columns = np.column_stack([columns, column])
        total, nu = total + float(left @ left), nu + load.size - degree - 1
    if nu < fewest:
        return SigmaEstimate(None, None, nu, f"{nu} degrees of freedom about {what}, allowed are {fewest}")
    return _pooled(total, nu)


def _pooled(squares: float, nu: int) -> SigmaEstimate:
    s = np.sqrt(squares / nu)
    c4 = np.sqrt(2.0 / nu) * np.exp(gammaln(0.5 * (nu + 1)) - gammaln(0.5 * nu))
    # Rounding of c4 at many repeats must not turn the root around; 1 / c4² - 1 tends to 1 / (2 nu).
    spread = np.sqrt(max(1.0 / c4**2 - 1.0, 0.5 / nu))
    return SigmaEstimate(float(s / c4), float(s / c4 * spread), int(nu))


def from_roughness(
    paths: Sequence[tuple[Array, Array]], rng: np.random.Generator | None = None
) -> SigmaEstimate:
    """Sigma from what no smooth curve explains: paths are pairs of loads (n,) and readings (n,), one a test, in order.

    Of every four steps in a row the combinations w'y of unit length that vanish for a quadratic in the load (third
    differences where the loads are evenly spaced, 1 3 3 1 over the root of 20) have the standard deviation sigma.
    The estimate is 1.4826 times the median of their magnitudes, which a jump where the load turns does not move much.
    Overlapping differences are dependent, and a median of few is biased: the same statistic of `DRAWS` of unit noise
    through the same w gives its mean, by which the estimate is divided, and its spread, the standard error.
    A smooth curve leaves its own third difference behind: h³ f''' / root of 20, so the steps must be fine enough.
    ValueError for loads or readings that are not finite.
    """
    if not all(np.isfinite(load).all() and np.isfinite(y).all() for load, y in paths):
        raise ValueError("the loads or the readings have values that are not finite")
    loads = [np.asarray(load, dtype=float) for load, _ in paths]
    found = [_differences(load) for load in loads]
    count = sum(len(w) for _, w in found)
    if count < ROUGHNESS.fewest:
        return SigmaEstimate(
            None, None, count, f"{count} differences, allowed are {ROUGHNESS.fewest} or more"
        )
    raw = float(_spread(found, [np.asarray(y, dtype=float)[:, None] for _, y in paths])[0])
    if raw == 0.0:
        return SigmaEstimate(None, None, count, "most differences are zero: the readings are rounded")
    mean, std = _drawn(loads, rng) if rng else _drawn_once(tuple(map(tuple, loads)))
    return SigmaEstimate(raw / mean, raw / mean * std / mean, count)


@lru_cache(maxsize=DRAWS.kept)
def _drawn_once(loads: tuple[tuple[float, ...], ...]) -> tuple[float, float]:
    """Of the draws that are the same each time: sensors of a table share its loads, and are asked about often."""
    return _drawn([np.array(load) for load in loads], np.random.default_rng(0))


def _drawn(loads: list[Array], rng: np.random.Generator) -> tuple[float, float]:
    """Mean and standard deviation of the statistic of unit noise along the loads."""
    found = [_differences(load) for load in loads]
    count = sum(len(w) for _, w in found)
    noise = np.concatenate(
        [
            _spread(found, [rng.normal(size=(load.size, DRAWS.at_once)) for load in loads])
            for _ in range(int(np.clip(DRAWS.effort / count, DRAWS.fewest, DRAWS.most)) // DRAWS.at_once)
        ]
    )
    return float(np.mean(noise)), float(np.std(noise))


def _spread(found: list[tuple[NDArray[np.int64], Array]], readings: list[Array]) -> Array:
    """(k,) 1.4826 times the median magnitude of all differences; readings (n, k), one a path."""
    values = [
        sum(w[:, j, None] * y[first + j] for j in range(ROUGHNESS.window))
        for (first, w), y in zip(found, readings, strict=True)
    ]
    return np.asarray(np.median(np.abs(np.concatenate(values)), axis=0) / MEDIAN, dtype=float)


def _differences(load: Array) -> tuple[NDArray[np.int64], Array]:
    """First step (m,) and weights (m, 4), of unit length and blind to quadratics in the load, of each difference."""
    if load.size < ROUGHNESS.window:
        return np.zeros(0, dtype=np.int64), np.zeros((0, ROUGHNESS.window))
    s = np.lib.stride_tricks.sliding_window_view(load, ROUGHNESS.window)
    reach = np.ptp(s, axis=1, keepdims=True)
    u = (s - s.mean(axis=1, keepdims=True)) / np.where(reach > 0.0, reach, 1.0)
    left, sizes, _ = np.linalg.svd(np.stack([np.ones_like(u), u, u**2], axis=2), full_matrices=True)
    # Loads that repeat leave more than one combination blind to the curve.
    blind = np.column_stack([sizes < EQUAL * sizes[:, :1], np.ones(len(u), dtype=bool)])
    first, column = np.nonzero(blind)
    return first.astype(np.int64), left[first, :, column]
