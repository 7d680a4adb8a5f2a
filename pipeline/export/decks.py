"""What decks of finite-element programs share: numbers of nodes and elements, and the two nodes of a spring."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pipeline.export.content import Spring
from vjm.frames import Array

FIRST = 900001
"""Of nodes and elements, above those that a mesh is likely to have; a hundred for each spring."""


@dataclass(frozen=True, eq=False)
class Numbered:
    """A spring with the first of its hundred numbers of nodes and elements, and a number of its own from 1."""

    number: int
    first: int
    spring: Spring


def numbered(springs: Sequence[Spring]) -> Iterator[Numbered]:
    """Each spring with its numbers."""
    for k, spring in enumerate(springs):
        yield Numbered(k + 1, FIRST + 100 * k, spring)


def terms_of(row: Array) -> Iterator[tuple[int, float]]:
    """Places and values of what is not zero in a row (n,)."""
    for k in np.flatnonzero(row):
        yield int(k), float(row[k])
