"""A parallelogram put together from rigid bars of different lengths: where its hinges stand before any load.

Bars of different lengths close the loop only with a turned platform. Nothing resists that turn but the hinges, so the
linkage takes it when it is put together, and whatever acts about a hinge, spring or friction, is relaxed there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array

ROUNDS = 6
"""Newton steps: a mismatch m leaves m / d after none, and its square at each."""


@dataclass(frozen=True)
class FourBar:
    """Loop of two rigid bars between pins `width` apart at base and platform, lengths and width in mm.

    Along the bars and across, with the turns R_y of bar i and of the platform a_i and phi, pins at z_i = -+ width / 2:
        L_2 cos a_2 - L_1 cos a_1 = width sin phi,    L_i sin a_i = L_2 sin q + z_i (1 - cos phi).
    The linkage moves freely across the bars; it stands where bar 2 alone would be at the angle q as drawn, so that
    without a mismatch nothing is turned, exactly. To first order phi = -(L_1 - L_2) / (width cos q).
    """

    lengths: tuple[float, float]
    width: float

    def turned(self, q: ArrayLike) -> tuple[Array, Array]:
        """Turns of both bars from q (..., 2) and of the platform (...), rad, unloaded, at the bars' angle q (...), rad.

        NaN where the loop does not close.
        """
        angle = np.asarray(q, dtype=float)
        turn = np.zeros((*angle.shape, 2))
        platform = np.zeros(angle.shape)
        length, z = np.array(self.lengths), 0.5 * self.width * np.array([-1.0, 1.0])
        for _ in range(ROUNDS):
            bars = angle[..., None] + turn
            sine, cosine = length * np.sin(bars), length * np.cos(bars)
            across = sine - length[1] * np.sin(angle[..., None]) - z * (1.0 - np.cos(platform[..., None]))
            along = cosine[..., 1] - cosine[..., 0] - self.width * np.sin(platform)
            # Each bar follows the platform: L cos a da = z sin(phi) dphi - what is left across.
            follow, back = z * np.sin(platform[..., None]) / cosine, across / cosine
            slope = sine[..., 0] * follow[..., 0] - sine[..., 1] * follow[..., 1]
            slope = slope - self.width * np.cos(platform)
            left = along - sine[..., 0] * back[..., 0] + sine[..., 1] * back[..., 1]
            step = -left / slope
            platform = platform + step
            turn = turn + follow * step[..., None] - back
        return turn, platform

    def hinges(self, bar: int, q: ArrayLike) -> Array:
        """Turns (..., 2), rad, of the hinges at base and tip of bar 0 or 1 from where they are drawn, unloaded."""
        turn, platform = self.turned(q)
        return np.stack([turn[..., bar], platform - turn[..., bar]], axis=-1)
