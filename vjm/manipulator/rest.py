"""Stiffness of a whole manipulator at rest, for many postures at once (Eq. 10 without load).

A parallelogram enters as its equivalent pseudo-rigid bar, which at rest is exact: between its two pins a bar keeps
the same 6x6 in its own frame at any angle q; only the levers to the middle of the linkage follow q.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from vjm.bars import X, Y, spring_joints
from vjm.chain import Chain, Element, Fixed, Joint, Role
from vjm.frames import Array, move_stiffness, rotation_y
from vjm.manipulator.freedom import undetermined
from vjm.manipulator.parts import (
    MOVING,
    Actuator,
    ElasticLink,
    Frame,
    Leg,
    Manipulator,
    Parallelogram,
    Part,
    Passive,
    Virtual,
)
from vjm.manipulator.posture import Postures
from vjm.stiffness import eliminate

SINGULAR = "has no stiffness that can be computed here"
"""Where a leg is neither rigid nor loose (`vjm.manipulator.freedom`) and its equations are singular still."""
_FREE = 2
_KEPT = [0, 1, 3, 4, 5]
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
    plan = _plan(leg)
    count = len(coordinates)
    x = np.zeros((count, plan.chain.size))
    x[:, plan.posture] = coordinates
    jacobian = plan.chain.jacobian(x)
    spring = np.broadcast_to(plan.stiffness, (count, *plan.stiffness.shape)).copy()
    for part, moving, first in plan.linkages:
        spring[:, first : first + 5, first : first + 5] = pseudo_rigid_springs(part, coordinates[:, moving])
    theta, q = jacobian[..., plan.virtual], jacobian[..., plan.passive]
    # A leg that moves without load overflows here and is found out below.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        out, regular = _eliminated(theta, q, spring)
    out[~regular] = 0.0
    size = np.sqrt(np.abs(np.diagonal(out, axis1=-2, axis2=-1)))
    unit = size[:, :, None] * size[:, None, :] + np.max(size, axis=-1)[:, None, None] ** 2 * 1e-9
    gap = np.max(np.abs(out - np.swapaxes(out, -1, -2)) / np.maximum(unit, 1e-300), axis=(-2, -1))
    regular &= gap < _ASYMMETRY
    return 0.5 * (out + np.swapaxes(out, -1, -2)), regular


def why_singular(leg: Leg, coordinates: Array, length: float) -> str:
    """What is wrong with a leg that has no stiffness at its coordinates (m,); length: a size of it, mm."""
    plan = _plan(leg)
    x = np.zeros(plan.chain.size)
    x[plan.posture] = coordinates
    shifts = np.array([joint.kind == "translation" for joint in plan.chain.joints])
    jacobian = plan.chain.jacobian(x) / np.repeat([length, 1.0], 3)[:, None] * np.where(shifts, length, 1.0)
    given = np.concatenate([plan.virtual, plan.passive])
    return undetermined(jacobian[:, given], np.isin(given, plan.passive)) or SINGULAR


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


def pseudo_rigid_springs(part: Parallelogram, q: Array) -> Array:
    """(..., 5, 5) stiffness of (x, y, rx, ry, rz) at the end of the linkage in the bar frame, bars at q (...), rad."""
    arm = np.einsum("...ji,j->...i", rotation_y(q), [0.0, 0.0, 0.5 * part.width])
    pinned = pinned_bar(part)
    whole = move_stiffness(pinned, arm) + move_stiffness(pinned, -arm)
    return np.asarray(whole[..., _KEPT, :][..., _KEPT])


def pinned_bar(part: Parallelogram) -> Array:
    """(6, 6) of one bar between its two pins, at the tip pin, bar frame; z and ry are free."""
    link = part.link
    at_tip = np.linalg.inv(np.linalg.inv(link.stiffness) + link.give)
    at_tip = 0.5 * (at_tip + at_tip.T)
    # Turning the base pin carries the tip along z; turning the tip pin turns it.
    free = np.array([[0.0, 0.0, -part.length, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]]).T
    spent = at_tip @ free
    left = at_tip - spent @ np.linalg.solve(free.T @ spent, spent.T)
    left[_FREE] = left[:, _FREE] = left[4] = left[:, 4] = 0.0
    return left


@dataclass(frozen=True, eq=False)
class _Plan:
    """A leg as one chain: coordinates of the posture, virtual and passive ones, springs (v, v), and each linkage
    with its place in the posture and the first of its five springs."""

    chain: Chain
    posture: np.ndarray
    virtual: np.ndarray
    passive: np.ndarray
    stiffness: Array
    linkages: tuple[tuple[Parallelogram, int, int], ...]


@lru_cache(maxsize=256)
def _plan(leg: Leg) -> _Plan:
    elements: list[Element] = []
    blocks: list[Array] = []
    linkages: list[tuple[Parallelogram, int, int]] = []
    posture: list[int] = []
    for number, part in enumerate(leg.parts):
        if isinstance(part, MOVING):
            posture.append(Chain(tuple(elements)).size)
        if isinstance(part, Parallelogram):
            linkages.append((part, len(posture) - 1, sum(len(b) for b in blocks)))
        added, springs = elastic_elements(part, f"q{number}")
        elements += added
        blocks += [springs] if len(springs) else []
    chain = Chain(tuple(elements))
    size = sum(len(b) for b in blocks)
    stiffness, at = np.zeros((size, size)), 0
    for block in blocks:
        stiffness[at : at + len(block), at : at + len(block)] = block
        at += len(block)
    roles = (chain.indices(Role.VIRTUAL), chain.indices(Role.PASSIVE))
    return _Plan(chain, np.array(posture, dtype=int), *roles, stiffness, tuple(linkages))


def elastic_elements(part: Part, tie: str) -> tuple[tuple[Element, ...], Array]:
    """Chain elements of a part and the stiffness (v, v) of its virtual joints, those of a linkage at q = 0."""
    match part:
        case Frame():
            return (Fixed(part.translation, part.rotation),), np.zeros((0, 0))
        case Actuator():
            joint = Joint(part.kind, part.axis, Role.ACTUATED)
            if part.stiffness is None:
                return (joint,), np.zeros((0, 0))
            return (joint, Joint(part.kind, part.axis, Role.VIRTUAL)), np.array([[part.stiffness]])
        case Passive():
            return (Joint(part.kind, part.axis, Role.PASSIVE),), np.zeros((0, 0))
        case Virtual():
            return (Joint(part.kind, part.axis, Role.VIRTUAL),), np.array([[part.stiffness]])
        case ElasticLink():
            return (Fixed(part.length * np.array(X)), *spring_joints()), part.stiffness
        case Parallelogram():
            virtual = spring_joints()
            free = Joint("translation", virtual[_FREE].axis, Role.PASSIVE)
            turned = Joint("rotation", Y, Role.ACTUATED, tie)
            back = Joint("rotation", Y, Role.ACTUATED, tie, -1.0)
            ahead = Fixed(part.length * np.array(X))
            springs = pseudo_rigid_springs(part, np.zeros(()))
            return (turned, ahead, free, *virtual[:_FREE], *virtual[_FREE + 1 :], back), springs
