"""What a sweep computes at a point of the workspace, vectorised over the points of a chunk."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from pipeline.manipulator.grid import Grid
from vjm.manipulator.legs import critical_forces, shares
from vjm.manipulator.measures import principal, rotational, translational
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest

Array = NDArray[np.float64]
COLUMNS = (
    "x_mm",
    "y_mm",
    "z_mm",
    "state",
    "K_tran_min",
    "K_tran_max",
    "K_rot_min",
    "K_rot_max",
    "critical_N",
    "leg",
)
"""Columns of a sweep. state: 0 found, 1 not reached, 2 no stiffness. critical_N: smallest force on the platform, of
any direction, that makes a leg buckle; leg: its number. All but the first four are zero where the state is not 0."""
FOUND, UNREACHED, SINGULAR = 0.0, 1.0, 2.0
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


def mapped(manipulator: Manipulator, critical: CriticalMap, points: Array) -> Array:
    """(B, columns) of `COLUMNS` at points (B, 3) mm."""
    at = postures(manipulator, points)
    stiffness = stiffness_at_rest(manipulator, at)
    share = shares(manipulator, at, stiffness)
    out = np.zeros((len(points), len(COLUMNS)))
    out[:, :3] = points
    out[:, 3] = np.where(share.regular, FOUND, np.where(at.reached, SINGULAR, UNREACHED))
    good = np.flatnonzero(share.regular)
    if not good.size:
        return out
    total = stiffness.total[good]
    for column, block in ((4, translational(total)), (6, rotational(total))):
        values = principal(block)
        out[good, column], out[good, column + 1] = values[:, 0], values[:, -1]
    with np.errstate(divide="ignore"):
        force = critical.at(points[good]) / np.linalg.norm(share.force[good], axis=-1)
    out[good, 9] = np.argmin(force, axis=-1)
    out[good, 8] = np.min(force, axis=-1)
    return out


def chunk_of(
    manipulator: Manipulator, critical: CriticalMap, grid: Grid, number: int, start: int, stop: int
) -> tuple[int, Array]:
    """Number of a chunk and its rows: what a worker computes. Workers import this module only, which is quick."""
    return number, mapped(manipulator, critical, grid.points(start, stop))


def nodes_of(manipulator: Manipulator, nodes: Grid, start: int, stop: int) -> tuple[int, Array]:
    """First number of some nodes of the coarse grid and the legs' critical forces there."""
    return start, critical_at(manipulator, nodes.points(start, stop))
