"""Metre, newton, radian, for programs that count in them."""

from __future__ import annotations

import numpy as np

from pipeline.export.content import Spring
from vjm.frames import Array

METRE = 1e-3
"""Metres in a millimetre."""
UNITS = "Units of the file: N, m, rad, kg, s; converted from N, mm, rad."


def terms(spring: Spring) -> tuple[tuple[float, Array], ...]:
    """Its springs of one direction: N/m and (6,) elongations in m of metres and radians."""
    scale = np.repeat([1.0, METRE], 3)
    return tuple((s / METRE, scale * v) for s, v in spring.terms)
