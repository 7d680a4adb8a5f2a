"""Frozen records whose arrays share a leading axis of independent tests: take some of them, put them back."""

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]
T = TypeVar("T")


def take(record: T, index: Ints) -> T:
    """The record of the tests at `index` (k,): arrays (B, ...) become (k, ...)."""
    return _mapped(record, lambda a: a[index])


def put(record: T, index: Ints, part: T) -> T:
    """The record with the tests at `index` (k,) replaced by those of `part`: arrays (B, ...) and (k, ...)."""
    if isinstance(record, np.ndarray):
        out = record.copy()
        out[index] = part
        return out
    if is_dataclass(record) and not isinstance(record, type):
        changed = {f.name: put(getattr(record, f.name), index, getattr(part, f.name)) for f in fields(record)}
        return replace(record, **changed)
    return record


def _mapped(record: Any, change: Callable[[Any], Any]) -> Any:
    if isinstance(record, np.ndarray):
        return change(record)
    if isinstance(record, tuple):
        return tuple(_mapped(part, change) for part in record)
    if is_dataclass(record) and not isinstance(record, type):
        return replace(record, **{f.name: _mapped(getattr(record, f.name), change) for f in fields(record)})
    return record
