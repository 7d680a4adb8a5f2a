"""What a sweep computes at a point of the workspace, vectorised over the points of a chunk."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from pipeline.manipulator.grid import Grid
from pipeline.manipulator.loaded import loaded_columns
from pipeline.manipulator.question import FOUND, LOST, REST, SINGULAR, UNREACHED, Array, Question
from pipeline.manipulator.reasons import (
    MOVES,
    NO_EQUILIBRIUM,
    NO_NODE,
    no_critical_load,
    numbers_of,
    reasons_of,
)
from vjm.manipulator.legs import critical_forces, shares
from vjm.manipulator.measures import principal, rotational, translational
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest

NODES = 5
"""Nodes along each axis of the coarse grid on which the legs' critical forces are found; cubic between them."""


@dataclass(frozen=True, eq=False)
class CriticalMap:
    """Force, N, at which each leg buckles, on coarse nodes of the box.

    force: (nx, ny, nz, legs); inf: it does not buckle. reason: of the same shape, why there is no force, a number of
    `reasons_of`; None: there is one everywhere.
    """

    axes: tuple[Array, Array, Array]
    force: Array
    reason: Array | None = None

    def at(self, points: Array) -> tuple[Array, Array]:
        """(B, legs) force at points (B, 3) mm of the box, and (B, legs) the reason of the nearest node.

        The force is NaN where that reason is not 0.
        """
        force, reason = self._between(points), self._nearest(points)
        return np.where(reason > 0.0, np.nan, force), reason

    def _between(self, points: Array) -> Array:
        # A compliance is zero where nothing buckles, so that all of it can be interpolated.
        long = [k for k, axis in enumerate(self.axes) if len(axis) > 1]
        values = (1.0 / self.force).reshape(*(len(self.axes[k]) for k in long), -1)
        if not long:
            with np.errstate(divide="ignore"):
                return np.broadcast_to(1.0 / values, (len(points), values.shape[-1]))
        method: Literal["cubic", "linear"] = "cubic" if all(len(self.axes[k]) > 3 for k in long) else "linear"
        found = RegularGridInterpolator([self.axes[k] for k in long], values, method)(points[:, long])
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / np.maximum(found, 0.0))

    def _nearest(self, points: Array) -> Array:
        if self.reason is None:
            return np.zeros((len(points), self.force.shape[-1]))
        near = tuple(
            np.argmin(np.abs(axis - points[:, k, None]), axis=-1) for k, axis in enumerate(self.axes)
        )
        return np.asarray(self.reason[near])


def coarse(grid: Grid, nodes: int = NODES) -> Grid:
    """The coarse grid on the same box."""
    x, y, z = (min(n, nodes) for n in grid.counts)
    return Grid(grid.low, grid.high, (x, y, z))


def critical_at(manipulator: Manipulator, points: Array) -> tuple[Array, Array]:
    """(B, legs) force, N, at which each leg buckles at points (B, 3), and (B, legs) why it cannot be found.

    inf: it does not buckle. NaN: the force cannot be found, for the reason (a number of `reasons_of`) beside it; that
    is 0 where the whole manipulator has no stiffness, so that nothing is known of its legs.
    """
    at = postures(manipulator, points)
    share = shares(manipulator, at, stiffness_at_rest(manipulator, at))
    good = np.flatnonzero(share.regular)
    force = np.full((len(points), len(manipulator.legs)), np.nan)
    reason = np.zeros_like(force)
    if good.size:
        found = critical_forces(manipulator, at.take(good), share.direction[good])
        force[good] = found.force
        said = reasons_of(manipulator)
        for number, leg in enumerate(manipulator.legs):
            sentences = [no_critical_load(leg.name, why) if why else "" for why in found.reason[:, number]]
            reason[good, number] = numbers_of(sentences, said)
    return force, reason


def critical_map(manipulator: Manipulator, nodes: Grid, force: Array, reason: Array) -> CriticalMap:
    """The map of forces and reasons (nodes, legs) at the nodes of a coarse grid.

    A node without a force takes that of the nearest with one, so that the others can be interpolated. A leg that has
    none at any node has a reason everywhere.
    """
    force, reason, points = force.copy(), reason.copy(), nodes.points(0, nodes.size)
    said = reasons_of(manipulator)
    for number, leg in enumerate(manipulator.legs):
        column = force[:, number]
        known = np.flatnonzero(~np.isnan(column))
        for k in np.flatnonzero(np.isnan(column)):
            near = known[np.argmin(np.sum((points[known] - points[k]) ** 2, axis=-1))] if known.size else None
            force[k, number] = np.inf if near is None else column[near]
        if not known.size:
            (unknown,) = numbers_of([no_critical_load(leg.name, NO_NODE)], said)
            reason[reason[:, number] == 0.0, number] = unknown
    axes = (nodes.axis(0), nodes.axis(1), nodes.axis(2))
    shape = (*nodes.counts, -1)
    return CriticalMap(axes, force.reshape(shape), reason.reshape(shape))


