"""One sensor answers to what another one reads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import permutations
from typing import Self

import numpy as np

from vjm.effects.base import Parameter, Values
from vjm.effects.sensor_fault import RESOLVED, Rows, SensorFault
from vjm.frames import Array

INTO = "<"
INSTRUMENTS = (
    ("fx_N", "fy_N", "fz_N", "mx_Nmm", "my_Nmm", "mz_Nmm"),
    ("x_mm", "y_mm", "z_mm", "rx_rad", "ry_rad", "rz_rad"),
)
"""Columns that are read by one device: a load cell, a tracker."""


class SensorCrossTalk(SensorFault):
    """y -> y + share x, x the reading of another column of the same instrument; named column<other."""

    name = "sensor_cross_talk"
    title = "a sensor answers to what another one reads"
    equation = "y -> y + share x, x another column"
    signature = "one column is off in proportion to the reading of another one"
    limits = "linear; two columns of one instrument"
    source = "cross-talk of multi-axis load cells"
    parameters = (
        Parameter("share", "1", 0.0, 0.01, -1.0, 1.0, "of what the other tells apart, in what this one does"),
    )
    other: str = ""

    def at(self, column: str) -> Self:
        """column<other: of the first, into which the second talks. ValueError for names that are none."""
        first, _, second = column.partition(INTO)
        if second.rpartition("_")[2] not in RESOLVED:
            raise ValueError(f"{column!r} names no two columns of readings, as in fy_N{INTO}fx_N")
        it = super().at(first)
        vars(it).update(
            name=f"{type(self).name}@{column}", title=f"{type(self).title}: {first} to {second}", other=second
        )
        return it

    @property
    def columns(self) -> tuple[str, ...]:
        """The one that answers, and the one it answers to."""
        return self.column, self.other

    def sites(self, columns: Sequence[str]) -> Iterator[str]:
        """Every column with every other of its instrument."""
        for instrument in INSTRUMENTS:
            mine = [name for name in columns if name in instrument]
            yield from (f"{one}{INTO}{other}" for one, other in permutations(mine, 2))

    @property
    def example(self) -> str:
        """Two columns."""
        return f"COLUMN{INTO}OTHER"

    def error(self, readings: Array, rows: Rows, values: Values) -> Array:
        units = [name.rpartition("_")[2] for name in (self.column, self.other)]
        scale = RESOLVED[units[0]] / RESOLVED[units[1]]
        return np.asarray(values["share"] * scale * readings[:, rows.columns.index(self.other)])
