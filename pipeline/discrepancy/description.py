"""The rest of a misfit that nothing explains, as a Gaussian process of what was prescribed: no physics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.compare.error import Discrepancy
from pipeline.discrepancy.gaussian import Process, learned
from pipeline.discrepancy.regressors import NAMES, Samples, samples
from pipeline.inference.fit import Fit

Array = NDArray[np.float64]
CHANNELS, ROWS, RESTARTS = 3, 150, 2
"""Channels that are described, the worst first; rows that are looked at, since the cost grows with their cube."""
DEPENDS = 10.0
"""Spreads of an input: over so long a way the process hardly changes, and the input is not named."""


@dataclass(frozen=True)
class Description:
    """One channel. inputs: those that it varies with, the one that says most first. rms: in sigmas, of the rest.
    elsewhere: of each test, when the process is given all tests but that one; 1 would be noise."""

    channel: int
    inputs: tuple[str, ...]
    rms: float
    elsewhere: float


def descriptions(found: Fit) -> list[Description]:
    """Of the channels that fit worst, in fitted tests."""
    whole = found.residual.load_cases
    every, kept = samples(whole, found.prediction), Discrepancy(whole, found.prediction).kept
    worst = sorted(every, key=lambda channel: -_rms(every[channel][0].values))[:CHANNELS]
    out = []
    for channel in worst:
        own, scale = every[channel]
        some = np.unique(np.linspace(0, own.values.size - 1, ROWS).round().astype(int))
        tests = whole.test[kept[:, channel] & whole.fitted][some]
        own = Samples(own.inputs[some], own.values[some])
        process = learned(own, RESTARTS)
        if process is None:
            continue
        left = own.values - _from_other_tests(process, own, tests)
        near = [k for k in np.argsort(process.lengths) if process.lengths[k] < DEPENDS]
        names = tuple(NAMES[scale.columns[k]] for k in near)
        out.append(Description(channel, names, _rms(own.values), _rms(left)))
    return out


def _from_other_tests(process: Process, own: Samples, tests: NDArray[np.int_]) -> Array:
    """(n,) what the process expects of each test, given all others; zero of the only one."""
    out = np.zeros_like(own.values)
    for test in np.unique(tests):
        mine = tests == test
        if not mine.all():
            out[mine] = process.given(Samples(own.inputs[~mine], own.values[~mine]))(own.inputs[mine])
    return out


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
