"""What every coordinate of a chain carries: the force or moment through a place where something rigid stands."""

from __future__ import annotations

import numpy as np

from vjm import lagrangian
from vjm.equilibrium import Equilibrium
from vjm.frames import Array
from vjm.mechanism import ElasticChain


def carried(state: Equilibrium, number: int) -> Array:
    """(..., n) forces and moments, N and N·mm, through the n coordinates of the chain of this number, in equilibrium:
    what a spring in each would carry, positive where it would be stretched. Zero in perfect joints."""
    mechanism = state.mechanism
    place, chain = lagrangian.layout(mechanism), mechanism.chains[number]
    rest = lagrangian.rest(mechanism, state.drives)[number]
    unknowns = state.unknowns
    coordinates = lagrangian.chain_coordinates(chain, unknowns[..., place.coordinates[number]], rest)
    return _by_closures(chain, coordinates, unknowns[..., place.closing[number]])


def _by_closures(chain: ElasticChain, coordinates: Array, multipliers: Array) -> Array:
    """(..., n) at coordinates (..., n) and multipliers (..., c): the virtual work of closures and dead loads."""
    out = np.zeros(coordinates.shape)
    closures = [((chain.main, -1.0),), *(loop.sides for loop in chain.loops)]
    for number, sides in enumerate(closures):
        dual = multipliers[..., 6 * number : 6 * number + 6]
        for path, sign in sides:
            out[..., path.numbers] -= sign * path.chain.kinematics(coordinates[..., path.numbers], dual).pull
    for load in chain.loads:
        out += load.pull(coordinates, False)[0]
    return out
