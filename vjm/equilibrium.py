"""Static equilibrium of a mechanism (Eqs. 5 and 6), for many poses at once.

Each platform coordinate is either held at a value or loaded by a given force; a fully prescribed pose, as in
the paper, holds all six. Loads are conjugate to the pose (p, rotation vector), see `vjm.frames`.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from vjm import lagrangian
from vjm.frames import POSE_NAMES, Array, moment
from vjm.mechanism import Mechanism, energy
from vjm.newton import CONVERGED, Iterate, System, newton

TOLERANCE = 1e-12
ITERATIONS = 50


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """Equilibrium states of a mechanism, batched over leading axes.

    unknowns: (..., N) in the order of `vjm.lagrangian`. residual: (...) largest row of Eq. 5 before the last
    step, translations over the mechanism's length, forces over its largest spring x length.
    iterations: (...). converged: (...) of bool. reason: (...) of strings. Where `converged` is False the
    state is the last finite iterate and no equilibrium.
    """

    mechanism: Mechanism
    unknowns: Array
    iterations: np.ndarray
    residual: Array
    converged: np.ndarray
    reason: np.ndarray

    @property
    def pose(self) -> Array:
        """(..., 6) platform pose t."""
        return self.unknowns[..., lagrangian.layout(self.mechanism).platform]

    @property
    def coordinates(self) -> tuple[Array, ...]:
        """All coordinates (..., n_i) of each chain."""
        place = lagrangian.layout(self.mechanism)
        pairs = zip(self.mechanism.chains, place.coordinates, strict=True)
        return tuple(lagrangian.chain_coordinates(chain, self.unknowns[..., x]) for chain, x in pairs)

    @property
    def q(self) -> tuple[Array, ...]:
        """Passive coordinates of each chain."""
        pairs = zip(self.mechanism.chains, self.coordinates, strict=True)
        return tuple(x[..., chain.passive] for chain, x in pairs)

    @property
    def theta(self) -> tuple[Array, ...]:
        """Virtual coordinates of each chain."""
        pairs = zip(self.mechanism.chains, self.coordinates, strict=True)
        return tuple(x[..., chain.virtual] for chain, x in pairs)

    @property
    def multipliers(self) -> Array:
        """lambda (..., chains, 6): the load each chain takes, conjugate to (p, rotation vector)."""
        places = lagrangian.layout(self.mechanism).multipliers
        return np.stack([self.unknowns[..., place] for place in places], axis=-2)

    @property
    def load(self) -> Array:
        """Total load (..., 6), the sum of the multipliers, conjugate to (p, rotation vector)."""
        return np.sum(self.multipliers, axis=-2)

    @property
    def wrench(self) -> Array:
        """Total wrench F (..., 6) on the platform at its point, base frame; moments are true moments."""
        load = self.load
        return np.concatenate([load[..., :3], moment(self.pose[..., 3:], load[..., 3:])], axis=-1)

    @property
    def energy(self) -> Array:
        """Elastic energy (...), N·mm (Eq. 3)."""
        return energy(self.mechanism, self.coordinates)

    def member(self, index: int | tuple[int, ...]) -> Equilibrium:
        """One state of the batch."""
        parts = (self.unknowns, self.iterations, self.residual, self.converged, self.reason)
        return Equilibrium(self.mechanism, *(np.asarray(part[index]) for part in parts))


def unloaded(mechanism: Mechanism) -> Equilibrium:
    """The state of rest, as the start of a history."""
    zero = np.array(0)
    return Equilibrium(
        mechanism,
        lagrangian.at_rest(mechanism),
        zero,
        np.array(0.0),
        np.array(True),
        np.array(CONVERGED, dtype=object),
    )


def held_mask(held: Collection[str]) -> np.ndarray:
    """(6,) mask of the platform coordinates named; ValueError for a name that is none of x y z rx ry rz."""
    unknown = sorted(set(held) - set(POSE_NAMES))
    if unknown:
        raise ValueError(f"held coordinates must be among {POSE_NAMES}, got {unknown}")
    return np.array([name in held for name in POSE_NAMES])


def equilibrium(
    mechanism: Mechanism,
    targets: ArrayLike,
    held: Collection[str] = POSE_NAMES,
    start: Equilibrium | None = None,
    tolerance: float = TOLERANCE,
    limit: int = ITERATIONS,
) -> Equilibrium:
    """Newton's method on the stationarity of the Lagrange function, Hessians included.

    targets: (..., 6); a held coordinate's entry is its pose value (mm, rad), a free one's its load (N, N·mm),
    conjugate to the rotation vector. The default holds all six.
    start: state to begin from, broadcast over the batch; default the unloaded mechanism.
    Quadratic near a solution and able to stay on an unstable branch, which Eq. 6 (`picard`) is not.
    ValueError for targets whose last axis is not 6 or that are not finite.
    """
    targets = _checked(targets)
    place = lagrangian.layout(mechanism)
    system = controlled(mechanism, targets.reshape(-1, 6), held_mask(held))
    first = _start_unknowns(mechanism, start, targets.shape[:-1])
    end = newton(system, first, place.scale, tolerance, limit)
    return record(mechanism, end, targets.shape[:-1])


def controlled(mechanism: Mechanism, targets: Array, mask: np.ndarray) -> System:
    """Newton system of Eq. 5 with the platform rows of held coordinates replaced by t_k = target.

    targets: (B, 6), mask: (6,) of the held ones. Rows are dimensionless as `Equilibrium.residual` says.
    """
    place = lagrangian.layout(mechanism)
    pinned = np.arange(place.size)[place.platform][mask]
    weight = place.scale / place.energy

    def system(unknowns: Array, members: np.ndarray) -> tuple[Array, Array]:
        value = targets[members]
        rows, matrix = lagrangian.gradient_and_hessian(mechanism, unknowns, np.where(mask, 0.0, value))
        rows, matrix = rows * weight, matrix * weight[:, None]
        rows[:, pinned] = (unknowns[:, pinned] - value[:, mask]) / place.scale[pinned]
        matrix[:, pinned] = np.eye(place.size)[pinned] / place.scale[pinned][:, None]
        return rows, matrix

    return system


def picard(
    mechanism: Mechanism,
    poses: ArrayLike,
    start: Equilibrium | None = None,
    tolerance: float = TOLERANCE,
    limit: int = 500,
) -> Equilibrium:
    """The paper's own iteration, Eq. 6 with its block matrix inverted (as printed it is not, and fails).

    poses: (..., 6). Each step linearises t = g but drops the Hessians of g, so this is a Picard iteration: it
    converges linearly, the slower the larger the load against the springs, and may diverge near or beyond a
    critical load. `equilibrium` is the safe choice there; both share residual and record.
    """
    poses = _checked(poses)
    place = lagrangian.layout(mechanism)
    weight = place.scale / place.energy
    system = controlled(mechanism, poses.reshape(-1, 6), held_mask(POSE_NAMES))

    def without_hessians(unknowns: Array, members: np.ndarray) -> tuple[Array, Array]:
        rows, matrix = system(unknowns, members)
        for chain, x in zip(mechanism.chains, place.coordinates, strict=True):
            matrix[..., x, x] = weight[x, None] * chain.full_stiffness
        return rows, matrix

    first = _start_unknowns(mechanism, start, poses.shape[:-1])
    end = newton(without_hessians, first, place.scale, tolerance, limit)
    return record(mechanism, end, poses.shape[:-1])


def load_path(
    mechanism: Mechanism,
    targets: ArrayLike,
    held: Collection[str] = POSE_NAMES,
    start: Equilibrium | None = None,
) -> Equilibrium:
    """Equilibria along a history: targets (steps, ..., 6) as in `equilibrium`, each started at the last."""
    targets = _checked(targets)
    states = []
    for target in targets:
        start = equilibrium(mechanism, target, held, start)
        states.append(start)
    return stack(states)


def stack(states: Collection[Equilibrium]) -> Equilibrium:
    """States of one mechanism with equal batch shape, stacked along a new first axis."""
    first = next(iter(states))
    names = ("unknowns", "iterations", "residual", "converged", "reason")
    return Equilibrium(first.mechanism, *(np.stack([getattr(s, name) for s in states]) for name in names))


def _checked(targets: ArrayLike) -> Array:
    targets = np.asarray(targets, dtype=float)
    if targets.ndim == 0 or targets.shape[-1] != 6:
        raise ValueError(f"targets must have six numbers on their last axis, got shape {targets.shape}")
    if not np.all(np.isfinite(targets)):
        raise ValueError("targets must be finite numbers")
    return targets


def _start_unknowns(mechanism: Mechanism, start: Equilibrium | None, batch: tuple[int, ...]) -> Array:
    unknowns = lagrangian.at_rest(mechanism) if start is None else start.unknowns
    full = np.broadcast_to(unknowns, (*batch, unknowns.shape[-1]))
    return full.reshape(-1, unknowns.shape[-1]).copy()


def record(mechanism: Mechanism, end: Iterate, batch: tuple[int, ...]) -> Equilibrium:
    """The end of an iteration over B members as an `Equilibrium` of batch shape `batch`."""
    return Equilibrium(
        mechanism,
        end.unknowns.reshape(*batch, -1),
        end.iterations.reshape(batch),
        end.residual.reshape(batch),
        (end.reason == CONVERGED).reshape(batch),
        end.reason.reshape(batch),
    )
