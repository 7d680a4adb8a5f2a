"""What the sensors and gauges of a mechanism read at given unknowns, and what a control makes of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm import lagrangian
from vjm.blocks import Control
from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.mechanism import Mechanism
from vjm.sensors import Channels, through


@dataclass(frozen=True, eq=False)
class Readings:
    """Of a mechanism at unknowns (..., N) and inputs (..., D); what several of them need is computed once."""

    mechanism: Mechanism
    unknowns: Array
    drives: Array

    @cached_property
    def channels(self) -> Channels:
        """Pose and load (..., 12) as read, with their derivative (..., 12, 12) by true pose and load."""
        place = lagrangian.layout(self.mechanism)
        load = np.sum([self.unknowns[..., dual] for dual in place.multipliers], axis=0)
        return through(
            self.mechanism.sensors, np.concatenate([self.unknowns[..., place.platform], load], axis=-1)
        )

    @cached_property
    def values(self) -> Array:
        """(..., 12 + G) pose, load, gauges."""
        parts, base = [self.channels.values], self.channels.base
        for gauge in self.mechanism.gauges:
            here = self._coordinates(gauge)
            unloaded = lagrangian.rest(self.mechanism, self.drives, unloaded=True)[gauge.chain]
            reading = gauge.at(here, unloaded)
            if base is not None:
                point = gauge.point(here)
                lifted = np.einsum("...ij,...j->...i", base.turn, point) - point + base.shift
                reading = reading + lifted @ gauge.direction
            parts.append(reading[..., None])
        return np.concatenate(parts, axis=-1)

    def change(self, unknowns: Array) -> Array:
        """(..., 12 + G, k) of all values with a change (..., N, k) of the unknowns."""
        mechanism, place = self.mechanism, lagrangian.layout(self.mechanism)
        load = np.sum([unknowns[..., dual, :] for dual in place.multipliers], axis=0)
        both = np.concatenate([unknowns[..., place.platform, :], load], axis=-2)
        parts = [self.channels.slope @ both]
        for gauge in mechanism.gauges:
            slope, by_base = self._gauge_slopes(gauge)
            moving = slope[..., None, mechanism.chains[gauge.chain].moving]
            part = moving @ unknowns[..., place.coordinates[gauge.chain], :]
            parts.append(part if by_base is None else part + by_base[..., None, :] @ both)
        return np.concatenate(parts, axis=-2)

    def control(self, numbers: np.ndarray) -> Control:
        """The equations "reading of channel `numbers` (B, 6) = target", linearised and dimensionless."""
        place = lagrangian.layout(self.mechanism)
        held = (numbers < 6) | (numbers >= 12)
        gauged = numbers >= 12
        if not self.mechanism.sensors and not np.any(gauged):
            unit, none = np.eye(6), tuple(None for _ in self.mechanism.chains)
            return Control(unit * held[..., None], unit * ~held[..., None], none, held, plain=True)
        chosen = np.take_along_axis(self.channels.slope, np.where(gauged, 0, numbers)[..., None], axis=-2)
        chosen = np.where(gauged[..., None], 0.0, chosen)
        by_gauges = self._by_gauges(numbers, chosen)
        # A gauge reads millimetres, whatever coordinate it takes the place of.
        own = np.where(gauged, place.pose_scale[0], place.pose_scale)
        size = np.where(held, own, place.load_scale)[..., None]
        by_pose = chosen[..., :6] * place.pose_scale / size
        by_load = chosen[..., 6:] * place.load_scale / size
        return Control(by_pose, by_load, by_gauges, held, plain=False)

    def _by_gauges(self, numbers: np.ndarray, chosen: Array) -> tuple[Array | None, ...]:
        """(B, 6, m) of each chain that has a controlled gauge, dimensionless; its base enters `chosen` (B, 6, 12)."""
        place = lagrangian.layout(self.mechanism)
        out: list[Array | None] = [None for _ in self.mechanism.chains]
        for number, gauge in enumerate(self.mechanism.gauges):
            here = numbers == 12 + number
            if not np.any(here):
                continue
            chain, x = self.mechanism.chains[gauge.chain], place.coordinates[gauge.chain]
            whole, by_base = self._gauge_slopes(gauge)
            if by_base is not None:
                chosen += here[..., None] * by_base[..., None, :]
            slope = whole[..., chain.moving]
            rows = here[..., None] * (slope * place.scale[x] / place.pose_scale[0])[..., None, :]
            before = out[gauge.chain]
            out[gauge.chain] = rows if before is None else before + rows
        return tuple(out)

    def _gauge_slopes(self, gauge: Gauge) -> tuple[Array, Array | None]:
        """Derivatives (..., n) by the coordinates of its chain and (..., 12) by true pose and load, if it has any."""
        here, base = self._coordinates(gauge), self.channels.base
        if base is None:
            return gauge.slope(here), None
        arm = np.einsum("...ij,...j->...i", base.turn, gauge.point(here))
        turned = np.cross(arm, gauge.direction)
        by_base = np.concatenate([np.broadcast_to(gauge.direction, turned.shape), turned], axis=-1)
        lift = np.einsum("...i,...ij->...j", by_base, base.slope)
        return gauge.slope(here, gauge.direction @ base.turn), lift

    def _coordinates(self, gauge: Gauge) -> Array:
        place, chain = lagrangian.layout(self.mechanism), self.mechanism.chains[gauge.chain]
        start = lagrangian.rest(self.mechanism, self.drives)[gauge.chain]
        return lagrangian.chain_coordinates(chain, self.unknowns[..., place.coordinates[gauge.chain]], start)
