"""Where the hinges of a manipulator stand when it has been put together and nothing loads it.

Bars that are not as long as drawn turn their hinges, and what acts about a hinge is relaxed there, as on the bench
(`vjm.mechanisms.assembled`). In a machine the other legs hold the platform, so that bars of different lengths also
strain each other: the hinges stand where the whole is in equilibrium without friction, hinge springs or weight.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from vjm.frames import Array
from vjm.manipulator.equilibrium import TOLERANCE, control_rows, equilibrium
from vjm.manipulator.lagrangian import System, system
from vjm.manipulator.loops import LoopedLeg, looped
from vjm.manipulator.parts import Leg, Manipulator, Parallelogram, Part
from vjm.manipulator.posture import Postures
from vjm.mechanisms.assembled import FourBar

LOOSE = 1e-10
"""Of the largest singular value of the dimensionless tangent without load: the Orthoglide's least is 1e-6, that of a
motion that nothing holds is rounding, 1e-16."""
_FREE = np.zeros(6, dtype=bool)


def settled(manipulator: Manipulator, at: Postures) -> tuple[Array, ...]:
    """Per leg (B, N): turns of hinges, rad, from where they are drawn to where they stand unloaded, at postures (B,).

    Zero for all other coordinates. Zeros (1, N) where no law acts about a hinge or all bars are as long as drawn. Where
    nothing holds the unloaded platform, each linkage stands as it would alone.
    """
    if not any(_matters(part) for leg in manipulator.legs for part in leg.moving):
        return tuple(np.zeros((1, looped(leg).rest.size)) for leg in manipulator.legs)
    of = system(_without_loads(manipulator), at)
    alone = tuple(map(_alone, of.legs, at.coordinates, of.rest))
    start = replace(of, rest=tuple(rest + turn for rest, turn in zip(of.rest, alone, strict=True)))
    strained = np.flatnonzero(_strained(start))
    if not strained.size:
        return alone
    part = start.take(strained)
    found = equilibrium(part, np.zeros(6))
    out = tuple(turn.copy() for turn in alone)
    for k, leg in enumerate(of.legs):
        numbers = _hinges(leg)
        ends = part.full(k, found.unknowns)[:, numbers] - of.rest[k][strained][:, numbers]
        held = found.converged[:, None]
        out[k][strained[:, None], numbers] = np.where(held, ends, out[k][strained[:, None], numbers])
    return out


def relaxed(of: System, turns: tuple[Array, ...]) -> System:
    """The system with the hinges of each leg relaxed at these turns (B, N) or (1, N) from as drawn."""
    return replace(of, rest=tuple(rest + turn for rest, turn in zip(of.rest, turns, strict=True)))


def _without_loads(manipulator: Manipulator) -> Manipulator:
    """The manipulator with ideal hinges, weightless bars and no sensors."""

    def bare(part: Part) -> Part:
        if not isinstance(part, Parallelogram) or part.built is None:
            return part
        return replace(part, built=replace(part.built, hinges=(), line_load=np.zeros(3)))

    legs = tuple(Leg(leg.name, tuple(map(bare, leg.parts))) for leg in manipulator.legs)
    return replace(manipulator, legs=legs, sensors=())


def _matters(part: object) -> bool:
    """Whether a law acts about hinges of a pair of bars that are not as drawn."""
    if not isinstance(part, Parallelogram) or part.built is None or part.bars != "pair":
        return False
    return bool(part.built.hinges) and any(link.length != part.length for link in part.built.links)


def _hinges(leg: LoopedLeg) -> np.ndarray:
    """Numbers of the hinges of all pairs of bars."""
    pairs = [
        k for k, part in enumerate(leg.leg.moving) if isinstance(part, Parallelogram) and part.bars == "pair"
    ]
    return np.flatnonzero(np.any(leg.posture[pairs], axis=0))


def _alone(leg: LoopedLeg, posture: Array, rest: Array) -> Array:
    """(B, N) turns of the hinges if each linkage of a leg stood by itself."""
    out = np.zeros_like(rest)
    for number, part in enumerate(leg.leg.moving):
        if not isinstance(part, Parallelogram) or part.bars != "pair":
            continue
        built = part.as_built
        first, second = (link.length for link in built.links)
        loop = FourBar((first, second), part.width + built.wider)
        q = posture.reshape(len(rest), -1)[:, number]
        out[:, np.flatnonzero(leg.posture[number])] = np.concatenate(
            [loop.hinges(bar, q) for bar in (0, 1)], axis=-1
        )
    return out


def _strained(of: System) -> np.ndarray:
    """(B,) whether the whole is out of balance at rest, and held: nothing is prescribed but that no load acts.

    Newton's method would move what nothing holds to any place, or find its tangent singular, as rounding has it.
    """
    rows, tangent, _ = control_rows(of, of.at_rest(), _FREE)
    sizes = np.linalg.svd(tangent * of.scale, compute_uv=False)
    held = sizes[:, -1] > LOOSE * sizes[:, 0]
    return np.asarray(held & (np.max(np.abs(rows), axis=-1) >= TOLERANCE))
