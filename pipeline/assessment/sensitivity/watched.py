"""Criteria that note which of them, halved or doubled, would have decided something else on the way to an answer.

A criterion stands for its value and the values that it might have. Arithmetic is done with all of them; a comparison is
answered by its value, and one that any of the others would answer in another way is noted with that other. Where it
leaves the comparisons (as a count of turns, in an array), it is noted with all others. An answer that was found without
noting one is what it would be with that one: the same comparisons have the same outcomes.
"""

from __future__ import annotations

import operator
from collections.abc import Iterable
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from pipeline.selection.criteria import CRITERIA, Criteria

FACTORS = (0.5, 2.0)
Key = tuple[str, float]


class Watched(Criteria):
    """Equal to itself alone, so that nothing takes it for what it stands for."""

    __hash__ = object.__hash__

    def __eq__(self, other: object) -> bool:
        return self is other


class Value(NDArrayOperatorsMixin):
    """value: as it is. others: as it might be, by the criterion and its factor. noted: those that decide."""

    def __init__(self, value: Any, others: dict[Key, Any], noted: set[Key]) -> None:
        self.value, self.others, self.noted = value, others, noted

    def _left(self) -> Any:
        """The value, for what is no comparison: any other might matter."""
        self.noted.update(self.others)
        return self.value

    def __bool__(self) -> bool:
        self.noted.update(key for key, other in self.others.items() if bool(other) != bool(self.value))
        return bool(self.value)

    def __float__(self) -> float:
        return float(self._left())

    def __int__(self) -> int:
        return int(self._left())

    def __str__(self) -> str:
        return str(self._left())

    def __format__(self, how: str) -> str:
        return format(self._left(), how)

    def __reduce_ex__(self, _: Any) -> Any:
        raise TypeError("a watched criterion stays in its process: what a copy notes is lost")

    def __index__(self) -> int:
        return operator.index(self._left())

    def __round__(self, digits: int | None = None) -> Any:
        return round(self._left(), digits)

    def __hash__(self) -> int:
        return hash(self._left())

    def __array__(self, *given: Any, **named: Any) -> np.ndarray:
        return np.asarray(self._left(), *given, **named)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *given: Any, **named: Any) -> Any:
        def of(key: Key | None) -> Any:
            return getattr(ufunc, method)(*(_at(it, key) for it in given), **named)

        keys = {key for it in given if isinstance(it, Value) for key in it.others}
        value = of(None)
        if "out" in named:
            # It was written into an array, in place.
            self.noted.update(keys)
        elif np.asarray(value).dtype == bool:
            self.noted.update(key for key in keys if np.any(of(key) != value))
        elif np.ndim(value) == 0:
            return Value(value, {key: of(key) for key in keys}, self.noted)
        else:
            self.noted.update(keys)
        return value


def watched(names: Iterable[str]) -> tuple[Watched, set[Key]]:
    """The criteria with those of these names watched, and those of their changes that decided, which grows."""
    noted: set[Key] = set()
    values = {each.name: getattr(CRITERIA, each.name) for each in fields(CRITERIA)}
    for name in names:
        others = {(name, factor): getattr(CRITERIA.times(name, factor), name) for factor in FACTORS}
        values[name] = Value(values[name], others, noted)
    return Watched(**values), noted


def _at(it: Any, key: Key | None) -> Any:
    return it if not isinstance(it, Value) else it.value if key is None else it.others.get(key, it.value)
