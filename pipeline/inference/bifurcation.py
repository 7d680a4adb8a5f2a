"""Rows beyond a bifurcation: under prescribed displacements the linkage goes on, bent to one side or the other.

Only rows without a stable equilibrium are looked at, and of these only those whose displacement is prescribed: a load
that is more than critical lets the linkage run away. Which of the sides a test is on its readings say, gauges above
all; where they say nothing, the least energy, and else the first side, for mirror images read the same.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.rig import Solvable
from pipeline.inference.load_cases import LOST, Group, LoadCases
from pipeline.inference.settings import BIFURCATION
from vjm import lagrangian
from vjm.bent import along, leave, neutral_is_stable
from vjm.equilibrium import Equilibrium, drive_values, unloaded
from vjm.mechanism import Mechanism
from vjm.reasons import Reason
from vjm.stability import reduced_modes

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
_GAUGES = 12


@dataclass(frozen=True, eq=False)
class Sight:
    """What the sensors read at the steps of a group.

    measured, used, sigma: (T, S, C). zeroed: (T, S) where constants of the sensors are not known.
    """

    measured: Array
    used: Mask
    sigma: Array
    zeroed: Mask

    @classmethod
    def of(cls, load_cases: LoadCases, rows: NDArray[np.int64]) -> Sight:
        """Of these rows (T, S)."""
        zero = np.any(load_cases.loose, axis=1)
        return cls(
            load_cases.measured[rows],
            load_cases.predicted[rows],
            load_cases.spread[rows],
            zero[load_cases.test[rows]],
        )

    def misfit(self, where: tuple[NDArray[np.int64], ...], readings: Array, found: Mask) -> float:
        """Chi-square of readings (N, C) at these steps; what is not found counts as lost."""
        used = self.used[where]
        sigma = np.where(used, self.sigma[where], 1.0)
        left = np.where(used, self.measured[where] - readings, 0.0) / sigma
        if self.zeroed[where].any():
            left = np.where(used, left - np.sum(left, axis=0) / np.maximum(used.sum(axis=0), 1), 0.0)
        return float(np.sum(np.where(found[:, None], left**2, LOST**2 * used)))


def lost(state: Equilibrium) -> Mask:
    """(...) where there is no stable equilibrium."""
    return np.asarray(~state.converged | (state.unstable > 0))


def driven(group: Group) -> Mask:
    """(T, S) steps that prescribe a displacement other than the nominal one."""
    held = group.channels[:, None] < 6
    nominal = np.broadcast_to(group.nominal, group.targets.shape)
    ungauged = np.all(group.channels < _GAUGES, axis=1)[:, None]
    return np.asarray(np.any(held & (group.targets != nominal), axis=-1) & ungauged)


def branched(
    mechanism: Solvable,
    group: Group,
    sight: Sight,
    inputs: dict[str, Array],
    state: Equilibrium,
    begun: Equilibrium | None = None,
) -> Equilibrium:
    """The states (T, S) of a group without memory, those of rows beyond a bifurcation on their branch, and the reasons
    of those that stay lost.

    begun: states of a like model that these were solved from: rows that it lost have no branch that this way finds.
    """
    missing = lost(state) & group.real
    if not missing.any():
        return state
    again = neutral_is_stable(state.member(np.nonzero(missing)))
    state = state.with_members(np.nonzero(missing), again)
    beyond = lost(state) & group.real & driven(group)
    if begun is not None:
        beyond &= ~lost(begun)
    drives = np.broadcast_to(drive_values(mechanism, inputs), (*group.rise.shape, state.drives.shape[-1]))
    for number in np.unique(group.numbers[beyond.any(axis=1)]):
        rows = np.nonzero(beyond & (group.numbers == number)[:, None])
        found = _of_test(mechanism, group, sight, drives, rows)
        if found is not None:
            better = ~lost(found)
            state = state.with_members((rows[0][better], rows[1][better]), found.member(better))
    missing = lost(state) & group.real
    if begun is None or begun.converged.shape != missing.shape:
        return with_reasons(state, missing)
    # Of those that a like model lost as well it is known.
    known = missing & ~state.converged & ~begun.converged
    reason = np.where(known, begun.reason, state.reason)
    return with_reasons(replace(state, reason=reason), missing & ~known)


def _of_test(
    mechanism: Solvable, group: Group, sight: Sight, drives: Array, rows: tuple[NDArray[np.int64], ...]
) -> Equilibrium | None:
    """States (N,) of the lost rows of one test on the side that its readings choose; None where no branch is found."""
    targets, channels, inputs = group.targets[rows], group.channels[rows[0]], drives[rows]
    nominal = np.broadcast_to(group.nominal, group.targets.shape)[rows]
    way = np.max(np.where(channels < 6, np.abs(targets - nominal), 0.0), axis=1)
    first = int(np.argmin(way))
    start = unloaded(mechanism)
    start = replace(start, drives=inputs[first], unknowns=_at_rest(mechanism, inputs[first]))
    sides = leave(start, targets[first], channels[first], inputs[first]).sides
    if not sides:
        return None
    used = np.asarray(sight.used[rows].any(axis=0))
    states = [along(side, targets, channels, inputs) for side in _that_read_otherwise(sides, used)]
    return states[chosen(states, lambda state: sight.misfit(rows, _read(state, nominal), ~lost(state)))]


def _that_read_otherwise(sides: Sequence[Equilibrium], used: Mask) -> list[Equilibrium]:
    """The sides less those that the channels in use (C,) cannot tell from one before them."""
    out: list[Equilibrium] = []
    for side in sides:
        alike = (
            np.abs(side.readings - other.readings)
            <= BIFURCATION.same * np.abs(side.readings) + BIFURCATION.nothing
            for other in out
        )
        if not any(np.all(same[used]) for same in alike):
            out.append(side)
    return out


def _at_rest(mechanism: Mechanism, drives: Array) -> Array:
    return lagrangian.at_rest(mechanism, drives)


def _read(state: Equilibrium, nominal: Array) -> Array:
    """Readings (N, C), displacements from the nominal pose."""
    values = state.readings.copy()
    values[..., :6] -= nominal
    return values


def chosen(states: list[Equilibrium], misfit: Callable[[Equilibrium], float]) -> int:
    """Number of the states that fit best; of those that fit alike, the ones of least energy, else the first."""
    costs = np.array([misfit(state) for state in states])
    alike = np.flatnonzero(costs <= costs.min() * (1.0 + BIFURCATION.same) + BIFURCATION.same)
    energy = np.array([np.sum(np.where(lost(states[k]), 0.0, states[k].energy)) for k in alike])
    return int(alike[np.flatnonzero(energy <= energy.min() * (1.0 + BIFURCATION.same))[0]])


def with_reasons(state: Equilibrium, missing: Mask) -> Equilibrium:
    """The states (...), with the reason of each that was approached and not reached: is there none, or was it not
    found?"""
    stuck = missing & ~state.converged
    stuck &= np.array([Reason.of(str(r)) is Reason.NOT_CONVERGED for r in state.reason.ravel()]).reshape(
        stuck.shape
    )
    if not stuck.any():
        return state
    reason = state.reason.copy()
    start = unloaded(state.mechanism)
    for place in map(tuple, np.argwhere(stuck)):
        last = state.member(place)
        held = np.asarray(last.held)
        rest = replace(start, drives=last.drives, unknowns=_at_rest(state.mechanism, last.drives))
        least = [reduced_modes(replace(s, memory=last.memory), held).values[0] for s in (rest, last)]
        if 0.0 < least[1] < BIFURCATION.flat * least[0]:
            reason[place] = Reason.NO_EQUILIBRIUM
    return replace(state, reason=reason)
