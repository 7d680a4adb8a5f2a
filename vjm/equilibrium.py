"""Static equilibrium of a mechanism (Eqs. 5 and 6), for many poses at once.

Each platform coordinate is either held at a value or loaded by a given force; a fully prescribed pose, as in
the paper, holds all six. Loads are conjugate to the pose (p, rotation vector), see `vjm.frames`.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from vjm import lagrangian
from vjm.frames import POSE_NAMES, Array, moment
from vjm.increments import Start, directly, solve
from vjm.laws import Response
from vjm.mechanism import ElasticChain, Mechanism, initial_memory
from vjm.newton import CONVERGED, Iterate
from vjm.problem import Held, Problem, channel_numbers
from vjm.readings import Readings

Drives = Mapping[str, ArrayLike]
"""Inputs of a mechanism by name, each broadcast over the batch; see `vjm.mechanism.Drive`."""

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
    channels: (..., 6) reading that each platform coordinate's control prescribed (`vjm.sensors`).
    memory: (..., M) of the laws before this step. drives: (..., D) departures of the inputs from their defaults.
    """

    mechanism: Mechanism
    unknowns: Array
    iterations: np.ndarray
    residual: Array
    converged: np.ndarray
    reason: np.ndarray
    unstable: np.ndarray
    channels: np.ndarray
    memory: Array
    drives: Array

    @property
    def held(self) -> np.ndarray:
        """(..., 6) mask of the platform coordinates that were held, by their own reading or by a gauge."""
        return (self.channels < 6) | (self.channels >= 12)

    @property
    def seen(self) -> Readings:
        """What the mechanism's sensors and gauges read there; not kept, as its derivatives are large."""
        return Readings(self.mechanism, self.unknowns, self.drives)

    @cached_property
    def readings(self) -> Array:
        """(..., 12 + G) pose, load and gauges as the mechanism's sensors read them; not to be written to."""
        values = self.seen.values
        values.flags.writeable = False
        return values

    @property
    def pose(self) -> Array:
        """(..., 6) platform pose t."""
        return self.unknowns[..., lagrangian.layout(self.mechanism).platform]

    @property
    def coordinates(self) -> tuple[Array, ...]:
        """All coordinates (..., n_i) of each chain."""
        place = lagrangian.layout(self.mechanism)
        rest = lagrangian.rest(self.mechanism, self.drives)
        parts = zip(self.mechanism.chains, place.coordinates, rest, strict=True)
        return tuple(lagrangian.chain_coordinates(chain, self.unknowns[..., x], r) for chain, x, r in parts)

    @property
    def strains(self) -> tuple[tuple[ElasticChain, Array, slice], ...]:
        """Each chain with its coordinates (..., n) from rest and the place of its moving ones."""
        place = lagrangian.layout(self.mechanism)
        rest = lagrangian.rest(self.mechanism, self.drives)
        parts = zip(self.mechanism.chains, self.coordinates, rest, place.coordinates, strict=True)
        return tuple((chain, x - start, at) for chain, x, start, at in parts)

    @property
    def unloaded_coordinates(self) -> tuple[Array, ...]:
        """All coordinates (..., n_i) of each chain when sensors were zeroed."""
        return lagrangian.rest(self.mechanism, self.drives, unloaded=True)

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
        if not self.memory.shape[-1]:
            return self.memory
        return np.concatenate([chain.remember(*strain) for chain, strain in self._strains()], axis=-1)

    def _responses(self) -> list[Response]:
        linear = lagrangian.linear_stiffness(self.mechanism, self.drives)
        parts = zip(self._strains(), linear, strict=True)
        return [chain.respond(*strain, stiffness) for (chain, strain), stiffness in parts]

    def _strains(self) -> list[tuple[ElasticChain, tuple[Array, Array]]]:
        """Each chain with its strain (..., m) and the memory (..., M) of its laws."""
        place = lagrangian.layout(self.mechanism)
        rest = lagrangian.rest(self.mechanism, self.drives)
        parts = zip(self.mechanism.chains, rest, place.coordinates, place.memories, strict=True)
        return [
            (chain, (self.unknowns[..., x] - r[..., chain.moving], self.memory[..., past]))
            for chain, r, x, past in parts
        ]

    @property
    def arrays(self) -> list[np.ndarray]:
        """All but the mechanism, in the order of the fields."""
        return [getattr(self, field.name) for field in fields(self)[1:]]

    def member(self, index: int | tuple[int | slice | np.ndarray, ...] | slice | np.ndarray) -> Equilibrium:
        """One state of the batch, or several."""
        return Equilibrium(self.mechanism, *(np.asarray(part[index]) for part in self.arrays))

    def with_members(
        self, index: np.ndarray | tuple[int | np.ndarray, ...], other: Equilibrium
    ) -> Equilibrium:
        """The same states with those of another one at these numbers, or this mask, of the batch."""
        parts = [part.copy() for part in self.arrays]
        for part, new in zip(parts, other.arrays, strict=True):
            part[index] = new
        return Equilibrium(self.mechanism, *parts)

    def reshaped(self, *batch: int) -> Equilibrium:
        """The same states with other batch axes."""
        axes = self.converged.ndim
        parts = (part.reshape((*batch, *part.shape[axes:])) for part in self.arrays)
        return Equilibrium(self.mechanism, *parts)


