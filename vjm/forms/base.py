"""What a form of a law is: one function y = f(x; amplitudes, shapes) that may remember the way, with its units.

At a joint that moves y is a force or a moment and x the coordinate; in series y is a displacement and x the load
through it (`vjm.law_sites`). y is linear in the amplitudes. A form makes columns of a history, by which it is fitted
where influences are known, and a law for the mechanism.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from vjm.frames import Array
from vjm.laws import Law

_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Quantity:
    """A number of a form, of the unit y^of_y x^of_x N^of_load. positive: whether it has a meaning above zero alone.
    span: least and greatest that a fit may try, of a shape; of one in the unit of x in the largest x."""

    name: str
    of_y: int
    of_x: int
    meaning: str
    positive: bool = False
    of_load: int = 0
    span: tuple[float, float] = (1e-3, 10.0)

    def unit(self, y: str, x: str) -> str:
        """Its unit where y and x have these."""
        powers = [(y, self.of_y), (x, self.of_x), ("N", self.of_load)]
        above = "·".join(_power(u, n) for u, n in powers if n > 0)
        below = [_power(u, -n) for u, n in powers if n < 0]
        wrapped = [f"({u})" if "·" in u and "(" not in u else u for u in below]
        return "/".join([above or "1", *wrapped]) if above or below else "1"

    def identifier(self, y: str, x: str) -> str:
        """Its name with its unit, as parameters of effects are named."""
        powers = [(y.replace("·", ""), self.of_y), (x.replace("·", ""), self.of_x), ("N", self.of_load)]
        above = "".join(f"_{u}{n if n > 1 else ''}" for u, n in powers if n > 0)
        below = "".join(f"_per_{u}{-n if n < -1 else ''}" for u, n in powers if n < 0)
        return f"{self.name}{above}{below}"


def _power(unit: str, n: int) -> str:
    whole = f"({unit})" if "·" in unit and n > 1 else unit
    return whole if n == 1 else f"{whole}{str(n).translate(_SUPERSCRIPTS)}"


class Form(ABC):
    """A form of a law.

    name: as files and answers call it. title: in words. equation: y of x. limits: where it stops to hold.
    places: "parallel", "series" or both. amplitudes, shapes: its numbers; fixed: shapes that are
    no numbers of a fit but say where another one is told. memory: whether the way matters.
    loaded: whether the axial load of the bar beside it matters, N.
    kinked: whether each load step is on one side of a stop, as of a gap.
    grows: far outside: at most linearly ("bounded", "linear"), as a "power" or as an "exponential".
    """

    name: ClassVar[str]
    title: ClassVar[str]
    equation: ClassVar[str]
    limits: ClassVar[str] = ""
    places: ClassVar[tuple[str, ...]] = ("parallel", "series")
    amplitudes: ClassVar[tuple[Quantity, ...]]
    shapes: ClassVar[tuple[Quantity, ...]] = ()
    begins_at: ClassVar[tuple[tuple[float, ...], ...]] = ((),)
    """Shapes to begin a fit with, one after another; those in the unit of x in the largest x."""
    fixed: ClassVar[tuple[str, ...]] = ()
    memory: ClassVar[bool] = False
    loaded: ClassVar[bool] = False
    kinked: ClassVar[bool] = False
    grows: ClassVar[str] = "linear"
    and_linear: ClassVar[bool] = False
    """Whether a linear part beside it makes another form."""
    beside: ClassVar[tuple[str, ...]] = ()
    """Places of that one, where they are not those of the form alone."""
    holds: ClassVar[tuple[str, ...]] = ()
    """Names of the forms that it is where some of its numbers are equal, or one."""
    effects: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    """By kind of a site, the effects of the catalogue that together are this law there, or hold it."""

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """Amplitudes, then shapes."""
        return (*self.amplitudes, *self.shapes)

    @abstractmethod
    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        """(R, n) y of unit amplitudes along x (R,), of tests that begin, relaxed, at the rows `first` (tests + 1).

        axial: (R,) load of the bar there, N, for forms on which it acts; default none at all.
        """

    def starts(self, largest: float) -> Sequence[Array]:
        """Shapes to begin a fit with, where x goes as far as the largest."""
        return [np.array(each) * self._sizes(largest) for each in self.begins_at]

    def under(self, shapes: Array, load: float) -> Array:
        """Shapes where the axial load goes as far as `load`, N: those of most forms are the same under any."""
        return shapes

    def bounds(self, largest: float) -> tuple[Array, Array]:
        """Least and greatest shapes that a fit may try."""
        low, high = np.array([q.span for q in self.shapes]).reshape(-1, 2).T * self._sizes(largest)
        return low, high

    def _sizes(self, largest: float) -> Array:
        """What shapes are told in."""
        return np.array([largest if q.of_x == 1 else 1.0 for q in self.shapes])

    @abstractmethod
    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        """The law as a force or moment over its coordinate, mm or rad. ValueError for numbers of which none can be
        made."""


def by_tests(x: Array, first: np.ndarray) -> tuple[Array, np.ndarray]:
    """A history (R,) as (T, S), filled up with the last value of each test, and (R,) its places there when flat."""
    counts = np.diff(first)
    steps = np.minimum(np.arange(int(counts.max())), counts[:, None] - 1)
    rows = first[:-1, None] + steps
    places = np.concatenate([k * steps.shape[1] + np.arange(n) for k, n in enumerate(counts)])
    return x[rows], places
