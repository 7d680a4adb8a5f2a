"""Faults of sensors: what a column reads beside what is there. Nothing of the mechanism changes."""

from __future__ import annotations

import copy
from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from vjm.effects.base import Changing, Effect, Parameter, Rig, Sizes, Values
from vjm.frames import Array

UNITS = {"Nmm": "N·mm"}
RESOLVED = {"mm": 1e-3, "rad": 2e-5, "N": 1.0, "Nmm": 50.0}
"""What a good sensor of each unit tells apart on the bench of the paper."""


@dataclass(frozen=True, eq=False)
class Rows:
    """The rows of a campaign as they were read. test: (R,) number of each; step: (R,) within it, from 0; clock: (R,)
    share of the campaign that was done before, 0 to 1. columns: of the channels."""

    test: NDArray[np.int64]
    step: Array
    clock: Array
    columns: tuple[str, ...]


def _one(unit: str, along: str = "") -> float:
    return 1.0


class SensorFault(Effect):
    """A fault of one sensor, named by its column after an @: what it reads too much.

    column: of the sensor; "" for the kind of fault by itself, which no sensor has yet. factor: by unit, of the rig's
    sizes against those of the paper's.
    """

    kinds: ClassVar = ("parallelogram", "bar", "manipulator")
    parts: ClassVar = "sensors"
    column: str = ""
    factor: Sizes = staticmethod(_one)

    @abstractmethod
    def error(self, readings: Array, rows: Rows, values: Values) -> Array:
        """(R,) what its column reads too much, of readings (R, C) as they would be without the fault."""

    def follows(self, readings: Array, rows: Rows, values: Values) -> NDArray[np.int64]:
        """(R,) the row whose motion each reading follows: its own, or the last that moved it where it stands still.

        readings: (R, C) as they would be without the fault."""
        return np.arange(len(readings))

    def at(self, column: str) -> Self:
        """The fault of the sensor of a column. ValueError for a name that is none."""
        unit = column.rpartition("_")[2]
        if unit not in RESOLVED:
            raise ValueError(f"{column!r} is no column of readings")
        other = copy.copy(self)
        scale = self.factor(unit) * RESOLVED[unit]
        # A class has the kind of fault, an object that of one sensor.
        vars(other).update(
            probes=tuple(value * scale for value in type(self).probes),
            column=column,
            name=f"{type(self).name}@{column}",
            title=f"{type(self).title}: {column}",
            parameters=tuple(_of_unit(p, unit, scale) for p in type(self).parameters),
        )
        return other

    def sized_by(self, factor: Sizes) -> Self:
        """The fault with sizes so many times as large, by the unit of its column, now or when it has one."""
        other = copy.copy(self)
        vars(other)["factor"] = factor
        return other.at(self.site) if self.column else other

    def limited(self, most: float) -> Self:
        """The fault with no size beyond `most` (> 0), in the unit of its column."""
        of_column = [p.unit == SIZE.unit for p in type(self).parameters]
        parameters = tuple(
            replace(p, low=max(p.low, -most), high=min(p.high, most), typical=min(p.typical, most))
            if own
            else p
            for p, own in zip(self.parameters, of_column, strict=True)
        )
        other = copy.copy(self)
        vars(other).update(parameters=parameters)
        return other

    @property
    def kind(self) -> str:
        """Of fault: its name without the sensor."""
        return type(self).name

    @property
    def columns(self) -> tuple[str, ...]:
        """Of all sensors that it needs."""
        return (self.column,)

    def sites(self, columns: Sequence[str]) -> Iterator[str]:
        """What may stand after the @ where these columns are read."""
        yield from columns

    @property
    def example(self) -> str:
        """How a sensor may be written after the @."""
        return "COLUMN"

    @property
    def site(self) -> str:
        """What stands after the @."""
        return self.name.partition("@")[2]

    def change(self, rig: Rig, values: Values) -> Rig:
        """The mechanism is what it was."""
        return rig

    def apply(self, mechanism: Changing, values: Values, site: str = "") -> Changing:
        """The mechanism is what it was."""
        return mechanism

    def own(self, readings: Array, rows: Rows) -> Array:
        """(R,) readings of its column."""
        return np.asarray(readings[:, rows.columns.index(self.column)])


SIZE = Parameter("size", "of the column", 0.0, 10.0, -1e5, 1e5, "error of the reading at its largest")
"""A size in the unit of the column: its typical value and bounds are in what a good sensor tells apart."""


def _of_unit(parameter: Parameter, unit: str, scale: float) -> Parameter:
    if parameter.unit != SIZE.unit:
        return parameter
    return replace(parameter, unit=UNITS.get(unit, unit)).times(scale)


def lagged(values: Array, rows: Rows, keeps: float) -> Array:
    """(R,) what a sensor reads that keeps a part of its last reading, from rest at the start of each test."""
    out = np.zeros_like(values)
    before = 0.0
    for row, value in enumerate(values.tolist()):
        if row and rows.test[row] != rows.test[row - 1]:
            before = 0.0
        before = keeps * before + (1.0 - keeps) * value
        out[row] = before
    return out
