"""Laws that depend on the axial load of the bar at whose end they act, as dry friction in a bushing does.

Such a law remembers, as the first of its numbers, the size of that load where the load step before ended: within a
step it is constant, so that force and tangent are those of a law of its own coordinate. In a chain it acts on that
coordinate and those of the bar beside it, from which the load is read: what a bar bears by laws that remember, as
where it yields, is no part of that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from vjm.frames import Array
from vjm.laws import Adding, Around, Law, Response, Spring


@dataclass(frozen=True, eq=False)
class UnderLoad:
    """F = k u beside a slider that holds T N' / N0 at most, which it reaches after the displacement r N' / N0.

    stiffness: k. limit, reach: T and r at the axial load N0, `at`, N. memory: (2,) N' and where the slider stands.
    Load and tangent are those of G. M. Jenkins, British Journal of Applied Physics 13 (1962) 30-32, with a limit that
    changes from step to step. It is odd. ValueError for a negative stiffness or limit, and for a reach or a load that
    is not above zero.
    """

    stiffness: float
    limit: float
    reach: float
    at: float

    def __post_init__(self) -> None:
        if not (self.stiffness >= 0.0 and self.limit >= 0.0 and self.reach > 0.0 and self.at > 0.0):
            raise ValueError(
                "friction by load needs a stiffness and a limit of at least zero, a reach and a load above zero"
            )

    @property
    def initial_memory(self) -> Array:
        return np.zeros(2)

    def respond(self, strain: Array, memory: Array) -> Response:
        load, slip = memory[..., :1], memory[..., 1:]
        reach = self.reach * load / self.at
        trial, slope = strain - slip, self.limit / self.reach
        held = np.clip(trial, -reach, reach)
        force = self.stiffness * strain + slope * held
        tangent = self.stiffness + np.where(np.abs(trial) < reach, slope, 0.0)
        energy = 0.5 * self.stiffness * strain[..., 0] ** 2 + 0.5 * slope * held[..., 0] ** 2
        return Response(energy, force, tangent[..., None], np.concatenate([load, strain - held], axis=-1))


@dataclass(frozen=True, eq=False)
class Bar:
    """The elastic coordinates of a bar in a chain. numbers: (v,) of them, ascending. stiffness: (v, v). springs: its
    further laws. axial: number of the one along which its axial load acts."""

    numbers: np.ndarray
    stiffness: Array
    springs: tuple[Spring, ...]
    axial: int

    def away(self, coordinate: int) -> int:
        """How far a coordinate of the chain is from those of the bar, in their order."""
        return int(np.min(np.abs(self.numbers - coordinate)))


@dataclass(frozen=True, eq=False)
class _Beside(Around, Adding):
    """A law on its own coordinate, the first, that reads the axial load from those of a bar, the others.

    row: (v,) of the bar's stiffness. others: laws of the bar without memory, their places among its coordinates, and
    which of these is the axial one.
    """

    law: UnderLoad
    row: Array
    others: tuple[tuple[Law, list[int], int], ...]

    def axial(self, strain: Array) -> Array:
        """(...) load, N, of the bar at strains (..., v)."""
        load = strain @ self.row
        for law, places, own in self.others:
            load = load + law.respond(strain[..., places], np.zeros(0)).force[..., own]
        return np.asarray(load)

    def respond(self, strain: Array, memory: Array) -> Response:
        answer, size = self.law.respond(strain[..., :1], memory), strain.shape[-1]
        force, tangent = np.zeros(strain.shape), np.zeros((*strain.shape, size))
        force[..., :1], tangent[..., :1, :1] = answer.force, answer.tangent
        left = answer.memory.copy()
        left[..., 0] = np.abs(self.axial(strain[..., 1:]))
        return Response(answer.energy, force, tangent, left)

    def add(self, strain: Array, memory: Array, columns: np.ndarray, matrix: Array) -> Array:
        """(..., 1 + v), and the tangent added to the matrix."""
        answer, out = self.law.respond(strain[..., :1], memory), np.zeros(strain.shape)
        out[..., :1] = answer.force
        if matrix.size:
            matrix[..., columns[0], columns[0]] += answer.tangent[..., 0, 0]
        return out


def under_load(spring: Spring, bars: Sequence[Bar]) -> Spring:
    """A spring whose law depends on the axial load of a bar, on the coordinates of the bar that is next to it in the
    chain too; any other as it is. ValueError for one that no bar is beside."""
    if not isinstance(spring.law, UnderLoad):
        return spring
    if not bars:
        raise ValueError("friction that goes with the axial load of a bar needs an elastic bar beside it")
    (own,) = spring.coordinates
    bar = min(bars, key=lambda it: it.away(own))
    at = int(np.flatnonzero(bar.numbers == bar.axial)[0])
    others = tuple(
        (each.law, np.searchsorted(bar.numbers, each.coordinates).tolist(), each.coordinates.index(bar.axial))
        for each in bar.springs
        if bar.axial in each.coordinates and not each.law.initial_memory.size
    )
    return Spring((own, *bar.numbers.tolist()), _Beside(spring.law, bar.stiffness[at], others))
