"""Static equilibrium of a mechanism (Eqs. 5 and 6), for many poses at once.

Each platform coordinate is either held at a value or loaded by a given force; a fully prescribed pose, as in
the paper, holds all six. Loads are conjugate to the pose (p, rotation vector), see `vjm.frames`.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from vjm import lagrangian
from vjm.frames import POSE_NAMES, Array, moment
from vjm.increments import solve
from vjm.laws import Response
from vjm.mechanism import Mechanism, initial_memory
from vjm.newton import CONVERGED, Iterate, Step, dense, newton
from vjm.problem import Held, Problem, held_mask

TOLERANCE = 1e-12
ITERATIONS = 50


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """Equilibrium states of a mechanism, batched over leading axes.

    unknowns: (..., N) in the order of `vjm.lagrangian`. residual: (...) largest row of Eq. 5 before the last
    step, translations over the mechanism's length, forces over its largest spring x length.
    iterations: (...). converged: (...) of bool. reason: (...) of strings. Where `converged` is False the
    state is none of the equilibrium asked for.
    unstable: (...) number of directions in which the equilibrium is unstable while the held coordinates stay:
    0 stable, positive past a critical load, -1 not known.
    held: (..., 6) mask of the held platform coordinates. memory: (..., M) of the laws before this step.
    """

    mechanism: Mechanism
    unknowns: Array
    iterations: np.ndarray
    residual: Array
    converged: np.ndarray
    reason: np.ndarray
    unstable: np.ndarray
    held: np.ndarray
    memory: Array

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
        return np.sum([answer.energy for answer in self._responses()], axis=0)

    @property
    def next_memory(self) -> Array:
        """(..., M) what the laws remember after this step."""
        return np.concatenate([answer.memory for answer in self._responses()], axis=-1)

    def _responses(self) -> list[Response]:
        place = lagrangian.layout(self.mechanism)
        parts = zip(self.mechanism.chains, place.coordinates, place.memories, strict=True)
        return [
            chain.respond(self.unknowns[..., x] - chain.rest[chain.moving], self.memory[..., past])
            for chain, x, past in parts
        ]

    def member(self, index: int | tuple[int, ...] | slice | np.ndarray) -> Equilibrium:
        """One state of the batch, or several."""
        return Equilibrium(self.mechanism, *(np.asarray(part[index]) for part in _arrays(self)))

    def reshaped(self, *batch: int) -> Equilibrium:
        """The same states with other batch axes."""
        axes = self.converged.ndim
        parts = (part.reshape((*batch, *part.shape[axes:])) for part in _arrays(self))
        return Equilibrium(self.mechanism, *parts)


def _arrays(state: Equilibrium) -> list[np.ndarray]:
    return [getattr(state, field.name) for field in fields(state)[1:]]


def unloaded(mechanism: Mechanism) -> Equilibrium:
    """The state of rest, as the start of a history."""
    return Equilibrium(
        mechanism,
        lagrangian.at_rest(mechanism),
        np.array(0),
        np.array(0.0),
        np.array(True),
        np.array(CONVERGED, dtype=object),
        np.array(-1),
        np.ones(6, dtype=bool),
        initial_memory(mechanism),
    )


def equilibrium(
    mechanism: Mechanism,
    targets: ArrayLike,
    held: Held = POSE_NAMES,
    start: Equilibrium | None = None,
    tolerance: float = TOLERANCE,
    limit: int = ITERATIONS,
    follow: bool = False,
) -> Equilibrium:
    """Newton's method on the stationarity of the Lagrange function, Hessians included.

    targets: (..., 6); a held coordinate's entry is its pose value (mm, rad), a free one's its load (N, N·mm),
    conjugate to the rotation vector. held: names for all load cases, or a mask (..., 6); default all six.
    start: state to begin from, broadcast over the batch; default the unloaded mechanism. Laws with memory
    continue from it.
    follow: stay on the branch of the start even where it is unstable.
    Quadratic near a solution and able to stay on an unstable branch, which Eq. 6 (`picard`) is not. Load cases
    that fail at once, or end unstable, are approached in increments. What is unstable all the same, past a
    critical load, is returned as such: see `Equilibrium.unstable` and `vjm.stability.verified`.
    ValueError for targets whose last axis is not 6 or that are not finite.
    """
    problem, first, batch = _posed(mechanism, targets, held, start)
    return record(problem, solve(problem, first, tolerance, limit, follow), batch)


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
    critical load. `equilibrium` is the safe choice there; both share residual and record. Laws beside the
    linear springs enter with their tangent.
    """
    problem, first, batch = _posed(mechanism, poses, POSE_NAMES, start)
    place = problem.place
    weight = place.scale / place.energy
    parts = list(zip(mechanism.chains, place.coordinates, place.memories, strict=True))

    def without_hessians(unknowns: Array, members: np.ndarray) -> tuple[Array, Step]:
        rows, matrix = problem.whole(unknowns, members)
        for chain, x, past in parts:
            strain = unknowns[..., x] - chain.rest[chain.moving]
            matrix[..., x, x] = weight[x, None] * chain.respond(strain, problem.memory[members, past]).tangent
        return rows, dense(rows, matrix, place.scale)

    return record(problem, newton(without_hessians, first, place.scale, tolerance, limit), batch)


