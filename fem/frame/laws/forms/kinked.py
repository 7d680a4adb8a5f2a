"""Elastic laws with kinks: a dead zone, another stiffness in each direction."""

from dataclasses import dataclass

import numpy as np

from fem.frame.laws.form import Elastic
from meshes.solid import Floats


@dataclass(frozen=True)
class DeadZone(Elastic):
    """F = k_in q within ±gap; beyond, k (|q| - gap) sign(q) more. k_in centres: a series site needs it positive."""

    gap: float
    stiffness: float
    inside: float

    abrupt = True
    """It has kinks."""

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        over = np.maximum(np.abs(q) - self.gap, 0.0)
        force = self.inside * q + self.stiffness * over * np.sign(q)
        return force, self.inside + np.where(over > 0.0, self.stiffness, 0.0)


@dataclass(frozen=True)
class TwoSlopes(Elastic):
    """F = k_plus q where q is positive, k_minus q where it is negative: a one-sided support."""

    plus: float
    minus: float

    abrupt = True
    """It has kinks."""

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        slope = np.where(q > 0.0, self.plus, self.minus)
        return slope * q, slope


@dataclass(frozen=True)
class TwoDeadZones(Elastic):
    """A dead zone that ends at another place, on a stop of another stiffness, in each direction."""

    gap_plus: float
    plus: float
    gap_minus: float
    minus: float
    inside: float

    abrupt = True
    """It has kinks."""

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        above, below = np.maximum(q - self.gap_plus, 0.0), np.maximum(-q - self.gap_minus, 0.0)
        force = self.inside * q + self.plus * above - self.minus * below
        slope = np.where(above > 0.0, self.plus, 0.0) + np.where(below > 0.0, self.minus, 0.0)
        return force, self.inside + slope
