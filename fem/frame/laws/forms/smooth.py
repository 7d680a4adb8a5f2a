"""Smooth elastic laws: polynomials, saturation, hardening, powers, a periodic part, a preload.

Coordinates are in mm or rad, forces in N or N mm; a coefficient has the unit that its term needs.
"""

from dataclasses import dataclass

import numpy as np

from fem.frame.laws.form import Elastic
from meshes.solid import Floats

LEAST_SLOPE = 0.05
"""Share of its first slope below which the even law goes on along its tangent, so that it stays monotone."""
STRAIGHT_FROM = 8.0
"""Multiple of its width from which exponential hardening goes on along its tangent: e^8 is 3 000 times its start."""


@dataclass(frozen=True)
class Linear(Elastic):
    """F = k q."""

    stiffness: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        return self.stiffness * q, np.full_like(q, self.stiffness)


@dataclass(frozen=True)
class PreloadedLinear(Elastic):
    """F = F0 + k q."""

    force: float
    stiffness: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        return self.force + self.stiffness * q, np.full_like(q, self.stiffness)


@dataclass(frozen=True)
class Cubic(Elastic):
    """F = c q³."""

    third: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        return self.third * q**3, 3.0 * self.third * q**2


@dataclass(frozen=True)
class LinearAndCubic(Elastic):
    """F = k q + c q³."""

    first: float
    third: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        return self.first * q + self.third * q**3, self.first + 3.0 * self.third * q**2


@dataclass(frozen=True)
class OddPolynomial(Elastic):
    """F = k1 q + k3 q³ + k5 q⁵."""

    first: float
    third: float
    fifth: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        square = q * q
        force = q * (self.first + square * (self.third + square * self.fifth))
        return force, self.first + square * (3.0 * self.third + 5.0 * square * self.fifth)


@dataclass(frozen=True)
class Progressive(Elastic):
    """F = q / a + c q³: a compliance a that hardens, as of rubber and bushings."""

    compliance: float
    third: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        return q / self.compliance + self.third * q**3, 1.0 / self.compliance + 3.0 * self.third * q**2


@dataclass(frozen=True)
class EvenPart(Elastic):
    """F = k q + b q²; on the side where it softens it goes on along its tangent from `LEAST_SLOPE` of k."""

    first: float
    second: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        if not self.second:
            return self.first * q, np.full_like(q, self.first)
        turn = (LEAST_SLOPE - 1.0) * self.first / (2.0 * self.second)
        beyond = q < turn if self.second > 0.0 else q > turn
        p = np.where(beyond, turn, q)
        slope = self.first + 2.0 * self.second * p
        return p * (self.first + self.second * p) + slope * (q - p), slope


@dataclass(frozen=True)
class Tanh(Elastic):
    """F = F0 tanh(q / w)."""

    force: float
    width_of_start: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        share = np.tanh(q / self.width_of_start)
        return self.force * share, self.force / self.width_of_start * (1.0 - share**2)


@dataclass(frozen=True)
class Atan(Elastic):
    """F = F0 (2 / π) atan(q / w)."""

    force: float
    width_of_start: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        x = q / self.width_of_start
        top = 2.0 / np.pi * self.force
        return top * np.arctan(x), top / self.width_of_start / (1.0 + x**2)


@dataclass(frozen=True)
class Exponential(Elastic):
    """F = F0 sign(q) (exp(|q| / w) - 1); beyond `STRAIGHT_FROM` widths along its tangent."""

    force: float
    width_of_start: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        x = np.abs(q) / self.width_of_start
        inside = np.minimum(x, STRAIGHT_FROM)
        slope = self.force * np.exp(inside)
        force = self.force * np.expm1(inside) + slope * (x - inside)
        return np.sign(q) * force, slope / self.width_of_start


@dataclass(frozen=True)
class Power(Elastic):
    """F = c q (q² + e²)^((p - 1) / 2): c sign(q) |q|^p, with a finite slope c e^(p - 1) at zero."""

    coefficient: float
    exponent: float
    smooth: float

    abrupt = True
    """Its slope changes within a small part of its range."""

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        size = q**2 + self.smooth**2
        ratio = self.coefficient * size ** (0.5 * (self.exponent - 1.0))
        return ratio * q, ratio * (1.0 + (self.exponent - 1.0) * q**2 / size)


@dataclass(frozen=True)
class Periodic(Elastic):
    """F = k q + A (sin(2π q / period + phase) - sin(phase)): a spring and the teeth of a gear or of rolling balls."""

    stiffness: float
    amplitude: float
    period: float
    phase: float

    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """As of `Elastic`."""
        rate = 2.0 * np.pi / self.period
        wave = np.sin(rate * q + self.phase) - np.sin(self.phase)
        slope = self.stiffness + self.amplitude * rate * np.cos(rate * q + self.phase)
        return self.stiffness * q + self.amplitude * wave, slope
