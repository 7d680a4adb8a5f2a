"""A law with the roles of force and coordinate exchanged: the coordinate is given over the load."""

from dataclasses import dataclass

import numpy as np

from fem.frame.laws.form import Elastic
from meshes.solid import Floats

ITERATIONS = 200
"""Of the inversion at most: bisection alone reaches rounding in about 60."""
ROUNDED = 4.0 * float(np.finfo(float).eps)
"""Share of a coordinate by which the load found may miss it."""


@dataclass(frozen=True)
class OverLoad(Elastic):
    """The coordinate as a function of the force: q = F / k + g(F), g an elastic law that grows and is zero at zero.

    k, positive, is what is left of the stiffness where g is flat. F is found by Newton's method inside a bracket.
    ValueError for a g that is not zero at zero.
    """

    law: Elastic
    stiffness: float

    def __post_init__(self) -> None:
        at_zero = float(self.law.curve(np.zeros(1))[0][0])
        if at_zero or not self.stiffness > 0.0:
            raise ValueError(
                f"a coordinate over the load starts at {at_zero:g} with the stiffness {self.stiffness:g}, "
                "allowed are 0 and a positive one"
            )

    @property
    def abrupt(self) -> bool:
        """Of the law inside."""
        return self.law.abrupt

    def advanced(self, q: Floats, step: Floats) -> Floats:
        """The coordinate at the load that the tangent foretells: over the load the law is smooth, over q it is not."""
        force, stiffness = self.curve(q)
        return self._at(force + stiffness * step)[0]

    def _at(self, force: Floats) -> tuple[Floats, Floats]:
        """Coordinate and compliance at a load."""
        more, rate = self.law.curve(force)
        return force / self.stiffness + more, 1.0 / self.stiffness + rate

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`; the load to rounding of q."""
        low, high = np.minimum(0.0, self.stiffness * q), np.maximum(0.0, self.stiffness * q)
        force, allowed = 0.0 * q, ROUNDED * np.abs(q)
        for _ in range(ITERATIONS):
            place, compliance = self._at(force)
            missing = q - place
            far = np.abs(missing) > allowed
            if not far.any():
                break
            low, high = np.where(missing > 0.0, force, low), np.where(missing < 0.0, force, high)
            new = force + missing / compliance
            new = np.where((new >= low) & (new <= high), new, 0.5 * (low + high))
            force = np.where(far, new, force)
        return force, 1.0 / self._at(force)[1]
