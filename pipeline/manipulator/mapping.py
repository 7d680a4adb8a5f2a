"""What a sweep computes at a point of the workspace, vectorised over the points of a chunk."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from pipeline.manipulator.grid import Grid
from pipeline.manipulator.loaded import loaded_columns
from pipeline.manipulator.question import FOUND, LOST, REST, SINGULAR, UNREACHED, Array, Question
from vjm.manipulator.legs import critical_forces, shares
from vjm.manipulator.measures import principal, rotational, translational
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest

NODES = 5
"""Nodes along each axis of the coarse grid on which the legs' critical forces are found; cubic between them."""


@dataclass(frozen=True, eq=False)
class CriticalMap:
    """Force, N, at which each leg buckles, on coarse nodes of the box: (nx, ny, nz, legs); inf: it does not."""

    axes: tuple[Array, Array, Array]
    force: Array

    def at(self, points: Array) -> Array:
        """(B, legs) at points (B, 3) mm of the box."""
        # A compliance is zero where nothing buckles, so that all of it can be interpolated.
        long = [k for k, axis in enumerate(self.axes) if len(axis) > 1]
        values = (1.0 / self.force).reshape(*(len(self.axes[k]) for k in long), -1)
        if not long:
            return np.broadcast_to(1.0 / values, (len(points), values.shape[-1]))
        method: Literal["cubic", "linear"] = "cubic" if all(len(self.axes[k]) > 3 for k in long) else "linear"
        found = RegularGridInterpolator([self.axes[k] for k in long], values, method)(points[:, long])
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / np.maximum(found, 0.0))


def coarse(grid: Grid, nodes: int = NODES) -> Grid:
    """The coarse grid on the same box."""
    x, y, z = (min(n, nodes) for n in grid.counts)
    return Grid(grid.low, grid.high, (x, y, z))


def critical_at(manipulator: Manipulator, points: Array) -> Array:
    """(B, legs) force, N, at which each leg buckles at points (B, 3); inf: it does not, nan: no stiffness there."""
    at = postures(manipulator, points)
    share = shares(manipulator, at, stiffness_at_rest(manipulator, at))
    good = np.flatnonzero(share.regular)
    out = np.full((len(points), len(manipulator.legs)), np.nan)
    if good.size:
        out[good] = critical_forces(manipulator, at.take(good), share.direction[good])
    return out


def critical_map(nodes: Grid, force: Array) -> CriticalMap:
    """The map of forces (nodes, legs) at the nodes of a coarse grid.

    A node without stiffness takes the value of the nearest with one; where there is none, nothing buckles.
    """
    force, points = force.copy(), nodes.points(0, nodes.size)
    known = np.flatnonzero(~np.isnan(force).any(-1))
    for k in np.flatnonzero(np.isnan(force).any(-1)):
        near = known[np.argmin(np.sum((points[known] - points[k]) ** 2, axis=-1))] if known.size else None
        force[k] = np.inf if near is None else force[near]
    axes = (nodes.axis(0), nodes.axis(1), nodes.axis(2))
    return CriticalMap(axes, force.reshape(*nodes.counts, -1))


def mapped(manipulator: Manipulator, question: Question, critical: CriticalMap, points: Array) -> Array:
    """(B, columns) of the question at points (B, 3) mm."""
    at = postures(manipulator, points)
    stiffness = stiffness_at_rest(manipulator, at)
    share = shares(manipulator, at, stiffness)
    out = np.zeros((len(points), len(question.columns)))
    out[:, :3] = points
    out[:, 3] = np.where(share.regular, FOUND, np.where(at.reached, SINGULAR, UNREACHED))
    good = np.flatnonzero(share.regular)
    if not good.size:
        return out
    total = stiffness.total[good]
    for column, block in ((4, translational(total)), (6, rotational(total))):
        values = principal(block)
        out[good, column], out[good, column + 1] = values[:, 0], values[:, -1]
    force = critical.at(points[good])
    with np.errstate(divide="ignore"):
        least = force / np.linalg.norm(share.force[good], axis=-1)
    out[good, 9] = np.argmin(least, axis=-1)
    out[good, 8] = np.min(least, axis=-1)
    more = len(REST)
    if question.wrench is not None:
        pull = pulls(stiffness.by_leg[good], share.direction[good], question.wrench)
        with np.errstate(divide="ignore"):
            out[good, more] = np.min(np.where(pull < 0.0, force / np.maximum(-pull, 0.0), np.inf), axis=-1)
        more += 1
    if question.wrench is not None or question.changed is not None:
        values, stable = loaded_columns(manipulator, question, at.take(good))
        out[good, more:] = values
        out[good[~stable], 3] = LOST
    return out


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
    """Number of a chunk and its rows: what a worker computes. Workers import this module only, which is quick."""
    return number, mapped(manipulator, question, critical, grid.points(start, stop))


def nodes_of(manipulator: Manipulator, nodes: Grid, start: int, stop: int) -> tuple[int, Array]:
    """First number of some nodes of the coarse grid and the legs' critical forces there."""
    return start, critical_at(manipulator, nodes.points(start, stop))