def mapped(manipulator: Manipulator, question: Question, critical: CriticalMap, points: Array) -> Array:
    """(B, columns) of the question at points (B, 3) mm."""
    at = postures(manipulator, points)
    stiffness = stiffness_at_rest(manipulator, at)
    share = shares(manipulator, at, stiffness)
    out = np.zeros((len(points), len(question.columns)))
    out[:, :3] = points
    out[:, 3] = np.where(share.regular, FOUND, np.where(at.reached, SINGULAR, UNREACHED))
    said = reasons_of(manipulator)
    out[:, REST.index("reason")] = numbers_of(
        np.where((stiffness.reason == "") & ~share.regular, MOVES, stiffness.reason), said
    )
    good = np.flatnonzero(share.regular)
    if not good.size:
        return out
    _stiffness_columns(out, good, stiffness.total[good])
    force, reason = critical.at(points[good])
    _critical_columns(out, good, force, reason, np.linalg.norm(share.force[good], axis=-1))
    more = len(REST)
    if question.wrench is not None:
        pull = pulls(stiffness.by_leg[good], share.direction[good], question.wrench)
        with np.errstate(divide="ignore"):
            out[good, more] = np.min(np.where(pull < 0.0, force / np.maximum(-pull, 0.0), np.inf), axis=-1)
        more += 1
    if question.wrench is not None or question.changed is not None:
        values, stable = loaded_columns(manipulator, question, at.take(good))
        out[good, more:] = values
        lost = good[~stable]
        out[lost, 3] = LOST
        out[lost, REST.index("reason")] = numbers_of([NO_EQUILIBRIUM] * len(lost), said)
    return out


def _stiffness_columns(out: Array, rows: np.ndarray, total: Array) -> None:
    """Fills in K_tran and K_rot: least, largest and mean over directions."""
    for name, block in (("K_tran", translational(total)), ("K_rot", rotational(total))):
        values = principal(block)
        out[rows, REST.index(f"{name}_min")] = values[:, 0]
        out[rows, REST.index(f"{name}_max")] = values[:, -1]
        out[rows, REST.index(f"{name}_mean")] = 3.0 / np.sum(1.0 / values, axis=-1)


def _critical_columns(out: Array, rows: np.ndarray, force: Array, reason: Array, share: Array) -> None:
    """Fills in the least force on the platform that makes a leg buckle, of those whose share (B, legs) is not zero."""
    with np.errstate(divide="ignore"):
        least = force / share
    none = np.isnan(least).any(-1)
    out[rows, REST.index("critical_N")] = np.min(least, axis=-1)
    out[rows, REST.index("leg")] = np.where(none, -1.0, np.argmin(least, axis=-1))
    first = np.argmax(reason > 0.0, axis=-1)
    out[rows, REST.index("reason")] = np.where(none, reason[np.arange(len(reason)), first], 0.0)


def pulls(by_leg: Array, direction: Array, wrench: Array) -> Array:
    """(B, legs) pull along each leg under a wrench (6,), from the stiffness (B, legs, 6, 6) of the legs."""
    total = np.sum(by_leg, axis=1)
    moved = np.linalg.solve(total, np.broadcast_to(wrench, (len(total), 6))[..., None])[..., 0]
    return np.asarray(np.einsum("bli,blij,bj->bl", direction, by_leg[:, :, :3], moved))


def chunk_of(
    manipulator: Manipulator,
    question: Question,
    critical: CriticalMap,
    grid: Grid,
    number: int,
    start: int,
    stop: int,
) -> tuple[int, Array]:
    """Number of a chunk and its rows (B, columns): what a worker computes. Workers import this module only, which
    is quick."""
    return number, mapped(manipulator, question, critical, grid.points(start, stop))


def nodes_of(manipulator: Manipulator, nodes: Grid, start: int, stop: int) -> tuple[int, Array]:
    """First number of some nodes of the coarse grid and (nodes, legs, 2) the legs' critical forces there, and why
    there is none."""
    return start, np.stack(critical_at(manipulator, nodes.points(start, stop)), axis=-1)
