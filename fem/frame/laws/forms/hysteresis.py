"""Smooth hysteresis, hysteresis of one sign, creep and damage: laws that follow what happened before.

Sources: P. R. Dahl, A solid friction model, Aerospace Corporation TOR-158, 1968; R. Bouc, Proc. 4th Conf. Nonlinear
Oscillation, Prague 1967, with Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263; the standard linear solid as in
W. N. Findley, J. S. Lai, K. Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials, 1976, section 5.4.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from fem.frame.laws.form import Law, Response, jenkins
from meshes.solid import Floats


@dataclass(frozen=True)
class Dahl(Law):
    """k q beside dF/dq = (F0 / s) (1 - sign(dq) F / F0), solved exactly from step to step."""

    stiffness: float
    force: float
    presliding: float
    width: ClassVar[int] = 2
    """Coordinate and friction force before."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        way = (q - memory[..., 0]) / self.presliding
        goal = np.where(way < 0.0, -self.force, self.force)
        left = (memory[..., 1] - goal) * np.exp(-np.abs(way))
        slope = -np.sign(goal) * left / self.presliding
        friction = goal + left
        return self.stiffness * q + friction, self.stiffness + slope, np.stack((q, friction), axis=-1)


@dataclass(frozen=True)
class BoucWen(Law):
    """F = k q + F0 z, s dz/dq = 1 - (1 + sign(z dq)) z² / 2: hardens like tanh, unloads along a straight line.

    Exponent 2, β = γ; solved exactly from step to step.
    """

    stiffness: float
    force: float
    presliding: float
    width: ClassVar[int] = 2
    """Coordinate before, and z."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        way = (q - memory[..., 0]) / self.presliding
        sign = np.where(way < 0.0, -1.0, 1.0)
        z, length = sign * memory[..., 1], np.abs(way)
        # Unloading to z = 0 first, where z is against the way.
        straight = np.minimum(length, np.maximum(-z, 0.0))
        from_here, t = np.maximum(z, 0.0), np.tanh(length - straight)
        new = np.where(length > straight, (from_here + t) / (1.0 + from_here * t), z + straight)
        slope = np.where(new > 0.0, 1.0 - new**2, 1.0)
        z = sign * new
        rate = self.force / self.presliding * slope
        return self.stiffness * q + self.force * z, self.stiffness + rate, np.stack((q, z), axis=-1)


@dataclass(frozen=True)
class OneSidedHysteresis(Law):
    """k q beside a slider that carries no more than `wedge` times a positive coordinate, at most F0.

    Below zero there is no loop. `spring` is that of the slider; k has to be larger than `wedge` where the whole must be
    stable alone.
    """

    stiffness: float
    force: float
    wedge: float
    spring: float

    abrupt = True
    """It has kinks."""

    width: ClassVar[int] = 1
    """The slider's place."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        most = np.clip(self.wedge * q, 0.0, self.force)
        force, slope, slider = jenkins(q, memory[..., 0], self.spring, most)
        slides = slope == 0.0
        grows = np.where((q > 0.0) & (self.wedge * q < self.force), self.wedge, 0.0)
        slope = np.where(slides, np.sign(self.spring * (q - memory[..., 0])) * grows, slope)
        return force + self.stiffness * q, slope + self.stiffness, slider[..., None]


@dataclass(frozen=True)
class Creep(Law):
    """Standard linear solid: F = k q + m (q - v), where v follows q by 1 - exp(-1 / n) of the way in each load step.

    n: `steps`. In the step in which q jumps, v has followed already by one step's share.
    """

    stiffness: float
    relaxing: float
    steps: float
    by_load_step: ClassVar[bool] = True
    width: ClassVar[int] = 1
    """What the dashpot has given."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        keeps = np.exp(-1.0 / self.steps)
        late = q - memory[..., 0]
        force = self.stiffness * q + self.relaxing * keeps * late
        return force, np.full_like(q, self.stiffness + self.relaxing * keeps), (q - keeps * late)[..., None]


@dataclass(frozen=True)
class Damage(Law):
    """F = k (1 - d) q, where d = loss (1 - exp(-(p - from) / over)) of the largest |q| so far, p, beyond `from`.

    Stiffness that is lost stays lost. The first loading is monotone where loss times `start` is below `over`.
    """

    stiffness: float
    loss: float
    start: float
    over: float
    width: ClassVar[int] = 1
    """Largest |q| so far."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`."""
        peak = np.maximum(memory[..., 0], np.abs(q))
        beyond = np.maximum(peak - self.start, 0.0) / self.over
        damage = -self.loss * np.expm1(-beyond)
        grows = (np.abs(q) > memory[..., 0]) & (beyond > 0.0)
        rate = np.where(grows, self.loss / self.over * np.exp(-beyond), 0.0)
        force = self.stiffness * (1.0 - damage) * q
        return force, self.stiffness * (1.0 - damage - rate * np.abs(q)), peak[..., None]
