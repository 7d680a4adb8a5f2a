"""What a kink takes up in chi-square where its size is near the noise.

Each row may lie on either side of a stop, and is taken to lie on the better one, charged for the way there. Rows that
are within their noise of a stop, as in tests without axial load, still take up noise by that choice.
"""

from __future__ import annotations

from vjm.effects.base import Effect

SIDE = 0.36
"""Of chi-square, that a row without play takes up on average by choosing its side of one as large as the noise, of the
better of two displacements and with the sign of a force that is all noise; less of other plays."""
SPREAD = 2.5
"""Twice the standard deviation of the same, of a row."""


def sided(effect: Effect) -> bool:
    """Whether rows choose the side of a kink by themselves; along a history they do not."""
    return not effect.smooth and not effect.history
