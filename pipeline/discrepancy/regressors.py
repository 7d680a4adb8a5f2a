"""What a correction of the residual is a function of, and the residual itself, channel by channel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.names import COORDINATES
from pipeline.compare.error import Discrepancy
from pipeline.compare.misfit import direction
from pipeline.inference.driving import driving
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.predicted import Prediction

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
MOVED = 20.0
"""Sigmas of its sensor from which a prescribed quantity was driven, and not held."""


NAMES = (
    "the angle q",
    *(f"the prescribed {c}" for c in COORDINATES),
    *(f"the prescribed {'f' if k < 3 else 'm'}{'xyz'[k % 3]}" for k in range(6)),
    "temperature",
    "the direction of travel",
    *(f"whether {c} is driven by force" for c in COORDINATES),
)
"""Of the columns of regressors."""


def regressors(cases: LoadCases) -> tuple[Array, Array]:
    """(R, 21) of every row, and the range (21,) above which a column says more than noise.

    Angle, prescribed displacements (6) and forces (6), zero where the other is prescribed, temperature, direction of
    loading (-1, 0, 1), and which coordinates are driven by force (6).
    """
    gauges = cases.campaign.gauges
    blocks = []
    for test in cases.campaign.tests:
        count = test.data.steps.size
        forced = np.broadcast_to(np.array([by == "force" for by in test.control]), (count, 6))
        given = test.inputs(gauges)
        heat = np.zeros(count) if test.data.temperature is None else test.data.temperature
        way = direction(driving(test, gauges)[1], np.zeros(count, dtype=np.int64))
        columns = [np.full(count, test.q), *np.where(forced, 0.0, given).T, *np.where(forced, given, 0.0).T]
        blocks.append(np.column_stack([*columns, heat, way, forced]))
    noise = cases.campaign.noise
    sigma = [0.0, *noise.displacement, *noise.wrench, noise.temperature, *np.zeros(7)]
    return np.concatenate(blocks), MOVED * np.nan_to_num(np.array(sigma))


@dataclass(frozen=True, eq=False)
class Samples:
    """One channel of a whitened residual. inputs: (n, m), each of zero mean and unit spread. values: (n,) in sigmas,
    the noise of each is one and independent of the others."""

    inputs: Array
    values: Array


@dataclass(frozen=True, eq=False)
class Scaling:
    """Columns of the regressors that vary, and how they are scaled."""

    columns: NDArray[np.intp]
    mean: Array
    spread: Array

    def __call__(self, table: Array) -> Array:
        """(n, m) scaled inputs of a table (n, 21) of regressors."""
        return (table[:, self.columns] - self.mean) / self.spread


def scaling(table: Array, noise: Array) -> Scaling:
    """Of regressors (n, 21); noise: (21,) range up to which a column is held."""
    columns = np.flatnonzero(np.ptp(table, axis=0) > noise)
    return Scaling(columns, table[:, columns].mean(axis=0), table[:, columns].std(axis=0))


def samples(cases: LoadCases, base: Prediction) -> dict[int, tuple[Samples, Scaling]]:
    """What a base model leaves of a campaign, by channel; rows without a prediction are left out.

    Whitened: what the noise of an input does to several channels at once is taken apart, channel after channel, so
    that each can be learned by itself.
    """
    table, noise = regressors(cases)
    gap = Discrepancy(cases, base)
    out = {}
    for channel in range(gap.kept.shape[1]):
        rows = gap.kept[:, channel] & cases.fitted
        if rows.any():
            scale = scaling(table[rows], noise)
            out[channel] = Samples(scale(table[rows]), gap.whitened[rows, channel]), scale
    return out
