"""Play: a displacement that is nearly free within ± play and meets stops beyond.

The dead-zone law, as in F. Pfeiffer, C. Glocker, "Multibody Dynamics with Unilateral Contacts", Wiley 1996.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm import checks
from vjm.frames import Array
from vjm.laws import Elastic, Response

CENTRING = 20.0
"""N/mm: the soft spring inside the play, which keeps the position defined."""

STOP = 1e8
"""N/mm: the stops; some thousand times a bar's stiffness along its axis, so that 4 kN press them in by 0.04 µm."""


@dataclass(frozen=True)
class Clearance(Elastic):
    """Scalar law: centring spring within ± play, mm, and stops of the stiffness `stop`, N/mm, beyond.

    ValueError unless both numbers are positive and finite.
    """

    play: float
    stop: float = STOP

    def __post_init__(self) -> None:
        checks.positive("play", self.play)
        checks.positive("stop", self.stop)

    def respond(self, strain: Array, memory: Array) -> Response:
        beyond = strain - np.clip(strain, -self.play, self.play)
        force = CENTRING * strain + self.stop * beyond
        energy = 0.5 * CENTRING * strain[..., 0] ** 2 + 0.5 * self.stop * beyond[..., 0] ** 2
        tangent = np.where(beyond == 0.0, CENTRING, CENTRING + self.stop)[..., None]
        return Response(energy, force, tangent, memory)

    def pressed(self, strain: Array) -> tuple[Array, Array]:
        """Force, N, by which a stop is pressed at a strain, both (...), of the sign of the strain, and its slope, N/mm.

        Both are zero inside the play.
        """
        beyond = strain - np.clip(strain, -self.play, self.play)
        stiffness = CENTRING + self.stop
        return stiffness * beyond, np.where(beyond == 0.0, 0.0, stiffness)

    def give(self, force: Array) -> Array:
        """Strain at a force; both (...)."""
        inside = np.clip(force / CENTRING, -self.play, self.play)
        beyond = (force - CENTRING * inside) / (CENTRING + self.stop)
        return np.asarray(inside + beyond)
