"""Modes of the solid bar and modes by formula, or on another mesh, brought together by their shapes."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from fem.axis_shape import AxisShape, mac
from fem.mode_formulas import FormulaMode
from meshes.solid import Floats
from pipeline.validation.bands import SHAPE


@dataclass(frozen=True)
class Match:
    """`partner` is the index of the candidate of the same shape, None where there is none; `nearest` that of the most
    similar candidate, `mac` (0 to 1) how similar that or the partner is."""

    partner: int | None
    nearest: int
    mac: float


def matched(likeness: Floats) -> list[Match]:
    """A match for each of n modes from the MAC (n, m) with each of m candidates, no candidate twice.

    The pairs are those with the largest sum of MAC; a pair below the band of the shape is none.
    """
    found = []
    partners = dict(zip(*linear_sum_assignment(-likeness), strict=True))
    for mode, row in enumerate(likeness):
        nearest = int(np.argmax(row))
        partner = partners.get(mode)
        if partner is not None and row[partner] >= SHAPE.value:
            found.append(Match(int(partner), nearest, float(row[partner])))
        else:
            found.append(Match(None, nearest, float(row[nearest])))
    return found


def with_formulas(shapes: Sequence[AxisShape], formulas: Sequence[FormulaMode]) -> list[Match]:
    """The formula of each shape."""
    return matched(np.array([[mac(a, f.shape(a.x)) for f in formulas] for a in shapes]))


def with_shapes(shapes: Sequence[AxisShape], others: Sequence[AxisShape]) -> list[Match]:
    """The same mode on another mesh, for each shape."""
    return matched(np.array([[mac(a, b) for b in others] for a in shapes]))