def load_path(
    mechanism: Mechanism,
    targets: ArrayLike,
    held: Held = POSE_NAMES,
    start: Equilibrium | None = None,
    follow: bool = False,
) -> Equilibrium:
    """Equilibria along a history: targets (steps, ..., 6) as in `equilibrium`, each started at the last.

    held: names, a mask for all steps (..., 6), or one for each step (steps, ..., 6).
    """
    targets = _checked(targets)
    masks = held_mask(held)
    masks = np.broadcast_to(masks, np.broadcast_shapes(masks.shape, targets.shape))
    states = []
    for target, mask in zip(targets, masks, strict=True):
        start = equilibrium(mechanism, target, mask, start, follow=follow)
        states.append(start)
    return stack(states)


def stack(states: Collection[Equilibrium]) -> Equilibrium:
    """States of one mechanism with equal batch shape, stacked along a new first axis."""
    first = next(iter(states))
    parts = zip(*(_arrays(state) for state in states), strict=True)
    return Equilibrium(first.mechanism, *(np.stack(part) for part in parts))


def record(problem: Problem, end: Iterate, batch: tuple[int, ...]) -> Equilibrium:
    """The end of an iteration over B members as an `Equilibrium` of batch shape `batch`."""
    return Equilibrium(
        problem.mechanism,
        end.unknowns.reshape(*batch, -1),
        end.iterations.reshape(batch),
        end.residual.reshape(batch),
        (end.reason == CONVERGED).reshape(batch),
        end.reason.reshape(batch),
        end.unstable.reshape(batch),
        problem.held.reshape(*batch, 6),
        problem.memory.reshape(*batch, problem.memory.shape[-1]),
    )


def _checked(targets: ArrayLike) -> Array:
    targets = np.asarray(targets, dtype=float)
    if targets.ndim == 0 or targets.shape[-1] != 6:
        raise ValueError(f"targets must have six numbers on their last axis, got shape {targets.shape}")
    if not np.all(np.isfinite(targets)):
        raise ValueError("targets must be finite numbers")
    return targets


def _posed(
    mechanism: Mechanism, targets: ArrayLike, held: Held, start: Equilibrium | None
) -> tuple[Problem, Array, tuple[int, ...]]:
    """The problem with its batch axes flattened, the unknowns to begin with, and the batch shape."""
    targets, mask = _checked(targets), held_mask(held)
    batch = np.broadcast_shapes(targets.shape, mask.shape)[:-1]
    unknowns = lagrangian.at_rest(mechanism) if start is None else start.unknowns
    memory = initial_memory(mechanism) if start is None else start.next_memory

    def flat(part: np.ndarray) -> np.ndarray:
        return np.broadcast_to(part, (*batch, part.shape[-1])).reshape(int(np.prod(batch)), part.shape[-1])

    return Problem(mechanism, flat(targets), flat(mask), flat(memory)), flat(unknowns).copy(), batch
