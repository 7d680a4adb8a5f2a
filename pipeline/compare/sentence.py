"""One number of a misfit in words: what the measurement does that the model does not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pipeline.compare.misfit import Series, Signature
from reports.quantities import percent, short, sigma, signed

SHARE = 10.0
"""The model's own slope is a measure for a misfit of slope if over the load it moves the channel so many sigmas."""


@dataclass(frozen=True, eq=False)
class Look:
    """A channel over its load. slope: the model's own, in unit per load unit. load: name of what drives."""

    series: Series
    slope: float
    load: str


def sentence(number: Signature, look: Look) -> str:
    """The number in words, with its significance."""
    return f"{_WORDS[number.name](number, look)} ({sigma(number.significance)} sigma)"


def _times(number: Signature, factor: float) -> str:
    """The number times a factor, to what its standard error allows."""
    return signed(number.value * factor, abs(number.std * factor))


def _offset(number: Signature, look: Look) -> str:
    return f"{_times(number, 1.0)} {look.series.unit} off at {look.load} = 0"


def _slope(number: Signature, look: Look) -> str:
    moved = abs(look.slope) * float(np.ptp(look.series.load)) / float(np.median(look.series.sigma))
    part = number.value / look.slope if look.slope else np.inf
    if moved < SHARE or abs(part) > 1.0:
        return f"changes with {look.load} by {_times(number, 1.0)} {number.unit} more than the model says"
    return f"slope over {look.load} {percent(part)} {'below' if part < 0 else 'above'} the model's"


def _curvature(number: Signature, look: Look) -> str:
    full = _times(number, float(np.max(look.series.load**2)))
    return f"bends with the square of {look.load}, {full} {look.series.unit} at its largest"


def _asymmetry(number: Signature, look: Look) -> str:
    return f"slope {_times(number, 2.0)} {number.unit} larger for positive {look.load} than for negative"


def _dead_band(number: Signature, look: Look) -> str:
    return f"jumps by {_times(number, 2.0)} {look.series.unit} where {look.load} changes sign"


def _loop(number: Signature, look: Look) -> str:
    width = _times(number, 1.0 / float(np.ptp(look.series.load))).lstrip("+-")
    return f"loop of {width} {look.series.unit} between rising and falling {look.load}"


def _step(number: Signature, look: Look) -> str:
    return f"drifts by {_times(number, float(np.ptp(look.series.step)))} {look.series.unit} over a test"


def _temperature(number: Signature, look: Look) -> str:
    return f"follows the temperature, {_times(number, 1.0)} {number.unit}"


def _q(number: Signature, look: Look) -> str:
    turn = float(np.ptp(look.series.q))
    change = f"{_times(number, turn)} {look.series.unit}"
    return f"offset changes with q, {change} over {short(float(np.degrees(turn)))} degrees"


def _slope_q(number: Signature, look: Look) -> str:
    turn = float(np.ptp(np.abs(look.series.q)))
    change = f"{_times(number, turn)} {look.series.unit}/{look.series.load_unit}"
    return (
        f"slope over {look.load} changes with abs(q), {change} over {short(float(np.degrees(turn)))} degrees"
    )


def _scatter(number: Signature, look: Look) -> str:
    return f"the misfit is larger at larger {look.load}"


_WORDS: dict[str, Callable[[Signature, Look], str]] = {
    "offset": _offset,
    "slope": _slope,
    "curvature": _curvature,
    "asymmetry": _asymmetry,
    "dead_band": _dead_band,
    "loop": _loop,
    "step": _step,
    "temperature": _temperature,
    "q": _q,
    "slope_q": _slope_q,
    "scatter": _scatter,
}
"""Words for every number of `pipeline.compare.misfit`."""
