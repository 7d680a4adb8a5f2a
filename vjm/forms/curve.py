"""Forms without memory: a curve y(x), its slope and its integral, as a spring or, in series, as a compliance."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm.forms.base import Form
from vjm.frames import Array
from vjm.laws import Elastic, Law, Response

NEAR = 1e-14
"""Of a load, to which it is found."""
EQUAL = 2.0 * np.finfo(float).eps
"""Of a strain, within which two are the same."""
BETWEEN = 200
"""Loads that are looked at together for the one from which a curve goes on straight."""
ROUNDS = 200
LEAST_SLOPE = 0.05
"""Of the slope without load, at which a curve that would fall goes on straight."""
SCANNED = 400
"""Loads from which one is looked for, and at which it is looked whether a curve falls."""
FARTHEST = 1e15
"""N or N·mm up to which a load is looked for."""
_LOADS = np.logspace(-12.0, np.log10(FARTHEST), SCANNED)


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

    def beside(self, other: Points) -> Points:
        """These amplitudes, then those of another."""
        pairs = ((self.value, other.value), (self.slope, other.slope), (self.integral, other.integral))
        return Points(*(np.concatenate(each, axis=-1) for each in pairs))


class CurveForm(Form):
    """A form that is a curve."""

    @abstractmethod
    def points(self, x: Array, shapes: Array) -> Points:
        """At x (...)."""

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        return self.points(x, shapes).value

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return Compliance(self, amplitudes, shapes) if series else Spring(self, amplitudes, shapes)


@dataclass(frozen=True, eq=False)
class Spring(Elastic):
    """Force over displacement along a curve."""

    form: CurveForm
    amplitudes: Array
    shapes: Array

    def respond(self, strain: Array, memory: Array) -> Response:
        there = self.form.points(strain[..., 0], self.shapes)
        force, slope, energy = (each @ self.amplitudes for each in (there.value, there.slope, there.integral))
        return Response(energy, force[..., None], slope[..., None, None], memory)


@dataclass(frozen=True, eq=False)
class Compliance(Elastic):
    """Displacement over load along a curve; the force at a displacement is looked for, from the displacement without
    load on.

    Where a curve with a slope without load would fall it goes on straight, from where its slope is `LEAST_SLOPE` of
    that: what was measured is before. Any other curve that does not rise is no such law: force and tangent are no
    numbers there.
    """

    form: CurveForm
    amplitudes: Array
    shapes: Array

    def give(self, force: Array) -> Array:
        """Strain at a force; both (...)."""
        # Without load no curve goes on straight yet: most who ask want that strain alone.
        return self._at(force)[0] if np.any(force) else self._curve(force)[0]

    @cached_property
    def _unloaded(self) -> float:
        """Strain without load."""
        return float(self.give(np.zeros(())))

    @cached_property
    def _ends(self) -> tuple[float, float]:
        """Loads between which the curve is what its form says."""
        first = float(self._curve(np.zeros(()))[1])
        if not (np.isfinite(first) and first > 0.0):
            return -np.inf, np.inf
        low, high = (self._end(sign, first) for sign in (-1.0, 1.0))
        return -low, high

    def _end(self, sign: float, first: float) -> float:
        """The load of a sign at which the slope is the least one, of a curve that falls somewhere; else infinite."""
        slopes = self._curve(sign * _LOADS)[1]
        if not np.any(slopes <= 0.0):
            return np.inf
        least = LEAST_SLOPE * first
        k = int(np.argmax(slopes <= least))
        low, high = (_LOADS[k - 1] if k else 0.0), float(_LOADS[k])
        # The first place where the slope is no more than that, between ever nearer loads, which are looked at together.
        # With a kink at no load it is there: nearer than the least load that is looked at it is not asked.
        while high - low > NEAR * max(high, float(_LOADS[0])):
            between = np.linspace(low, high, BETWEEN)
            k = max(int(np.argmax(self._curve(sign * between)[1] <= least)), 1)
            low, high = float(between[k - 1]), float(between[k])
        return high

    def _curve(self, force: Array) -> tuple[Array, Array, Array]:
        """Displacement, slope and integral as the form says."""
        there = self.form.points(force, self.shapes)
        value, slope, integral = (
            each @ self.amplitudes for each in (there.value, there.slope, there.integral)
        )
        return value, slope, integral

    def _at(self, force: Array) -> tuple[Array, Array, Array]:
        """Displacement, slope and integral (...) at a force (...), straight beyond the ends."""
        low, high = self._ends
        inside = np.clip(force, low, high)
        value, slope, integral = self._curve(inside)
        beyond = force - inside
        return value + slope * beyond, slope, integral + value * beyond + 0.5 * slope * beyond**2

    def respond(self, strain: Array, memory: Array) -> Response:
        u = strain[..., 0]
        force = self._force(u)
        _, slope, integral = self._at(force)
        with np.errstate(divide="ignore", invalid="ignore"):
            tangent = np.where(slope > 0.0, 1.0 / slope, np.nan)
        energy = u * force - integral
        return Response(energy, force[..., None], tangent[..., None, None], memory)

    @cached_property
    def _way(self) -> Array:
        """(2, 1 + SCANNED) how far from the strain without load the curve has come at most up to no load and up to
        each load of `_LOADS`, of either sign, downwards first."""
        to = np.append(0.0, _LOADS)
        return np.stack(
            [np.maximum.accumulate(sign * (self.give(sign * to) - self._unloaded)) for sign in (-1.0, 1.0)]
        )

    def _force(self, u: Array) -> Array:
        """By Newton's method between two loads of the table, halved where it leaves them; nan where no load of the
        table is enough."""
        below = u < self._unloaded
        sign, aim = np.where(below, -1.0, 1.0), np.abs(u - self._unloaded)
        k = np.where(below, *(np.searchsorted(way, aim) for way in self._way))
        reached = k <= SCANNED
        k = np.clip(k, 1, SCANNED)
        low, high = np.append(0.0, _LOADS)[k - 1], _LOADS[k - 1]
        before, after = (self._way[np.where(below, 0, 1), at] for at in (k - 1, k))
        with np.errstate(divide="ignore", invalid="ignore"):
            here = low + (high - low) * np.clip(np.nan_to_num((aim - before) / (after - before)), 0.0, 1.0)
        for _ in range(ROUNDS):
            value, slope, _ = self._at(sign * here)
            off = sign * (value - u)
            low, high = np.where(off > 0.0, low, here), np.where(off > 0.0, here, high)
            with np.errstate(divide="ignore", invalid="ignore"):
                new = here - off / slope
            new = np.where((new >= low) & (new <= high), new, 0.5 * (low + high))
            near = np.abs(new - here) <= NEAR * high
            # Nearer than that the curve is not told from its strain in double precision.
            done = near | (np.abs(off) <= EQUAL * (np.abs(value) + abs(self._unloaded)))
            here = new
            if np.all(done | ~reached):
                break
        return np.where(reached, sign * here, np.nan)


def odd(x: Array, size: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
    """Value, slope and integral at x of the odd continuation of those at abs(x), all (...)."""
    return np.sign(x) * size[0], size[1], size[2]
