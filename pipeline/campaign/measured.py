"""Readings of a campaign before they are parted into tests, wherever they come from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.model import Array


@dataclass(frozen=True, eq=False)
class Measured:
    """Rows in the order in which they were read.

    tests: (N,) id of the test of each. steps: (N,) whole numbers, NaN where the cell is none; None where the rows are
    only in order. lines: (N,) of the file. values: (N,) by the column of the contract, NaN where nothing is read.
    unread: (N,) by column, rows with a word that was declared to be no reading. from_first: columns that are less their
    first reading in each test.
    """

    tests: tuple[str, ...]
    steps: Array | None
    lines: NDArray[np.int64]
    values: Mapping[str, Array]
    unread: Mapping[str, NDArray[np.bool_]] = field(default_factory=dict)
    from_first: frozenset[str] = frozenset()

    def of(self, column: str) -> Array:
        """A column (N,), NaN throughout where there is none."""
        return self.values.get(column, np.full(len(self.tests), np.nan))

    def blank(self, column: str) -> NDArray[np.bool_]:
        """(N,) where a column holds a word for no reading instead of one, such as an overload."""
        return self.unread.get(column, np.zeros(len(self.tests), dtype=bool))

    def only(self, rows: NDArray[np.int64]) -> Measured:
        """These rows, by their numbers."""
        return replace(
            self,
            tests=tuple(self.tests[k] for k in rows),
            steps=None if self.steps is None else self.steps[rows],
            lines=self.lines[rows],
            values={column: values[rows] for column, values in self.values.items()},
            unread={column: mask[rows] for column, mask in self.unread.items()},
        )
