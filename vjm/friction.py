"""Coulomb friction with an elastic start: the Jenkins element, a spring in series with a slider.

G. M. Jenkin, "The resolution of the yielding of metals", 1922; W. D. Iwan, "A distributed-element model for
hysteresis and its steady-state dynamic response", Journal of Applied Mechanics 33 (1966) 893-900.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm import checks
from vjm.frames import Array
from vjm.laws import Response


@dataclass(frozen=True)
class Jenkins:
    """Scalar law: force = stiffness x (strain - slip), its size at most `limit`.

    limit: N or N·mm. presliding: strain, mm or rad, at which a relaxed element begins to slip.
    memory: slip, and the work lost so far, N·mm. The force follows the end of the step (backward Euler), which
    is exact while the strain does not turn back within a step. The energy is that of the spring alone.
    ValueError unless both numbers are positive and finite.
    """

    limit: float
    presliding: float

    def __post_init__(self) -> None:
        checks.positive("limit", self.limit)
        checks.positive("presliding", self.presliding)

    @property
    def stiffness(self) -> float:
        """Slope before slip, limit over presliding."""
        return self.limit / self.presliding

    @property
    def initial_memory(self) -> Array:
        return np.zeros(2)

    def respond(self, strain: Array, memory: Array) -> Response:
        slip, lost = memory[..., :1], memory[..., 1:]
        trial = self.stiffness * (strain - slip)
        force = np.clip(trial, -self.limit, self.limit)
        tangent = np.where(np.abs(trial) < self.limit, self.stiffness, 0.0)[..., None]
        new = strain - force / self.stiffness
        remembered = np.concatenate([new, lost + self.limit * np.abs(new - slip)], axis=-1)
        return Response(0.5 * force[..., 0] ** 2 / self.stiffness, force, tangent, remembered)
