"""Stiffness of a whole manipulator at rest, for many postures at once (Eq. 10 without load).

A parallelogram enters as its equivalent pseudo-rigid bar, which at rest is exact: between its two pins a bar keeps
the same 6x6 in its own frame at any angle q; only the levers to the middle of the linkage follow q.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from vjm.built_leg import Built
from vjm.frames import Array
from vjm.leg_chain import build
from vjm.lumped import Lumped
from vjm.manipulator.freedom import undetermined
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import Postures
from vjm.mechanism import ElasticChain
from vjm.newton import solve_each
from vjm.parts import Elastic, Fork, Leg, Part
from vjm.stiffness import eliminate

SINGULAR = "has no stiffness that can be computed here"
"""Where a leg is neither rigid nor loose (`vjm.manipulator.freedom`) and its equations are singular still."""
# Asymmetry of a 6x6 in units of its diagonal: rounding of a regular elimination stays five digits below.
_ASYMMETRY = 1e-6


@dataclass(frozen=True, eq=False)
class RestStiffness:
    """Stiffness at rest, batched over leading axes; base frame, at the platform point.

    by_leg: (..., legs, 6, 6). found: (...) of bool; reason: (...) of strings, empty where found. Zeros where not.
    """

    by_leg: Array
    found: np.ndarray
    reason: np.ndarray

    @property
    def total(self) -> Array:
        """(..., 6, 6) sum over the legs."""
        return np.asarray(np.sum(self.by_leg, axis=-3))


def stiffness_at_rest(manipulator: Manipulator, at: Postures) -> RestStiffness:
    """6x6 of every leg at the postures; those that are not reached or singular say so.

    As drawn: ValueError for a manipulator with effects, whose state at rest `vjm.manipulator.equilibrium` finds.
    """
    if manipulator.sensors or any(
        isinstance(part, Parallelogram) and part.built is not None
        for leg in manipulator.legs
        for part in leg.parts
    ):
        raise ValueError(
            f"{manipulator.name} is not as drawn: its stiffness at rest is that of an equilibrium"
        )
    batch = at.reached.shape
    reason = at.reason.reshape(-1).copy()
    good = np.flatnonzero(reason == "")
    by_leg = np.zeros((reason.size, len(manipulator.legs), 6, 6))
    for number, leg in enumerate(manipulator.legs):
        x = at.coordinates[number].reshape(reason.size, -1)[good]
        matrix, regular = leg_stiffness(leg, x)
        by_leg[good, number] = matrix
        for k in np.flatnonzero(~regular & (reason[good] == "")):
            reason[good[k]] = f"leg {leg.name} {why_singular(leg, x[k], manipulator.length)}"
    by_leg[reason != ""] = 0.0
    said = np.reshape(reason, batch)
    return RestStiffness(by_leg.reshape(*batch, *by_leg.shape[1:]), np.asarray(said == ""), said)


def leg_stiffness(leg: Leg, coordinates: Array) -> tuple[Array, np.ndarray]:
    """(B, 6, 6) of one leg at its coordinates (B, m), platform point, base frame; and whether it is regular (B,)."""
    of = _lumped(leg)
    chain = of.chain
    x = chain.rest + coordinates @ of.posture
    jacobian = chain.close(x)[1]
    plain = not (chain.loops or chain.springs)
    sprung = chain.virtual if plain else chain.moving
    spring = np.broadcast_to(
        _tangent(chain)[np.ix_(sprung, sprung)], (len(x), sprung.size, sprung.size)
    ).copy()
    for part, moving, numbers in of.swinging:
        own = np.searchsorted(sprung, numbers)
        spring[:, own[:, None], own] = part.springs(coordinates[:, moving])
    # A leg that moves without load overflows here and is found out below.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        if plain:
            out, regular = _eliminated(jacobian[..., sprung], jacobian[..., chain.passive], spring)
        else:
            out, regular = _bordered(jacobian[..., sprung], spring)
    out[~regular] = 0.0
    size = np.sqrt(np.abs(np.diagonal(out, axis1=-2, axis2=-1)))
    unit = size[:, :, None] * size[:, None, :] + np.max(size, axis=-1)[:, None, None] ** 2 * 1e-9
    gap = np.max(np.abs(out - np.swapaxes(out, -1, -2)) / np.maximum(unit, 1e-300), axis=(-2, -1))
    regular &= gap < _ASYMMETRY
    return 0.5 * (out + np.swapaxes(out, -1, -2)), regular


def _tangent(chain: ElasticChain) -> Array:
    """(n, n) of springs and laws where they carry nothing."""
    out = np.zeros((chain.size, chain.size))
    out[np.ix_(chain.virtual, chain.virtual)] = chain.stiffness
    for spring in chain.springs:
        numbers = np.array(spring.coordinates)
        strain = np.zeros(numbers.size)
        out[np.ix_(numbers, numbers)] += spring.law.respond(strain, spring.law.initial_memory).tangent
    return out


def _bordered(jacobian: Array, spring: Array) -> tuple[Array, np.ndarray]:
    """(B, 6, 6) load at the end for its unit motions, loops closed, and whether it is regular (B,).

    jacobian: (B, c, m) of the closures, that of the end first. spring: (B, m, m).
    """
    c, m = jacobian.shape[-2:]
    scale = 1.0 / np.sqrt(np.maximum(np.max(np.abs(spring)), 1e-300))
    matrix = np.zeros((len(jacobian), m + c, m + c))
    matrix[:, :m, :m] = spring * scale**2
    matrix[:, m:, :m] = jacobian
    matrix[:, :m, m:] = np.swapaxes(jacobian, -1, -2)
    right = np.zeros((len(jacobian), m + c, 6))
    right[:, m : m + 6] = np.eye(6)
    solution, regular = solve_each(matrix, right)
    return -solution[:, m : m + 6] / scale**2, regular


def why_singular(leg: Leg, coordinates: Array, length: float) -> str:
    """What is wrong with a leg that has no stiffness at its coordinates (m,); length: a size of it, mm."""
    of = _lumped(leg)
    chain = of.chain
    shifts = np.array([joint.kind == "translation" for joint in chain.joints])
    size = np.tile(np.repeat([length, 1.0], 3), chain.closures // 6)
    jacobian = chain.close(chain.rest + coordinates @ of.posture)[1] / size[:, None]
    jacobian = jacobian * np.where(shifts, length, 1.0)
    given = np.concatenate([chain.virtual, chain.passive])
    return undetermined(jacobian[:, given], np.isin(given, chain.passive)) or SINGULAR


def _eliminated(theta: Array, q: Array, spring: Array) -> tuple[Array, np.ndarray]:
    """(B, 6, 6) without virtual and passive coordinates, and whether it is finite (B,); one by one if need be."""
    out, regular = np.zeros((len(theta), 6, 6)), np.ones(len(theta), dtype=bool)
    try:
        out[:] = eliminate(theta, q, spring)
    except np.linalg.LinAlgError:
        for k in range(len(theta)):
            try:
                out[k] = eliminate(theta[k], q[k], spring[k])
            except np.linalg.LinAlgError:
                regular[k] = False
    return out, regular & np.all(np.isfinite(out), axis=(-2, -1))


@lru_cache(maxsize=256)
def _lumped(leg: Leg) -> Built:
    """The leg as it is at rest: members lumped, parallelograms by the bar that stands for them."""
    return build(Leg(leg.name, tuple(map(_at_rest, leg.parts))))


def _at_rest(part: Part) -> Part:
    if isinstance(part, Parallelogram):
        return replace(part, bars="equivalent", segments=0)
    if isinstance(part, Elastic) and part.model != Lumped():
        return replace(part, model=Lumped())
    if isinstance(part, Fork):
        return replace(part, branches=tuple(tuple(map(_at_rest, branch)) for branch in part.branches))
    return part
