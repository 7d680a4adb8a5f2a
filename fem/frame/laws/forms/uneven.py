"""Smooth elastic laws that no simple form describes: stairs, a jump, a bump off centre, a step with a cubic."""

from dataclasses import dataclass

import numpy as np

from fem.frame.laws.form import Elastic
from meshes.solid import Floats

STAIRS = ((-0.65, 0.30), (-0.2, 0.15), (0.3, 0.25), (0.8, 0.30))
"""Places and heights of the stairs, in units of the law's own reach and height: irregular, so that no wave fits."""


@dataclass(frozen=True)
class Staircase(Elastic):
    """F = k q + height Σ h_i (tanh((q / reach - x_i) / soft) + tanh(x_i / soft)) / 2 over `STAIRS`."""

    stiffness: float
    height: float
    reach: float
    soft: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        force, slope = self.stiffness * q, np.full_like(q, self.stiffness)
        for place, step in STAIRS:
            share = np.tanh((q / self.reach - place) / self.soft)
            force = force + 0.5 * self.height * step * (share + np.tanh(place / self.soft))
            slope = slope + 0.5 * self.height * step * (1.0 - share**2) / (self.soft * self.reach)
        return force, slope


@dataclass(frozen=True)
class Jump(Elastic):
    """F = k q and a jump at `place`, all of it but 4 % within `over` to both sides together."""

    stiffness: float
    jump: float
    place: float
    over: float

    abrupt = True
    """Its slope changes within a small part of its range."""

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        # tanh(2) is 0.964.
        soft = self.over / 4.0
        share = np.tanh((q - self.place) / soft)
        force = self.stiffness * q + 0.5 * self.jump * (share + np.tanh(self.place / soft))
        return force, self.stiffness + 0.5 * self.jump / soft * (1.0 - share**2)


@dataclass(frozen=True)
class Detent(Elastic):
    """F = k q + A (exp(-((q - c) / w)²) - exp(-(c / w)²)): a bump off centre, as of a magnet beside a hinge."""

    stiffness: float
    bump: float
    place: float
    reach: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        x = (q - self.place) / self.reach
        hill = self.bump * np.exp(-(x**2))
        force = self.stiffness * q + hill - self.bump * np.exp(-((self.place / self.reach) ** 2))
        return force, self.stiffness - 2.0 * x * hill / self.reach


@dataclass(frozen=True)
class LogisticAndCubic(Elastic):
    """F = A (σ((q - c) / w) - σ(-c / w)) + k q + b (q - c)³ + b c³, σ(x) = 1 / (1 + exp(-x))."""

    height: float
    place: float
    reach: float
    first: float
    third: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        # σ by tanh: it does not overflow.
        share = 0.5 * (1.0 + np.tanh(0.5 * (q - self.place) / self.reach))
        at_zero = 0.5 * (1.0 - np.tanh(0.5 * self.place / self.reach))
        off = q - self.place
        force = self.height * (share - at_zero) + self.first * q + self.third * (off**3 + self.place**3)
        slope = self.height * share * (1.0 - share) / self.reach + self.first + 3.0 * self.third * off**2
        return force, slope
