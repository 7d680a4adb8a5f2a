"""How alike the effects look in a campaign's tests, as a matrix."""

from __future__ import annotations

import numpy as np

from pipeline.diagnose.apart import multiple_correlation
from pipeline.diagnose.diagnosis import Diagnosis
from pipeline.diagnose.picture import Picture
from pipeline.page.curves import numbers
from pipeline.page.record import Isolability, Numbers

SHOWS = 0.1
"""Sigmas of all readings together below which an effect of its typical size is invisible: noise alone makes one."""


def isolability(found: Diagnosis) -> Isolability:
    """Correlations about the model with those chosen effects that are there or not, each at its typical size."""
    shelf = found.shelf
    root = frozenset(name for name in found.sets[0] if not shelf.candidates[name].parameters)
    about = shelf.picture(root)
    names = tuple(shelf.order(frozenset(about.signatures)))
    rows = tuple(_row(about, name, names) for name in names)
    return Isolability(about=about.fit.model.names, effects=names, correlation=rows)


def _row(about: Picture, name: str, names: tuple[str, ...]) -> Numbers:
    # Columns are in typical sizes; one with kinks has a single column, of its first probe.
    mine = about.columns(name).sum(axis=1)
    if np.linalg.norm(mine) < SHOWS:
        return (None,) * len(names)
    return numbers(
        1.0 if other == name else multiple_correlation(mine, about.columns(other)) for other in names
    )
