"""Sensors: from the true pose and load of the platform to what is read, in all twelve channels.

Channels 0 to 5 are the pose (p, rotation vector), 6 to 11 the wrench on the platform at its point. A control
prescribes readings, so a sensor acts on inputs and outputs alike. Arrays carry leading batch axes.
Sensors apply in the order of their `stage`, whatever order they are given in: what the solver means by a load,
what carries the linkage, what hangs on the platform, where the cell's point is, how the cell is turned.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Protocol

import numpy as np

from vjm.frames import (
    Array,
    exp,
    inverse_rotation_jacobian,
    log,
    moment_gradient,
    rotation_jacobian,
    skew,
)


@dataclass(frozen=True, eq=False)
class BaseMotion:
    """Where the base body stands: turn (..., 3, 3), shift (..., 3) of its origin, mm.

    slope: (..., 6, 12) of shift and spin by pose and load.
    """

    turn: Array
    shift: Array
    slope: Array


@dataclass(frozen=True, eq=False)
class Channels:
    """Twelve channels (..., 12) with their derivative (..., 12, 12) by those that a sensor, or the first one, sees.

    base: how the base body moves on its springs; None where it stands still.
    """

    values: Array
    slope: Array
    base: BaseMotion | None = None


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
        values, slope = channels.copy(), _unit(channels)
        turned = np.swapaxes(inverse_rotation_jacobian(phi), -1, -2)
        values[..., 9:] = np.einsum("...ij,...j->...i", turned, mu)
        slope[..., 9:, 3:6] = moment_gradient(phi, mu)
        slope[..., 9:, 9:] = turned
        return Channels(values, slope)


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
        to_origin = np.zeros((*channels.shape[:-1], 6, 12))
        to_origin[..., :3, 6:9] = to_origin[..., 3:, 9:] = np.eye(3)
        to_origin[..., 3:, 6:9] = skew(p)
        to_origin[..., 3:, :3] = -skew(f)
        moved = np.concatenate([f, m + np.cross(p, f)], axis=-1) @ self.compliance.T
        slope = self.compliance @ to_origin
        slope[..., 3:, :] = rotation_jacobian(moved[..., 3:]) @ slope[..., 3:, :]
        return BaseMotion(exp(moved[..., 3:]), moved[..., :3], slope)

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
        return Channels(values, _unit(channels))


@dataclass(frozen=True, eq=False)
class CellOffset:
    """A cell whose point lies at r (3,), mm, from the platform point, base frame: it reads m - r x f."""

    r: Array
    stage: ClassVar[int] = 3

    def read(self, channels: Array) -> Channels:
        slope = _unit(channels)
        slope[..., 9:, 6:9] = -skew(self.r)
        return Channels(np.einsum("...ij,...j->...i", slope, channels), slope)


@dataclass(frozen=True, eq=False)
class CellTurn:
    """A cell turned by R = exp(turn), turn (3,) rad, base frame: it reads R^T f and R^T m."""

    turn: Array
    stage: ClassVar[int] = 4

    def read(self, channels: Array) -> Channels:
        slope = _unit(channels)
        slope[..., 6:9, 6:9] = slope[..., 9:, 9:] = exp(self.turn).T
        return Channels(np.einsum("...ij,...j->...i", slope, channels), slope)


def through(sensors: tuple[Sensor, ...], channels: Array) -> Channels:
    """All sensors in the order of their stage, from true pose and load (..., 12)."""
    values, slope, base = channels, None, None
    for sensor in sorted(sensors, key=lambda each: each.stage):
        if isinstance(sensor, BaseSpring):
            own = sensor.motion(values)
            moved = own if slope is None else replace(own, slope=own.slope @ slope)
            base = moved if base is None else _after(moved, base)
            after = _carried(values, own)
        else:
            after = sensor.read(values)
        values, slope = after.values, after.slope if slope is None else after.slope @ slope
    return Channels(values, _unit(channels) if slope is None else slope, base)


def _after(outer: BaseMotion, inner: BaseMotion) -> BaseMotion:
    """The motion of a body on a body that moves itself."""
    arm = np.einsum("...ij,...j->...i", outer.turn, inner.shift)
    slope = outer.slope.copy()
    slope[..., :3, :] += outer.turn @ inner.slope[..., :3, :] - skew(arm) @ outer.slope[..., 3:, :]
    slope[..., 3:, :] += outer.turn @ inner.slope[..., 3:, :]
    return BaseMotion(outer.turn @ inner.turn, arm + outer.shift, slope)


def _carried(channels: Array, base: BaseMotion) -> Channels:
    """Channels seen from the ground, with their slope by those (..., 12) seen from the base body."""
    turn, rate = base.turn, base.slope[..., 3:, :]
    whole = turn @ exp(channels[..., 3:6])
    values, slope = np.empty_like(channels), _unit(channels)
    for i in (0, 6, 9):
        carried = np.einsum("...ij,...j->...i", turn, channels[..., i : i + 3])
        values[..., i : i + 3] = carried
        slope[..., i : i + 3, :] = -skew(carried) @ rate
        slope[..., i : i + 3, i : i + 3] += turn
    values[..., :3] += base.shift
    slope[..., :3, :] += base.slope[..., :3, :]
    values[..., 3:6] = log(whole)
    own = np.zeros_like(rate)
    own[..., 3:6] = turn @ rotation_jacobian(channels[..., 3:6])
    slope[..., 3:6, :] = inverse_rotation_jacobian(values[..., 3:6]) @ (rate + own)
    return Channels(values, slope)


def _unit(channels: Array) -> Array:
    return np.broadcast_to(np.eye(12), (*channels.shape, 12)).copy()
