"""Whether two values hold the same: dataclasses by their fields, arrays by their numbers, NaN equal to NaN."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from types import MethodType
from typing import Any

import numpy as np

from vjm.effects.base import Effect


def same(one: Any, other: Any) -> bool:
    """Whether they hold the same, however they came about: computed, pickled or read from a file."""
    if one is other:
        return True
    if _kind(one) != _kind(other):
        return False
    if isinstance(one, np.ndarray):
        return one.shape == other.shape and bool(np.array_equal(one, other, equal_nan=one.dtype.kind == "f"))
    if isinstance(one, float):
        return one == other or (one != one and other != other)
    if isinstance(one, Mapping):
        return list(one) == list(other) and all(same(one[key], other[key]) for key in one)
    if isinstance(one, Sequence) and not isinstance(one, str | bytes):
        return len(one) == len(other) and all(map(same, one, other))
    if is_dataclass(one):
        return all(same(getattr(one, f.name), getattr(other, f.name)) for f in fields(one) if f.compare)
    if isinstance(one, MethodType):
        # What it is bound to is compared where that stands.
        return bool(one.__func__.__qualname__ == other.__func__.__qualname__)
    if isinstance(one, Effect):
        return same(vars(one), vars(other))
    return bool(one == other)


def _kind(it: object) -> tuple[str, str]:
    """By its name: a file with effects that is run again defines its classes anew."""
    return type(it).__module__, type(it).__qualname__
