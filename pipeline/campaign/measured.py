"""Readings of a campaign before they are parted into tests, wherever they come from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.model import Array


@dataclass(frozen=True, eq=False)
class Measured:
    """Rows in the order in which they were read.

    tests: (N,) id of the test of each. steps: (N,) whole numbers, NaN where the cell is none; None where the rows are
    only in order. lines: (N,) of the file. values: (N,) by the column of the contract, NaN where nothing is read.
    """

    tests: tuple[str, ...]
    steps: Array | None
    lines: NDArray[np.int64]
    values: Mapping[str, Array]

    def of(self, column: str) -> Array:
        """A column (N,), NaN throughout where there is none."""
        return self.values.get(column, np.full(len(self.tests), np.nan))
