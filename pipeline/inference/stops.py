"""The sides of the stops of plays on which rows were linearised: how far they reach, and what fits best there.

A row linearised with a bar at its stop is linear only where the stop is pressed, and one inside its play only as far as
the stops. Each side is a set of bounds that are linear in the inputs, and the least of a row's sum of squares there a
quadratic problem. Rows that are within their noise of a stop, as in tests without axial load, take up noise by the
choice of a side.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from pipeline.inference.load_cases import LOST
from pipeline.inference.predicted import Prediction
from pipeline.inference.rounding import TINY
from pipeline.inference.settings import STOPS
from vjm.effects.base import Effect

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Bounds:
    """How far the sides reach on which rows were linearised, K plays.

    Where slopes (R, 3 K, 7) · moved <= room (R, 3 K), moved (R, 7) the inputs in their sigmas from where a row was
    linearised, it is on the same side. First the K stops that are pressed, then both ends of each play; room is
    infinite where there is none.
    """

    slopes: Array
    room: Array

    @classmethod
    def of(cls, prediction: Prediction, sigma: Array) -> Bounds:
        """sigma: (R, 7) of the inputs."""
        force, pressing = prediction.stops[..., 0], prediction.stops[..., 1:] * sigma[:, None, :]
        strain, half = prediction.slides[..., 0], prediction.slides[..., 1]
        sliding = prediction.slides[..., 2:] * sigma[:, None, :]
        kept = ~prediction.lost[:, None]
        pressed = (force != 0.0) & np.isfinite(force) & kept
        inside = np.isfinite(half) & (np.abs(strain) < half) & ~pressed & kept
        held = np.where(pressed, np.sign(force), 0.0)[..., None] * -pressing
        ends = [np.where(inside, half - way * strain, np.inf) for way in (1.0, -1.0)]
        room = np.concatenate([np.where(pressed, np.abs(force), np.inf), *ends], axis=1)
        return cls(np.concatenate([held, sliding, -sliding], axis=1), room)

    @property
    def none(self) -> bool:
        """Whether no row has a stop."""
        return not np.isfinite(self.room).any()

    def beyond(self, number: int) -> tuple[Array, Array]:
        """(R, 7) the nearest inputs, in sigmas from where a row was linearised, just beyond one of the bounds, and how
        far (R,) they are; infinite where there is none."""
        slope, room = self.slopes[:, number], self.room[:, number]
        size = np.linalg.norm(slope, axis=1)
        far = np.divide(room, size, out=np.full_like(room, np.inf), where=(size > 0.0) & np.isfinite(room))
        there = np.where(np.isfinite(far), far + STOPS.touch, 0.0)
        unit = np.divide(slope, size[:, None], out=np.zeros_like(slope), where=size[:, None] > 0.0)
        return there[:, None] * unit, far


@dataclass(frozen=True, eq=False)
class Sides:
    """What fits rows best on the sides of the stops on which they were linearised.

    charge: (R,) chi-square that it costs to keep the inputs there. undecided: (R,) rows that may as well lie on
    another side. shift: (R, 7) inputs that fit best there. across: (R, 7) inputs just beyond the stop that holds them.
    """

    charge: Array
    undecided: Mask
    shift: Array
    across: Array


def sided(effect: Effect) -> bool:
    """Whether rows choose the side of a kink by themselves; along a history they do not."""
    return not effect.smooth and not effect.history


def on_their_sides(prediction: Prediction, shift: Array, sigma: Array, gain: Array) -> Sides:
    """Rows kept on their sides.

    shift: (R, 7) that fits best along the line of each row, wherever that leads. sigma: (R, 7) of the inputs. gain:
    (R, C, 7) whitened derivatives of the readings. Source of the method: C. L. Lawson, R. J. Hanson, Solving Least
    Squares Problems, SIAM 1995, chapter 23.
    """
    bounds, rows = Bounds.of(prediction, sigma), len(shift)
    if bounds.none:
        return Sides(np.zeros(rows), _undecided(prediction, np.full((rows, 1), np.inf)), shift, shift)
    # The whitened derivatives by the whitened inputs, and the covariance of these once the row is read.
    said = gain * sigma[:, None, :]
    covariance = np.eye(sigma.shape[1]) - np.einsum("rci,rcj->rij", said, said)
    ways = np.einsum("rij,rkj->rki", covariance, bounds.slopes)
    std = np.sqrt(np.maximum(np.einsum("rki,rki->rk", bounds.slopes, ways), 0.0))
    best = np.divide(shift - prediction.shift, sigma, out=np.zeros_like(shift), where=sigma > 0.0)
    over = np.einsum("rkj,rj->rk", bounds.slopes, best) - bounds.room
    there, force = _constrained(bounds, covariance, std, best)
    charge = np.clip(np.einsum("rk,rkj,rj->r", force, bounds.slopes, best - there), 0.0, LOST**2)
    # The stop that holds most: across it is the side that a row would rather be on.
    most = np.argmax(force * std, axis=1)[:, None]
    way = np.take_along_axis(ways, most[..., None], axis=1)[:, 0]
    size = np.maximum(np.take_along_axis(std, most, axis=1), TINY)
    across = there + np.where(charge[:, None] > 0.0, 2.0 * STOPS.touch * way / size, 0.0)
    far = np.divide(np.abs(over), std, out=np.full_like(over, np.inf), where=(std > 0.0) & np.isfinite(over))
    back, beyond = (prediction.shift + sigma * each for each in (there, across))
    return Sides(charge, _undecided(prediction, far[:, : prediction.stops.shape[1]]), back, beyond)


def _undecided(prediction: Prediction, far: Array) -> Mask:
    """(R,) rows with a play inside which they are, or with a stop that is pressed by less than `STOPS.sure` standard
    deviations (R, K)."""
    force = prediction.stops[..., 0]
    near = (force == 0.0) | (far <= STOPS.sure)
    return np.asarray(np.any(near & np.isfinite(force) & ~prediction.lost[:, None], axis=1))


def _constrained(bounds: Bounds, covariance: Array, std: Array, best: Array) -> tuple[Array, Array]:
    """The best inputs (R, 7) within bounds, and the multipliers (R, 3 K) of these.

    In inputs of unit covariance that is the point of least distance, one problem of non-negative least squares a row.
    """
    there, force = best.copy(), np.zeros_like(bounds.room)
    room = bounds.room - STOPS.touch * std
    over = np.einsum("rkj,rj->rk", bounds.slopes, best) - room
    for row in np.flatnonzero(np.any((over > 0.0) & (std > 0.0), axis=1)):
        held = np.flatnonzero(np.isfinite(over[row]) & (std[row] > 0.0))
        values, axes = np.linalg.eigh(covariance[row])
        root = axes * np.sqrt(np.maximum(values, 0.0))
        scaled = bounds.slopes[row, held] @ root / std[row, held, None]
        matrix = np.vstack([-scaled.T, over[row, held] / std[row, held]])
        found, _ = nnls(matrix, np.append(np.zeros(root.shape[1]), 1.0))
        left = 1.0 - float(matrix[-1] @ found)
        # Nothing left: no inputs belong to this side, and the row is charged with all that it may be.
        force[row, held] = found / max(left, STOPS.no_room) / std[row, held]
        there[row] = best[row] - root @ (scaled.T @ found) / max(left, STOPS.no_room)
    return there, force
