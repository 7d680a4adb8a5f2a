"""Play between two stops, with a soft centring spring inside.

F = k q within ±a; beyond, the stop adds STOP (|q| - a) sign(q). The stop is 1e8 N/mm, some thousand times a bar's
axial stiffness: it gives 0.04 µm at 4 kN, far below any gauge, and its contact force still keeps 1e-7 N at the
rounding of a 0.1 mm play.
"""

import numpy as np

from meshes.solid import Floats

CENTRING = 20.0
"""Centring spring inside the play, N/mm."""
STOP = 1e8
"""Stop at the end of the play, N/mm."""


def play(q: Floats, half: Floats) -> tuple[Floats, Floats]:
    """Force N and stiffness N/mm at q mm for a play of ±half mm."""
    over = np.maximum(np.abs(q) - half, 0.0)
    return CENTRING * q + STOP * over * np.sign(q), CENTRING + np.where(over > 0.0, STOP, 0.0)
