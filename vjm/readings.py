"""What the sensors and gauges of a mechanism read at given unknowns, and what a control makes of it."""

from __future__ import annotations

import numpy as np

from vjm import lagrangian
from vjm.frames import Array
from vjm.gauges import Gauge
from vjm.lagrangian import Control
from vjm.mechanism import Mechanism
from vjm.sensors import BaseMotion, Channels, base_motion, through


def channels(mechanism: Mechanism, unknowns: Array) -> Channels:
    """Pose and load (..., 12) as read, with their derivative (..., 12, 12) by true pose and load."""
    return through(mechanism.sensors, _true(mechanism, unknowns))


def _true(mechanism: Mechanism, unknowns: Array) -> Array:
    place = lagrangian.layout(mechanism)
    load = np.sum([unknowns[..., dual] for dual in place.multipliers], axis=0)
    return np.concatenate([unknowns[..., place.platform], load], axis=-1)


def read(mechanism: Mechanism, unknowns: Array, drives: Array) -> Array:
    """All readings (..., 12 + G) at unknowns (..., N) and inputs (..., D): pose, load, gauges."""
    parts = [channels(mechanism, unknowns).values]
    base = _base(mechanism, unknowns)
    for gauge in mechanism.gauges:
        here = _coordinates(mechanism, gauge.chain, unknowns, drives)
        unloaded = lagrangian.rest(mechanism, drives, unloaded=True)[gauge.chain]
        reading = gauge.at(here, unloaded)
        if base is not None:
            point = gauge.point(here)
            lifted = np.einsum("...ij,...j->...i", base.turn, point) - point + base.shift
            reading = reading + lifted @ gauge.direction
        parts.append(reading[..., None])
    return np.concatenate(parts, axis=-1)


def read_slope(mechanism: Mechanism, unknowns: Array, drives: Array, change: Array) -> Array:
    """Change (..., 12 + G, k) of all readings with a change (..., N, k) of the unknowns."""
    place = lagrangian.layout(mechanism)
    load = np.sum([change[..., dual, :] for dual in place.multipliers], axis=0)
    both = np.concatenate([change[..., place.platform, :], load], axis=-2)
    parts = [channels(mechanism, unknowns).slope @ both]
    base = _base(mechanism, unknowns)
    for gauge in mechanism.gauges:
        slope, by_base = _gauge_slopes(gauge, _coordinates(mechanism, gauge.chain, unknowns, drives), base)
        moving = slope[..., None, mechanism.chains[gauge.chain].moving]
        part = moving @ change[..., place.coordinates[gauge.chain], :]
        parts.append(part if by_base is None else part + by_base[..., None, :] @ both)
    return np.concatenate(parts, axis=-2)


def control_of(mechanism: Mechanism, unknowns: Array, drives: Array, numbers: np.ndarray) -> Control:
    """The equations "reading of channel `numbers` (B, 6) = target", linearised and dimensionless."""
    place = lagrangian.layout(mechanism)
    held = (numbers < 6) | (numbers >= 12)
    none = tuple(None for _ in mechanism.chains)
    gauged = numbers >= 12
    if not mechanism.sensors and not np.any(gauged):
        unit = np.eye(6)
        return Control(unit * held[..., None], unit * ~held[..., None], none, held, plain=True)
    slope = channels(mechanism, unknowns).slope
    chosen = np.take_along_axis(slope, np.where(gauged, 0, numbers)[..., None], axis=-2)
    chosen = np.where(gauged[..., None], 0.0, chosen)
    by_gauges = _by_gauges(mechanism, unknowns, drives, numbers, chosen)
    size = np.where(held, place.pose_scale, place.load_scale)[..., None]
    by_pose = chosen[..., :6] * place.pose_scale / size
    by_load = chosen[..., 6:] * place.load_scale / size
    return Control(by_pose, by_load, by_gauges, held, plain=False)


def _by_gauges(
    mechanism: Mechanism, unknowns: Array, drives: Array, numbers: np.ndarray, chosen: Array
) -> tuple[Array | None, ...]:
    """(B, 6, m) of each chain that has a controlled gauge, dimensionless; pose and load enter `chosen` (B, 6, 12)."""
    place, base = lagrangian.layout(mechanism), _base(mechanism, unknowns)
    out: list[Array | None] = [None for _ in mechanism.chains]
    for number, gauge in enumerate(mechanism.gauges):
        here = numbers == 12 + number
        if not np.any(here):
            continue
        chain, x = mechanism.chains[gauge.chain], place.coordinates[gauge.chain]
        whole, by_base = _gauge_slopes(gauge, _coordinates(mechanism, gauge.chain, unknowns, drives), base)
        if by_base is not None:
            chosen += here[..., None] * by_base[..., None, :]
        slope = whole[..., chain.moving]
        rows = here[..., None] * (slope * place.scale[x] / place.pose_scale[0])[..., None, :]
        before = out[gauge.chain]
        out[gauge.chain] = rows if before is None else before + rows
    return tuple(out)


def _base(mechanism: Mechanism, unknowns: Array) -> BaseMotion | None:
    return base_motion(mechanism.sensors, _true(mechanism, unknowns)) if mechanism.gauges else None


def _gauge_slopes(gauge: Gauge, coordinates: Array, base: BaseMotion | None) -> tuple[Array, Array | None]:
    """Derivatives (..., n) by the coordinates of its chain and (..., 12) by true pose and load, if it has any."""
    if base is None:
        return gauge.slope(coordinates), None
    arm = np.einsum("...ij,...j->...i", base.turn, gauge.point(coordinates))
    turned = np.cross(arm, gauge.direction)
    by_base = np.concatenate([np.broadcast_to(gauge.direction, turned.shape), turned], axis=-1)
    lift = np.einsum("...i,...ij->...j", by_base, base.slope)
    return gauge.slope(coordinates, gauge.direction @ base.turn), lift


def _coordinates(mechanism: Mechanism, number: int, unknowns: Array, drives: Array) -> Array:
    place, chain = lagrangian.layout(mechanism), mechanism.chains[number]
    start = lagrangian.rest(mechanism, drives)[number]
    return lagrangian.chain_coordinates(chain, unknowns[..., place.coordinates[number]], start)