def unloaded(mechanism: Mechanism, drives: Drives | None = None) -> Equilibrium:
    """The state of rest, as the start of a history, at inputs broadcast to one batch."""
    inputs = drive_values(mechanism, drives)
    batch = inputs.shape[:-1]
    memory = initial_memory(mechanism)
    return Equilibrium(
        mechanism,
        lagrangian.at_rest(mechanism, inputs),
        np.zeros(batch, dtype=int),
        np.zeros(batch),
        np.ones(batch, dtype=bool),
        np.full(batch, CONVERGED, dtype=object),
        np.full(batch, -1),
        np.broadcast_to(np.arange(6), (*batch, 6)),
        np.broadcast_to(memory, (*batch, memory.size)),
        inputs,
    )


def drive_values(mechanism: Mechanism, drives: Drives | None) -> Array:
    """Departures (..., D) of the inputs from their defaults, in the order of the layout.

    ValueError for the name of an input that the mechanism does not have.
    """
    place = lagrangian.layout(mechanism)
    given = {name: np.asarray(value, dtype=float) for name, value in (drives or {}).items()}
    if unknown := sorted(set(given) - set(place.drives)):
        raise ValueError(f"inputs of this mechanism are {place.drives}, got {unknown}")
    batch = np.broadcast_shapes(*(value.shape for value in given.values()))
    out = np.zeros((*batch, len(place.drives)))
    for k, name in enumerate(place.drives):
        if name in given:
            out[..., k] = given[name] - place.defaults[k]
    return out


def equilibrium(
    mechanism: Mechanism,
    targets: ArrayLike,
    held: Held = POSE_NAMES,
    start: Equilibrium | None = None,
    tolerance: float = TOLERANCE,
    limit: int = ITERATIONS,
    follow: bool = False,
    drives: Drives | None = None,
    memory: Array | None = None,
) -> Equilibrium:
    """Newton's method on the stationarity of the Lagrange function, Hessians included.

    targets: (..., 6); a held coordinate's entry is its pose value (mm, rad), a free one's its load (N, N·mm),
    conjugate to the rotation vector unless the mechanism's sensors read otherwise, a gauge's its reading.
    held: names for all load cases, a mask (..., 6), or channel numbers (..., 6); default all six names.
    drives: inputs by name, (...) each, default as built. memory: (..., M) of the laws before the step, default
    what the start leaves.
    start: state to begin from, broadcast over the batch; default the unloaded mechanism. Laws with memory
    continue from it. Where it is no stable equilibrium itself, a short step on the way from it is tried and no more.
    follow: stay on the branch of the start even where it is unstable.
    Quadratic near a solution and able to stay on an unstable branch, which Eq. 6 is not. Load cases
    that fail at once, or end unstable, are approached in increments. What is unstable all the same, past a
    critical load, is returned as such: see `Equilibrium.unstable` and `vjm.stability.verified`.
    ValueError for targets whose last axis is not 6 or that are not finite.
    """
    problem, first, before, batch = posed(mechanism, targets, held, start, drives, memory)
    astray = np.zeros(batch, dtype=bool)
    if start is not None:
        astray |= ~start.converged | ((start.unstable > 0) & (not follow))
    return record(
        problem, solve(problem, Start(first, before, astray.ravel()), tolerance, limit, follow), batch
    )


def nearby(
    mechanism: Mechanism,
    targets: ArrayLike,
    held: Held,
    start: Equilibrium,
    drives: Drives,
    memory: Array,
) -> Equilibrium:
    """As `equilibrium`, by Newton's method alone: what wants a more careful approach has not converged. targets
    (..., 6); memory (..., M) before the step."""
    problem, first, _, batch = posed(mechanism, targets, held, start, drives, memory)
    return record(problem, directly(problem, first, TOLERANCE), batch)


def stack(states: Collection[Equilibrium]) -> Equilibrium:
    """States of one mechanism with equal batch shape, stacked along a new first axis."""
    first = next(iter(states))
    parts = zip(*(state.arrays for state in states), strict=True)
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
        problem.channels.reshape(*batch, 6),
        problem.memory.reshape(*batch, problem.memory.shape[-1]),
        problem.drives.reshape(*batch, problem.drives.shape[-1]),
    )


def _checked(targets: ArrayLike) -> Array:
    targets = np.asarray(targets, dtype=float)
    if targets.ndim == 0 or targets.shape[-1] != 6:
        raise ValueError(f"targets must have six numbers on their last axis, got shape {targets.shape}")
    if not np.all(np.isfinite(targets)):
        raise ValueError("targets must be finite numbers")
    return targets


def posed(
    mechanism: Mechanism,
    targets: ArrayLike,
    held: Held,
    start: Equilibrium | None,
    drives: Drives | None,
    memory: Array | None,
) -> tuple[Problem, Array, Array, tuple[int, ...]]:
    """The problem with flat batch axes (B,), unknowns (B, N) and inputs (B, D) to begin with, and the batch shape.

    targets: (..., 6). memory: (..., M) of the laws before the step.
    """
    targets, numbers = _checked(targets), channel_numbers(held, len(mechanism.gauges))
    inputs = drive_values(mechanism, drives)
    shapes = [targets.shape[:-1], numbers.shape[:-1], inputs.shape[:-1]]
    batch = np.broadcast_shapes(*shapes)
    if start is None:
        unknowns, past, before = lagrangian.at_rest(mechanism, inputs), initial_memory(mechanism), inputs
    else:
        unknowns, before = start.unknowns, start.drives
        past = start.next_memory if memory is None else memory

    def flat(part: np.ndarray) -> np.ndarray:
        return np.broadcast_to(part, (*batch, part.shape[-1])).reshape(int(np.prod(batch)), part.shape[-1])

    problem = Problem(mechanism, *(flat(part) for part in (targets, numbers, past, inputs)))
    return problem, flat(unknowns).copy(), flat(before), batch
