"""Where the hinges of a manipulator stand when it has been put together and nothing loads it.

Bars that are not as long as drawn turn their hinges, and what acts about a hinge is relaxed there, as on the bench
(`vjm.mechanisms.assembled`). In a machine the other legs hold the platform, so that bars of different lengths also
strain each other: the hinges stand where the whole is in equilibrium without friction, hinge springs or weight.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from vjm.equilibrium import TOLERANCE, Equilibrium, drive_values, equilibrium, unloaded
from vjm.frames import Array
from vjm.lagrangian import rest
from vjm.leg_chain import posture_input, turn_input
from vjm.manipulator.machine import Machine, posture_inputs
from vjm.manipulator.parts import Parallelogram
from vjm.manipulator.posture import Postures
from vjm.mechanisms.assembled import FourBar
from vjm.parts import Leg, Part, posture_of
from vjm.problem import Problem, channel_numbers

LOOSE = 1e-10
"""Of the largest singular value of the dimensionless tangent without load: the Orthoglide's least is 1e-6, that of a
motion that nothing holds is rounding, 1e-16."""


def settled(of: Machine, at: Postures) -> dict[str, Array]:
    """Turns (B,) of hinges, rad, from where they are drawn to where they stand unloaded, at postures (B,), as inputs.

    None where no law acts about a hinge or all bars are as long as drawn. Where nothing holds the unloaded platform,
    each linkage stands as it would alone.
    """
    if not of.turning:
        return {}
    free = _without_loads(of)
    posture = posture_inputs(at)
    turns = _alone(of, at)
    start = unloaded(free, posture | turns)
    strained = np.flatnonzero(_strained(start))
    if not strained.size:
        return turns
    inputs = {name: value[strained] for name, value in (posture | turns).items()}
    found = equilibrium(free, np.zeros(6), (), start.member(strained), drives=inputs)
    drawn = rest(free, drive_values(free, {name: posture[name][strained] for name in posture}))
    good = strained[found.converged]
    for k, (chain, x, before) in enumerate(zip(free.chains, found.coordinates, drawn, strict=True)):
        for number in range(chain.size):
            name = turn_input(str(k), number)
            if name in turns:
                turns[name][good] = (x - before)[found.converged, number]
    return turns


def _without_loads(of: Machine) -> Machine:
    """The machine with ideal hinges, weightless bars and no sensors."""

    def bare(part: Part) -> Part:
        if not isinstance(part, Parallelogram) or part.built is None:
            return part
        return replace(part, built=replace(part.built, hinges=((),) * 4, line_load=np.zeros(3)))

    manipulator = of.manipulator
    legs = tuple(Leg(leg.name, tuple(map(bare, leg.parts))) for leg in manipulator.legs)
    return Machine(replace(manipulator, legs=legs, sensors=()), turning=True)


def _alone(of: Machine, at: Postures) -> dict[str, Array]:
    """Turns (B,) of the hinges if each linkage of a leg stood by itself, as inputs."""
    out = {}
    for k, (leg, chain, posture) in enumerate(
        zip(of.manipulator.legs, of.chains, at.coordinates, strict=True)
    ):
        slopes = {drive.name: drive.slope for drive in chain.drives}
        moving = [part for part in leg.parts for _ in posture_of(part)]
        for number, part in enumerate(moving):
            if not isinstance(part, Parallelogram) or part.bars != "pair":
                continue
            built = part.as_built
            first, second = (link.length for link in built.links)
            loop = FourBar((first, second), part.width + built.wider)
            turned = np.concatenate([loop.hinges(bar, posture[..., number]) for bar in (0, 1)], axis=-1)
            for place, hinge in enumerate(np.flatnonzero(slopes[posture_input(str(k), number)])):
                out[turn_input(str(k), int(hinge))] = turned[..., place]
    return out


def _strained(state: Equilibrium) -> np.ndarray:
    """(B,) whether the whole is out of balance at rest, and held: nothing is prescribed but that no load acts.

    Newton's method would move what nothing holds to any place, or find its tangent singular, as rounding has it.
    """
    count = len(state.unknowns)
    loads = np.broadcast_to(channel_numbers(()), (count, 6))
    problem = Problem(state.mechanism, np.zeros((count, 6)), loads, state.memory, state.drives)
    rows, tangent = problem.whole(state.unknowns, np.arange(count))
    sizes = np.linalg.svd(tangent * problem.place.scale, compute_uv=False)
    held = sizes[:, -1] > LOOSE * sizes[:, 0]
    return np.asarray(held & (np.max(np.abs(rows), axis=-1) >= TOLERANCE))
