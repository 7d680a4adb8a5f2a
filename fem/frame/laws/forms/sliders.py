"""Dry friction with an elastic start: springs in series with sliders, alone, several, or beside a spring.

Sources: G. M. Jenkins, Brit. J. Appl. Phys. 13 (1962) 30-32; W. D. Iwan, J. Appl. Mech. 33 (1966) 893-900;
G. Masing, Proc. 2nd Int. Congr. Appl. Mech., Zurich 1926, 332-335 (a curve from sliders, and its loops).
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fem.frame.laws.form import Law, Response, jenkins
from meshes.solid import Floats

SLIDERS = 6
"""Of the Iwan law."""
FINE = 24
"""Sliders that make the curve of Ramberg and Osgood; between their places it is a polygon."""


def _together(q: Floats, memory: Floats, stiffness: Floats, most: Floats) -> Response:
    """Sliders (N,) side by side; memory (..., N)."""
    force, slope, sliders = jenkins(q[..., None], memory, stiffness, most)
    return force.sum(-1), slope.sum(-1), sliders


@dataclass(frozen=True)
class Coulomb(Law):
    """One level: a spring of stiffness F0 / s in series with a slider of force F0."""

    force: float
    presliding: float
    width: ClassVar[int] = 1
    """The slider's place."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        force, slope, slider = jenkins(q, memory[..., 0], self.force / self.presliding, self.force)
        return force, slope, slider[..., None]


@dataclass(frozen=True)
class CoulombTwoLevels(Law):
    """Two sliders side by side, each with its own force and presliding."""

    force: tuple[float, float]
    presliding: tuple[float, float]
    width: ClassVar[int] = 2
    """Both sliders' places."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        most = np.array(self.force)
        return _together(q, memory, most / np.array(self.presliding), most)


@dataclass(frozen=True)
class CoulombByLoad(Law):
    """F = k q beside a slider that carries `share` of the joint's axial load, N, at the end of the load step before.

    `spring`: stiffness before the slider moves; `stiffness`: k, zero for the slider alone. Explicit by intent: within a
    load step the limit is constant, zero in the first one. The memory (load, slider) moves on with the load step.
    """

    share: float
    spring: float
    stiffness: float = 0.0
    by_load_step: ClassVar[bool] = True
    loaded: ClassVar[bool] = True
    width: ClassVar[int] = 2
    """Axial load, and the slider's place."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        most = self.share * memory[..., 0]
        force, slope, slider = jenkins(q, memory[..., 1], self.spring, most)
        return force + self.stiffness * q, slope + self.stiffness, np.stack((memory[..., 0], slider), axis=-1)


@dataclass(frozen=True)
class Iwan(Law):
    """Six sliders of equal stiffness that let go one after another, the last at `last`; all carry `force` then."""

    force: float
    last: float
    width: ClassVar[int] = SLIDERS
    """The sliders' places."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        lets_go = self.last * np.arange(1, SLIDERS + 1) / SLIDERS
        stiffness = np.full(SLIDERS, self.force / lets_go.sum())
        return _together(q, memory, stiffness, stiffness * lets_go)


@dataclass(frozen=True)
class LinearAndCoulomb(Law):
    """F = k q beside one slider of force F0 with its presliding."""

    stiffness: float
    force: float
    presliding: float
    width: ClassVar[int] = 1
    """The slider's place."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        force, slope, slider = jenkins(q, memory[..., 0], self.force / self.presliding, self.force)
        return force + self.stiffness * q, slope + self.stiffness, slider[..., None]


@dataclass(frozen=True)
class RambergOsgood(Law):
    """First loading q = q0 [f + a f^n], f = F / F0, for f > 0; unloading by Masing's rule, from sliders on a polygon.

    The polygon has its corners at `FINE` forces from F0 / FINE to `most` F0; it goes on along its last side.
    """

    force: float
    start: float
    more: float
    exponent: float
    most: float
    width: ClassVar[int] = FINE - 1
    """The sliders' places: one at each inner corner."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        share = np.linspace(0.0, self.most, FINE + 1)
        corner = self.start * (share + self.more * share**self.exponent)
        side = self.force * np.diff(share) / np.diff(corner)
        stiffness = side[:-1] - side[1:]
        force, slope, sliders = _together(q, memory, stiffness, stiffness * corner[1:-1])
        return force + side[-1] * q, slope + side[-1], sliders
