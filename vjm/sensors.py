"""Sensors: from the true pose and load of the platform to what is read, in all twelve channels.

Channels 0 to 5 are the pose (p, rotation vector), 6 to 11 the wrench on the platform at its point. A control
prescribes readings, so a sensor acts on inputs and outputs alike. Arrays carry leading batch axes.
Sensors apply in the order of their `stage`, whatever order they are given in: what the solver means by a load,
what carries the linkage, what hangs on the platform, where the cell's point is, how the cell is turned.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Protocol

import numpy as np

from vjm.frames import Array, exp, inverse_rotation_jacobian, log, moment_gradient, rotation_jacobian, skew


@dataclass(frozen=True, eq=False)
class BaseMotion:
    """Where the base body stands: turn (..., 3, 3), shift (..., 3) of its origin, mm.

    slopes: `slope`, or what makes it, as most readings are not asked for it.
    """

    turn: Array
    shift: Array
    slopes: Array | Callable[[], Array]

    @cached_property
    def slope(self) -> Array:
        """(..., 6, 12) of shift and spin by pose and load."""
        return self.slopes() if callable(self.slopes) else self.slopes


@dataclass(frozen=True, eq=False)
class Channels:
    """Twelve channels (..., 12).

    slopes: `slope`, or what makes it; None where it is one. base: how the base body moves on its springs; None where it
    stands still.
    """

    values: Array
    slopes: Array | Callable[[], Array] | None
    base: BaseMotion | None = None

    @cached_property
    def slope(self) -> Array:
        """(..., 12, 12) by the channels that a sensor, or the first one, sees."""
        if self.slopes is None:
            return _unit(self.values)
        return self.slopes() if callable(self.slopes) else self.slopes


class Sensor(Protocol):
    """One map of the channels onto themselves, differentiable."""

    @property
    def stage(self) -> int: ...

    def read(self, channels: Array) -> Channels: ...


@dataclass(frozen=True)
class TrueMoment:
    """From the load conjugate to the rotation vector, which the solvers use, to true moments."""

    stage: ClassVar[int] = 0

    def read(self, channels: Array) -> Channels:
        phi, mu = channels[..., 3:6], channels[..., 9:]
        values = channels.copy()
        turned = np.swapaxes(inverse_rotation_jacobian(phi), -1, -2)
        values[..., 9:] = np.einsum("...ij,...j->...i", turned, mu)

        def slopes() -> Array:
            slope = _unit(channels)
            slope[..., 9:, 3:6] = moment_gradient(phi, mu)
            slope[..., 9:, 9:] = turned
            return slope

        return Channels(values, slopes)


@dataclass(frozen=True, eq=False)
class BaseSpring:
    """The base on springs: its displacement (p_d, phi_d) is compliance (6, 6) x wrench at the base origin.

    What comes in is seen from the base body, what goes out from the ground. Displacements of the base being
    small, the wrench that bends it is taken along the base body's own axes.
    """

    compliance: Array
    stage: ClassVar[int] = 1

    def motion(self, channels: Array) -> BaseMotion:
        """Of the base on its springs; its slope is by the channels (..., 12) seen from the base body."""
        p, f, m = (channels[..., i : i + 3] for i in (0, 6, 9))
        moved = np.concatenate([f, m + np.cross(p, f)], axis=-1) @ self.compliance.T

        def slopes() -> Array:
            to_origin = np.zeros((*channels.shape[:-1], 6, 12))
            to_origin[..., :3, 6:9] = to_origin[..., 3:, 9:] = np.eye(3)
            to_origin[..., 3:, 6:9] = skew(p)
            to_origin[..., 3:, :3] = -skew(f)
            slope = self.compliance @ to_origin
            slope[..., 3:, :] = rotation_jacobian(moved[..., 3:]) @ slope[..., 3:, :]
            return slope

        return BaseMotion(exp(moved[..., 3:]), moved[..., :3], slopes)

    def read(self, channels: Array) -> Channels:
        return _carried(channels, self.motion(channels))


@dataclass(frozen=True, eq=False)
class DeadWeight:
    """A dead force (3,), N, on the platform point that the cell does not exert, and so does not read."""

    force: Array
    stage: ClassVar[int] = 2

    def read(self, channels: Array) -> Channels:
        values = channels.copy()
        values[..., 6:9] -= self.force
        return Channels(values, None)


@dataclass(frozen=True, eq=False)
class ReadAt:
    """Displacements are read at a point at r (3,), mm, from the platform point, base frame in the nominal pose, that
    moves with the platform as one rigid body; the load acts at the platform point all the same."""

    r: Array
    stage: ClassVar[int] = 2

    def read(self, channels: Array) -> Channels:
        phi = channels[..., 3:6]
        arm = np.asarray(exp(phi) @ self.r)
        values = channels.copy()
        values[..., :3] += arm

        def slopes() -> Array:
            slope = _unit(channels)
            slope[..., :3, 3:6] = -skew(arm) @ rotation_jacobian(phi)
            return slope

        return Channels(values, slopes)


@dataclass(frozen=True, eq=False)
class CellOffset:
    """A cell whose point lies at r (3,), mm, from the platform point, base frame: it reads m - r x f."""

    r: Array
    stage: ClassVar[int] = 3

    def read(self, channels: Array) -> Channels:
        slope = np.eye(12)
        slope[9:, 6:9] = -skew(self.r)
        return Channels(channels @ slope.T, lambda: np.broadcast_to(slope, (*channels.shape, 12)))


@dataclass(frozen=True, eq=False)
class CellTurn:
    """A cell turned by R = exp(turn), turn (3,) rad, base frame: it reads R^T f and R^T m."""

    turn: Array
    stage: ClassVar[int] = 4

    def read(self, channels: Array) -> Channels:
        slope = np.eye(12)
        slope[6:9, 6:9] = slope[9:, 9:] = exp(self.turn).T
        return Channels(channels @ slope.T, lambda: np.broadcast_to(slope, (*channels.shape, 12)))


def through(sensors: tuple[Sensor, ...], channels: Array) -> Channels:
    """All sensors in the order of their stage, from true pose and load (..., 12)."""
    here = Channels(channels, None)
    for sensor in sorted(sensors, key=lambda each: each.stage):
        here = _beyond(here, sensor)
    return here


def _beyond(before: Channels, sensor: Sensor) -> Channels:
    """What a sensor makes of what those before it read."""
    base = before.base
    if isinstance(sensor, BaseSpring):
        own = sensor.motion(before.values)
        moved = replace(own, slopes=lambda: _chained(own, before))
        base = moved if base is None else _after(moved, base)
        after = _carried(before.values, own)
    else:
        after = sensor.read(before.values)
    return Channels(after.values, lambda: _chained(after, before), base)


def _chained(after: Channels | BaseMotion, before: Channels) -> Array:
    if isinstance(after, Channels) and after.slopes is None:
        return before.slope
    return after.slope if before.slopes is None else after.slope @ before.slope


def _after(outer: BaseMotion, inner: BaseMotion) -> BaseMotion:
    """The motion of a body on a body that moves itself."""
    arm = np.einsum("...ij,...j->...i", outer.turn, inner.shift)

    def slopes() -> Array:
        slope = outer.slope.copy()
        slope[..., :3, :] += outer.turn @ inner.slope[..., :3, :] - skew(arm) @ outer.slope[..., 3:, :]
        slope[..., 3:, :] += outer.turn @ inner.slope[..., 3:, :]
        return slope

    return BaseMotion(outer.turn @ inner.turn, arm + outer.shift, slopes)


def _carried(channels: Array, base: BaseMotion) -> Channels:
    """Channels seen from the ground, with their slope by those (..., 12) seen from the base body."""
    turn, values = base.turn, np.empty_like(channels)
    for i in (0, 6, 9):
        values[..., i : i + 3] = np.einsum("...ij,...j->...i", turn, channels[..., i : i + 3])
    carried = values.copy()
    values[..., :3] += base.shift
    values[..., 3:6] = log(turn @ exp(channels[..., 3:6]))

    def slopes() -> Array:
        rate, slope = base.slope[..., 3:, :], _unit(channels)
        for i in (0, 6, 9):
            slope[..., i : i + 3, :] = -skew(carried[..., i : i + 3]) @ rate
            slope[..., i : i + 3, i : i + 3] += turn
        slope[..., :3, :] += base.slope[..., :3, :]
        own = np.zeros_like(rate)
        own[..., 3:6] = turn @ rotation_jacobian(channels[..., 3:6])
        slope[..., 3:6, :] = inverse_rotation_jacobian(values[..., 3:6]) @ (rate + own)
        return slope

    return Channels(values, slopes)


def _unit(channels: Array) -> Array:
    return np.broadcast_to(np.eye(12), (*channels.shape, 12)).copy()
