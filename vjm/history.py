"""Derivatives along histories: what the laws remember of a step is handed on to the next one.

At a step r(u, m, p) = 0 leaves the memory M(u, m, p). Only the laws know m, so with the slope dm of the memory before
the step the forces on their coordinates change by df = f_m dm, the unknowns by du = du_p - r_u^-1 df, and the memory
by M_p + M_u du + M_m dm. Everything but the slope of the memory is found for all steps at once; handing it on takes
the laws alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from vjm import lagrangian
from vjm.equilibrium import Equilibrium
from vjm.frames import Array
from vjm.laws import Law
from vjm.sensitivity import AnyDirection, Force, Sensitivity, Target, by_parameters, differences, read_change


def by_history(state: Equilibrium, directions: Sequence[AnyDirection], order: int = 4) -> Sensitivity:
    """Derivatives of T histories of S steps, states (T, S), by k parameters, inputs or targets.

    A parameter or an input changes at all steps, a target at its own alone: what it leaves in the memory is not
    followed. order: see `by_parameters`. `memory` of the answer is what each step by itself changes in it.
    """
    laws, count = _Laws.of(state), len(directions)
    forces = [Force(int(place)) for place in laws.places]
    # Few sides more cost less than the same matrices once more.
    at_once = forces if len(forces) <= count else []
    alone = by_parameters(state, [*directions, *at_once], order=order)
    gain = alone.unknowns[..., count:]
    alone = replace(alone, **{n: getattr(alone, n)[..., :count] for n in ("unknowns", "memory", "readings")})
    handed = [k for k, d in enumerate(directions) if not isinstance(d, Target | Force)]
    left = alone.memory[..., handed]
    marked = np.any(left != 0.0, axis=(-2, -1))
    tests = np.flatnonzero(marked[:, :-1].any(axis=1))
    if not tests.size:
        return alone
    first = int(np.argmax(marked[tests].any(axis=0))) + 1
    part = state.member((tests, slice(first, None)))
    gain = gain[tests, first:] if at_once else by_parameters(part, forces).unknowns
    steps = differences(order, np.array([d.size for d in directions if not isinstance(d, Target | Force)]))
    strain, memory = part.unknowns[..., laws.places] - laws.rest(part), part.memory
    slope = left[tests, first - 1]
    force = np.zeros((*strain.shape, len(handed)))
    for now in range(strain.shape[1]):
        here = strain[:, now], memory[:, now]
        force[:, now] = laws.change(*here, np.zeros_like(force[:, now]), slope, steps)[0]
        moved = gain[:, now, laws.places] @ force[:, now]
        slope = left[tests, first + now] + laws.change(*here, moved, slope, steps)[1]
    unknowns, readings = alone.unknowns.copy(), alone.readings.copy()
    change = gain @ force
    for whole, more in ((unknowns, change), (readings, read_change(part, change))):
        later = whole[tests, first:]
        later[..., handed] += more
        whole[tests, first:] = later
    return replace(alone, unknowns=unknowns, readings=readings)


@dataclass(frozen=True, eq=False)
class _Laws:
    """The laws that remember. each: law, its coordinates among theirs (c,) and its memory (M,). places: (c,) of the
    coordinates among the unknowns."""

    each: tuple[tuple[Law, slice, slice], ...]
    places: np.ndarray

    @classmethod
    def of(cls, state: Equilibrium) -> _Laws:
        place = lagrangian.layout(state.mechanism)
        each, places, count, past = [], [], 0, 0
        for chain, x in zip(state.mechanism.chains, place.coordinates, strict=True):
            for spring in chain.springs:
                size, keeps = len(spring.coordinates), spring.law.initial_memory.size
                if keeps:
                    each.append((spring.law, slice(count, count + size), slice(past, past + keeps)))
                    places.append(x.start + np.searchsorted(chain.moving, spring.coordinates))
                    count, past = count + size, past + keeps
        return cls(tuple(each), np.concatenate([np.zeros(0, dtype=int), *places]))

    def rest(self, state: Equilibrium) -> Array:
        """(..., c) rest values of their coordinates."""
        rest = lagrangian.rest(state.mechanism, state.drives)
        batch = state.converged.shape
        parts = zip(state.mechanism.chains, rest, strict=True)
        moving = [np.broadcast_to(r, (*batch, r.shape[-1]))[..., chain.moving] for chain, r in parts]
        return np.concatenate(moving, axis=-1)[..., self.places]

    def change(
        self,
        strain: Array,
        memory: Array,
        by_strain: Array,
        by_memory: Array,
        steps: Sequence[tuple[Array, Array]],
    ) -> tuple[Array, Array]:
        """Derivatives (t, c, k) of the forces and (t, M, k) of the memory left, along changes of strain (t, c, k)
        and memory (t, M, k)."""
        force, left = np.zeros_like(by_strain), np.zeros_like(by_memory)
        along, past = np.swapaxes(by_strain, -1, -2), np.swapaxes(by_memory, -1, -2)
        for step, weight in steps:
            there, then = strain[:, None] + step[:, None] * along, memory[:, None] + step[:, None] * past
            for law, x, m in self.each:
                answer = law.respond(there[..., x], then[..., m])
                force[:, x] += weight * np.swapaxes(answer.force, -1, -2)
                left[:, m] += weight * np.swapaxes(answer.memory, -1, -2)
        return force, left
