"""Forms without memory: a curve y(x), its slope and its integral, as a spring or, in series, as a compliance."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

from vjm.forms.base import Form
from vjm.frames import Array
from vjm.laws import Law, Response

NEAR = 1e-14
"""Of the bracket, to which a load is found."""
ROUNDS = 200
FARTHEST = 1e15
"""N or N·mm up to which a load is looked for."""


@dataclass(frozen=True, eq=False)
class Points:
    """At x (...): value, slope and integral from zero of y for each unit amplitude, (..., n)."""

    value: Array
    slope: Array
    integral: Array

    @classmethod
    def of(cls, *parts: tuple[Array, Array, Array]) -> Points:
        """One triple of value, slope and integral for each amplitude."""
        return cls(*(np.stack(np.broadcast_arrays(*each), axis=-1) for each in zip(*parts, strict=True)))


class CurveForm(Form):
    """A form that is a curve."""

    @abstractmethod
    def points(self, x: Array, shapes: Array) -> Points:
        """At x (...)."""

    def columns(self, x: Array, first: np.ndarray, shapes: Array) -> Array:
        return self.points(x, shapes).value

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return Compliance(self, amplitudes, shapes) if series else Spring(self, amplitudes, shapes)


@dataclass(frozen=True, eq=False)
class Spring:
    """Force over displacement along a curve."""

    form: CurveForm
    amplitudes: Array
    shapes: Array

    @property
    def initial_memory(self) -> Array:
        return np.zeros(0)

    def respond(self, strain: Array, memory: Array) -> Response:
        there = self.form.points(strain[..., 0], self.shapes)
        force, slope, energy = (each @ self.amplitudes for each in (there.value, there.slope, there.integral))
        return Response(energy, force[..., None], slope[..., None, None], memory)


@dataclass(frozen=True, eq=False)
class Compliance:
    """Displacement over load along a curve that rises everywhere; the force at a displacement is looked for, from the
    displacement without load on.

    Where the curve does not rise there is no such law: force and tangent are no numbers there.
    """

    form: CurveForm
    amplitudes: Array
    shapes: Array

    @property
    def initial_memory(self) -> Array:
        return np.zeros(0)

    def give(self, force: Array) -> Array:
        """Strain at a force; both (...)."""
        return np.asarray(self.form.points(force, self.shapes).value @ self.amplitudes)

    def respond(self, strain: Array, memory: Array) -> Response:
        u = strain[..., 0]
        force = self._force(u)
        there = self.form.points(force, self.shapes)
        slope = there.slope @ self.amplitudes
        with np.errstate(divide="ignore", invalid="ignore"):
            tangent = np.where(slope > 0.0, 1.0 / slope, np.nan)
        energy = u * force - there.integral @ self.amplitudes
        return Response(energy, force[..., None], tangent[..., None, None], memory)

    def _force(self, u: Array) -> Array:
        """By Newton's method inside a bracket that is halved where it leaves it."""
        unloaded = self.give(np.zeros(()))
        sign = np.where(u < unloaded, -1.0, 1.0)
        aim = np.abs(u - unloaded)

        def give(size: Array) -> tuple[Array, Array]:
            there = self.form.points(sign * size, self.shapes)
            return sign * (there.value @ self.amplitudes - unloaded), there.slope @ self.amplitudes

        low, high = np.zeros(u.shape), np.ones(u.shape)
        beyond = give(high)[0] < aim
        while beyond.any():
            low = np.where(beyond, high, low)
            high = np.where(beyond, 4.0 * high, high)
            beyond = (give(high)[0] < aim) & (high < FARTHEST)
        here = 0.5 * (low + high)
        for _ in range(ROUNDS):
            value, slope = give(here)
            over = value > aim
            high, low = np.where(over, here, high), np.where(over, low, here)
            with np.errstate(divide="ignore", invalid="ignore"):
                next_ = here - (value - aim) / slope
            inside = (next_ > low) & (next_ < high)
            new = np.where(inside, next_, 0.5 * (low + high))
            done = np.abs(new - here) <= NEAR * np.maximum(high, 1e-300)
            here = new
            if done.all():
                break
        return np.where(high < FARTHEST, sign * here, np.nan)


def odd(x: Array, size: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
    """Value, slope and integral of the odd continuation of those at abs(x)."""
    return np.sign(x) * size[0], size[1], size[2]
