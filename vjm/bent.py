"""Equilibria beyond a bifurcation: what a prescribed displacement presses too far stays stable, bent.

A perfect column has two bent branches, mirror images, and an unstable straight one between them; Newton's method finds
the straight one. Here the straight path is followed to where it loses stability, left along the direction that turns
unstable there, at a small given amplitude with the way along the path unknown, and the bent branch followed from there
through stable states. J. M. T. Thompson, G. W. Hunt, "A General Theory of Elastic Stability", Wiley 1973.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from vjm import lagrangian
from vjm.critical import in_phase
from vjm.equilibrium import TOLERANCE, Equilibrium, equilibrium, nearby, record
from vjm.frames import Array
from vjm.mechanism import Mechanism
from vjm.newton import Step, dense, newton
from vjm.problem import Problem, channel_scale
from vjm.reasons import Reason
from vjm.stability import reduced_modes

CLOSE = 1e-4
"""Of the way to the bifurcation, within which it is found: modes that part there are told apart by as much."""
NOTHING = 1e-6
"""Of the way: what has no state as near as that has none at all, and would be halved down to the last float."""
PARTS = 8
"""Of what is left, that are solved at once: a batch of seven costs less than the three halvings that it replaces."""
ROUNDS = 8
"""Times that the search goes on behind a place where a step was merely too long."""
AMPLITUDES = (0.01, 0.003, 0.03)
"""First step along the buckling direction, of the length or rad, tried in turn."""
LIMIT = 0.05
"""Of the lowest eigenvalue at the start: less is at a limit point, where it goes with the root of the way left."""
NEUTRAL = 1e-6
"""Of the lowest eigenvalue without load: what is smaller is none. A round bar bends to all sides alike."""
_ITERATIONS = 30


@dataclass(frozen=True, eq=False)
class Ways:
    """Where a path leaves its straight branch: a state (no batch axes) for each side, or why there is none."""

    sides: tuple[Equilibrium, ...]
    reason: Reason


def leave(before: Equilibrium, target: Array, channels: np.ndarray, drives: Array) -> Ways:
    """Bent states just beyond the first loss of stability on the way to a lost step.

    before: a stable state (no batch axes), with what the laws remembered at the start of its step. target (6,),
    channels (6,) and drives (D,) of the lost step, the laws' memory that which `before` leaves.
    """
    way = _Way(before, target, channels, drives)
    low, high = way.begin(), None
    if not low.converged or low.unstable > 0:
        return Ways((), Reason.of(str(low.reason)) if not low.converged else Reason.UNSTABLE)
    near, high = 0.0, low
    for _ in range(ROUNDS):
        low, near, far = way.narrowed(low, near)
        high = way.solved(far, low)
        if not high.converged:
            return Ways((), way.ended(low))
        if high.unstable > 0:
            break
        # No bifurcation was there, but a step too long for Newton's method.
        low, near = high, far
        if far == 1.0:
            return Ways((high,), Reason.UNSTABLE)
    found = [way.switched(high, far, direction) for direction in _directions(high)]
    return Ways(tuple(state for state in found if state is not None), Reason.UNSTABLE)


def along(side: Equilibrium, targets: Array, channels: np.ndarray, drives: Array) -> Equilibrium:
    """States (S,) of the steps with these targets (S, 6), channels (S, 6) and drives (S, D) on the branch of a side.

    Each from the side, and those that are not found so from the nearest one that is. Laws keep the memory of the side.
    """
    count = len(targets)
    mechanism = side.mechanism
    names = lagrangian.layout(mechanism).drives
    memory = np.broadcast_to(side.memory, (count, side.memory.shape[-1]))

    def solved(rows: np.ndarray, start: Equilibrium) -> Equilibrium:
        inputs = _inputs(mechanism, names, drives[rows])
        return equilibrium(
            mechanism, targets[rows], channels[rows], start, drives=inputs, memory=memory[rows]
        )

    every = np.arange(count)
    state = neutral_is_stable(solved(every, side))
    size = channel_scale(lagrangian.layout(mechanism), channels)
    while True:
        good = state.converged & (state.unstable <= 0)
        left, there = np.flatnonzero(~good), np.flatnonzero(good)
        if not left.size or not there.size:
            return state
        apart = np.max(np.abs((targets[left, None] - targets[there]) / size[left, None]), axis=-1)
        again = neutral_is_stable(solved(left, state.member(there[np.argmin(apart, axis=1)])))
        better = again.converged & (again.unstable <= 0)
        if not better.any():
            return state
        state = state.with_members(left[better], again.member(better))


def neutral_is_stable(state: Equilibrium) -> Equilibrium:
    """The states (B,), those not counted as unstable whose only negative eigenvalues are zero to rounding."""
    doubtful = np.flatnonzero(state.converged & (state.unstable > 0) & (state.unstable <= 2))
    unstable = state.unstable.copy()
    for k in doubtful:
        one = state.member(int(k))
        held = np.asarray(one.held)
        rest = replace(one, unknowns=lagrangian.at_rest(one.mechanism, one.drives))
        zero = NEUTRAL * np.maximum(reduced_modes(rest, held).values[0], 0.0)
        values = reduced_modes(one, held).values
        if np.isfinite(zero) and np.isfinite(values).all():
            unstable[k] = int(np.sum(values < -zero))
    return replace(state, unstable=unstable) if doubtful.size else state


def _directions(state: Equilibrium) -> list[Array]:
    """Directions (N,) in which a state just past its first bifurcation is unstable, to either side."""
    count = int(state.unstable)
    modes = reduced_modes(state, np.asarray(state.held))
    place = lagrangian.layout(state.mechanism)
    if count < 1 or not modes.vectors.size or not np.isfinite(modes.values).all():
        # Everything is held, or what turned unstable is none of the free directions.
        return []
    vectors = modes.vectors[:, :count] / place.scale[:, None]
    first = in_phase(modes.vectors[:, :count], place) / place.scale
    # What is left of the others beside the direction in which all bars move alike.
    rest = vectors - np.outer(first, first @ vectors)
    left, size, _ = np.linalg.svd(rest, full_matrices=False)
    every = [first, *(left[:, k] for k in range(count) if size[k] > 1e-6)]
    if len(every) == 2:
        # A bar alike in both planes is not quite so in segments: it bends along one of four diagonals at least.
        every += [(every[0] + sign * every[1]) / np.sqrt(2.0) for sign in (1.0, -1.0)]
    return [sign * each * place.scale for each in every for sign in (1.0, -1.0)]


@dataclass(frozen=True, eq=False)
class _Way:
    """The straight line of targets from those of a stable state (share 0) to those of a lost step (share 1)."""

    before: Equilibrium
    target: Array
    channels: np.ndarray
    drives: Array

    @property
    def memory(self) -> Array:
        return self.before.next_memory

    @property
    def origin(self) -> Array:
        """(6,) what the controlled channels read at share 0."""
        return self._problem(self.target[None]).readings(self.before.unknowns[None])[0]

    def begin(self) -> Equilibrium:
        """The state at share 0 under the inputs of the lost step."""
        return self.solved(0.0, self.before)

    def solved(self, share: float, start: Equilibrium) -> Equilibrium:
        """The state at a share of the way, on the branch of the start."""
        mechanism, aim, channels, start, inputs = self._aimed(share, start)
        return equilibrium(
            mechanism, aim, channels, start, limit=12, follow=True, drives=inputs, memory=self.memory
        )

    def _aimed(
        self, share: ArrayLike, start: Equilibrium
    ) -> tuple[Mechanism, Array, np.ndarray, Equilibrium, dict[str, Array]]:
        """What equilibria at shares (...) of the way are asked for with."""
        mechanism = self.before.mechanism
        inputs = _inputs(mechanism, lagrangian.layout(mechanism).drives, self.drives)
        aim = self.origin + np.asarray(share)[..., None] * (self.target - self.origin)
        return mechanism, aim, self.channels, start, inputs

    def narrowed(self, low: Equilibrium, near: float) -> tuple[Equilibrium, float, float]:
        """The last stable state that is found from one at the share `near`, its share, and one where none is.

        What lies between is parted again and again, its parts solved at once, and those up to the first failure kept.
        """
        far = 1.0
        while far - near > CLOSE * far and far > NOTHING:
            shares = np.linspace(near, far, PARTS + 1)[1:-1]
            there = nearby(
                *self._aimed(shares, low), np.broadcast_to(self.memory, (PARTS - 1, self.memory.size))
            )
            good = int(np.argmin(np.append(there.converged, False)))
            if good < PARTS - 1:
                far = float(shares[good])
            if good:
                low, near = there.member(good - 1), float(shares[good - 1])
        return low, near, far

    def switched(self, at: Equilibrium, share: float, direction: Array) -> Equilibrium | None:
        """A stable state beside the one at a share of the way: the amplitude along the direction is given, the share
        is not."""
        for amplitude in AMPLITUDES:
            state = neutral_is_stable(self._switch(at, share, direction, amplitude).reshaped(1)).member(0)
            if state.converged and state.unstable <= 0:
                return state
        return None

    def _switch(self, at: Equilibrium, share: float, direction: Array, amplitude: float) -> Equilibrium:
        place, origin = lagrangian.layout(at.mechanism), self.origin
        weight = direction / place.scale**2
        way = self.target - origin
        slope = np.zeros(place.size)
        slope[place.platform] = -way / channel_scale(place, self.channels)
        scale = np.append(place.scale, share)

        def system(unknowns: Array, members: np.ndarray) -> tuple[Array, Step]:
            u, s = unknowns[:, :-1], unknowns[:, -1:]
            rows, matrix = self._problem(origin + s * way).whole(u, members)
            added = (u - at.unknowns) @ weight - amplitude
            bordered = np.zeros((len(u), place.size + 1, place.size + 1))
            bordered[:, :-1, :-1], bordered[:, :-1, -1], bordered[:, -1, :-1] = matrix, slope, weight
            rows = np.append(rows, added[:, None], axis=1)
            return rows, dense(rows, bordered, scale)

        first = np.append(at.unknowns + amplitude * direction, share)
        motion = np.arange(place.platform.stop)
        end = newton(system, first[None], scale, TOLERANCE, _ITERATIONS, motion)
        found = origin + end.unknowns[:, -1:] * way
        problem = self._problem(found)
        end = replace(end, unknowns=end.unknowns[:, :-1])
        state = record(problem, end, ())
        # Newton's method here does not count unstable directions; the one from there does, and stays.
        inputs = _inputs(at.mechanism, place.drives, self.drives)
        return (
            equilibrium(
                at.mechanism,
                found[0],
                self.channels,
                state,
                limit=12,
                follow=True,
                drives=inputs,
                memory=self.memory,
            )
            if state.converged
            else state
        )

    def ended(self, last: Equilibrium) -> Reason:
        """Why nothing is found beyond the last stable state: at a limit point its stiffness has gone to zero."""
        start, end = (reduced_modes(each, np.asarray(each.held)).values[0] for each in (self.begin(), last))
        return Reason.NO_EQUILIBRIUM if end < LIMIT * start else Reason.NOT_CONVERGED

    def _problem(self, targets: Array) -> Problem:
        mechanism = self.before.mechanism
        parts = (self.channels, self.memory, self.drives)
        return Problem(mechanism, targets, *(np.broadcast_to(p, (len(targets), p.shape[-1])) for p in parts))


def _inputs(mechanism: Mechanism, names: Sequence[str], drives: Array) -> dict[str, Array]:
    """Inputs by name from departures (..., D)."""
    defaults = lagrangian.layout(mechanism).defaults
    return {name: drives[..., k] + defaults[k] for k, name in enumerate(names)}
