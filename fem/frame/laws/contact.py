"""Hertz-like contact of both signs: δ = c sign(F) |F|^(2/3).

Below LINEAR_BELOW the law is the chord of that force: Hertz's law starts without stiffness, which no equilibrium
without load could stand on. At half that force it is 0.13 c mm short, c of the order 1e-5: a nanometre.
Source: K. L. Johnson, Contact Mechanics, Cambridge 1985, section 4.2 (exponent 2/3 of point contact).
"""

import numpy as np

from meshes.solid import Floats

LINEAR_BELOW = 1.0
"""Force below which the law is linear, N."""


def contact(q: Floats, c: Floats) -> tuple[Floats, Floats]:
    """Force N and stiffness N/mm at an approach q mm for c in mm/N^(2/3); zero where c is."""
    there = c > 0.0
    ratio = np.abs(q) / np.where(there, c, 1.0)
    start = LINEAR_BELOW ** (2.0 / 3.0)
    chord = LINEAR_BELOW / start
    root = np.sqrt(np.maximum(ratio, start))
    linear = ratio < start
    force = np.where(linear, chord * ratio, ratio * root) * np.sign(q)
    stiffness = np.where(linear, chord, 1.5 * root) / np.where(there, c, 1.0)
    return np.where(there, force, 0.0), np.where(there, stiffness, 0.0)
