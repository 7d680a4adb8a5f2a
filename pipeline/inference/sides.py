"""What a kink can take up in chi-square where its size is near the noise.

Each row may lie on either side of a stop, and is taken to lie on the better one. Where many rows are within their
noise of it, as in tests without axial load, these choices take up noise, and a play is fitted where there is none.
"""

from __future__ import annotations

from vjm.effects.base import Effect

SIDES = 25.0
"""Chi-square that the choices can take up: a play of half a micrometre took up 20 of 680 on a bench that had none."""


def sided(effect: Effect) -> bool:
    """Whether rows choose the side of a kink by themselves; along a history they do not."""
    return not effect.smooth and not effect.history
