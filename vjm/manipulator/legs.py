"""Legs one by one: the force that each takes of a load on the platform, and the force at which it buckles.

For sweeps over many postures. The critical force of a leg is that between its base and a held platform; how far the
platform and the other legs give way under it is left out, which costs a few per cent (`vjm.manipulator.buckling`
follows the whole).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from vjm.equilibrium import Equilibrium, unloaded
from vjm.frames import POSE_NAMES, Array
from vjm.lagrangian import layout
from vjm.manipulator.buckling import linear_factor, linear_path
from vjm.manipulator.freedom import undetermined
from vjm.manipulator.machine import machine, posture_inputs
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import Postures
from vjm.manipulator.rest import RestStiffness
from vjm.parts import Elastic, Fork, Frame, Leg, Part, Passive
from vjm.refined import Refined
from vjm.stability import scaled_hessian

SEGMENTS = 4
"""Segments that stand for a bar that buckles: its critical load is then good to 0.1 %."""


@dataclass(frozen=True, eq=False)
class Shares:
    """How legs share a force on the platform, batched over leading axes.

    direction: (..., legs, 3) unit vector of the force that each leg carries, from its base to the platform.
    force: (..., legs, 3) a: pull along it = a · force on the platform, platform free to turn. regular: (...) of bool.
    """

    direction: Array
    force: Array
    regular: np.ndarray


def shares(manipulator: Manipulator, at: Postures, stiffness: RestStiffness) -> Shares:
    """Shares at postures; zeros where the stiffness is not found or singular.

    A leg's direction is that of its largest translational stiffness.
    """
    by_leg, batch = stiffness.by_leg, stiffness.found.shape
    total = stiffness.total
    length = manipulator.length
    scale = np.repeat([1.0, 1.0 / length], 3)
    unit = total * scale[:, None] * scale
    values = np.linalg.eigvalsh(unit)
    regular = stiffness.found & (values[..., 0] > 1e-12 * values[..., -1])
    safe = np.where(regular[..., None, None], unit, np.eye(6))
    compliance = scale[:, None] * np.linalg.inv(safe) * scale
    _, vectors = np.linalg.eigh(by_leg[..., :3, :3])
    direction = vectors[..., -1]
    ahead = at.pose[..., None, :3] - _bases(manipulator, batch)
    sign = np.sign(np.sum(direction * ahead, axis=-1))
    direction = direction * np.where(sign == 0.0, 1.0, sign)[..., None]
    pull = np.einsum("...ni,...nij,...jk->...nk", direction, by_leg[..., :3, :], compliance[..., :3])
    pull = np.where(regular[..., None, None], pull, 0.0)
    return Shares(direction, pull, np.asarray(regular))


def _bases(manipulator: Manipulator, batch: tuple[int, ...]) -> Array:
    """(..., legs, 3) where each leg starts: the end of a rigid first part, else the base origin."""
    points = []
    for leg in manipulator.legs:
        first = leg.parts[0] if leg.parts else None
        points.append(first.translation if isinstance(first, Frame) else np.zeros(3))
    return np.broadcast_to(np.stack(points), (*batch, len(points), 3))


def segmented(leg: Leg, segments: int = SEGMENTS) -> Leg:
    """The leg with geometric stiffness in what may buckle: parallelograms, members of forks, and those between passive
    joints."""
    return replace(leg, parts=_segmented(leg.parts, segments))


def _segmented(parts: tuple[Part, ...], segments: int, forked: bool = False) -> tuple[Part, ...]:
    jointed = [isinstance(part, Passive) for part in parts]
    return tuple(
        _in_segments(part, segments, forked or (any(jointed[:k]) and any(jointed[k:])))
        for k, part in enumerate(parts)
    )


def _in_segments(part: Part, segments: int, may_buckle: bool) -> Part:
    if isinstance(part, Parallelogram):
        count = part.segments or segments
        built = None if part.built is None else replace(part.built, model=Refined(count))
        return replace(part, bars="pair", segments=count, built=built)
    if isinstance(part, Fork):
        return replace(part, branches=tuple(_segmented(b, segments, forked=True) for b in part.branches))
    if not isinstance(part, Elastic) or not may_buckle or not part.link.length:
        return part
    return part if isinstance(part.model, Refined) else replace(part, model=Refined(segments))


@dataclass(frozen=True, eq=False)
class CriticalForces:
    """Compression at which each leg buckles.

    force: (B, legs) N, positive; inf: the leg does not buckle to first order; nan: it cannot be found. reason:
    (B, legs) of strings, what the leg "is" or "has" that there is none; empty where there is one.
    """

    force: Array
    reason: np.ndarray


UNSOLVED = "has equations of buckling that cannot be solved here"
"""Where a leg is neither rigid nor loose (`vjm.manipulator.freedom`) and its buckling problem is singular still."""


def critical_forces(
    manipulator: Manipulator, at: Postures, direction: Array, segments: int = SEGMENTS
) -> CriticalForces:
    """The compression at which each leg buckles at postures (B,) with the platform held.

    direction: (B, legs, 3) of `Shares`. A leg that is rigid in some direction, or that moves while its ends are held,
    has none, nor has a posture that is not reached.
    """
    shape = (len(at.pose), len(manipulator.legs))
    force, reason = np.full(shape, np.nan), np.full(shape, "", dtype=object)
    for number, leg in enumerate(manipulator.legs):
        alone = Manipulator(leg.name, (segmented(leg, segments),), manipulator.length)
        for member in range(len(at.pose)):
            if not at.reached[member]:
                reason[member, number] = str(at.reason[member])
                continue
            one = at.take(member)
            here = Postures(one.pose, (one.coordinates[number],), one.reached, one.reason)
            start = unloaded(machine(alone), posture_inputs(here))
            push = np.concatenate([-direction[member, number], np.zeros(3)])
            force[member, number], reason[member, number] = _critical_force(start, push)
    return CriticalForces(force, reason)


def _critical_force(start: Equilibrium, push: Array) -> tuple[float, str]:
    """Compression at which a leg buckles when its end is moved along `push`, or nan and what is wrong with the leg."""
    why = _undetermined(start)
    if why:
        return np.nan, why
    try:
        (load,) = layout(start.mechanism).multipliers
        force = linear_path(start, push, np.ones(6, dtype=bool))[load][:3] @ push[:3]
        return float(force) * linear_factor(start, push, POSE_NAMES), ""
    except np.linalg.LinAlgError:
        return np.nan, UNSOLVED


def _undetermined(start: Equilibrium) -> str:
    """What is wrong with a mechanism of one leg while its platform is held; "" if nothing is."""
    place, matrix = layout(start.mechanism), scaled_hessian(start)
    closing, moving = np.arange(place.platform.stop, place.size), np.arange(place.platform.start)
    return undetermined(matrix[np.ix_(closing, moving)], matrix[moving, moving] == 0.0)
