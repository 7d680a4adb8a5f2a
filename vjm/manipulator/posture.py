"""Inverse kinematics: the coordinates of every leg that bring the unloaded platform to given poses.

The springs of a leg are locked and its end and its loops closed, leg by leg, by Newton's method in the least-squares
sense from home, for all poses at once; a parallelogram is a rotation of its bars that its end does not follow.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from vjm.built_leg import Built
from vjm.frames import Array
from vjm.leg_chain import build
from vjm.manipulator.parts import Manipulator
from vjm.parts import Leg

TOLERANCE = 1e-11
"""Gap of a leg that counts as closed: over the manipulator's length, and rad."""
ITERATIONS = 60
UNREACHED = "leg {} does not reach this pose"
BEYOND = "the actuator of leg {} is beyond its limits"
# Relative to the largest stiffness of a step: coordinates that move nothing stay where they are.
_DAMPING = 1e-13
_LONGEST = 0.3


@dataclass(frozen=True, eq=False)
class Postures:
    """Where the joints stand, batched over leading axes.

    pose: (..., 6) of the platform. coordinates: per leg (..., m). reached: (...) of bool; reason: (...) of strings,
    empty where reached. Where not reached the coordinates are none of that pose.
    """

    pose: Array
    coordinates: tuple[Array, ...]
    reached: np.ndarray
    reason: np.ndarray

    def take(self, members: np.ndarray | slice | int | None) -> Postures:
        """Some members of the batch; None: all, with one batch axis more."""
        parts = tuple(x[members] for x in self.coordinates)
        reason = np.asarray(self.reason[members], dtype=object)
        return Postures(self.pose[members], parts, np.asarray(self.reached[members]), reason)


def postures(manipulator: Manipulator, poses: ArrayLike) -> Postures:
    """The joints at platform poses (..., 6), or (..., 3) for points at the orientation of the base frame.

    ValueError for another last axis or numbers that are not finite.
    """
    pose = np.asarray(poses, dtype=float)
    if pose.ndim == 0 or pose.shape[-1] not in (3, 6) or not np.all(np.isfinite(pose)):
        raise ValueError(
            f"poses must be finite, three or six numbers on the last axis, got shape {pose.shape}"
        )
    if pose.shape[-1] == 3:
        pose = np.concatenate([pose, np.zeros_like(pose)], axis=-1)
    batch = pose.shape[:-1]
    flat = pose.reshape(-1, 6)
    reason = np.full(len(flat), "", dtype=object)
    coordinates = []
    for leg in manipulator.legs:
        x, gap = _closed(leg, flat, manipulator.length)
        reason[(reason == "") & ~(gap <= TOLERANCE)] = UNREACHED.format(leg.name)
        for k, each in enumerate(leg.posture):
            beyond = (x[:, k] < each.limits[0]) | (x[:, k] > each.limits[1])
            reason[(reason == "") & beyond] = BEYOND.format(leg.name)
        coordinates.append(x.reshape(*batch, x.shape[-1]))
    said = np.reshape(reason, batch)
    return Postures(pose, tuple(coordinates), np.asarray(said == ""), said)


def _closed(leg: Leg, pose: Array, length: float) -> tuple[Array, Array]:
    """Coordinates (B, m) of a leg and what is left of its gap (B,)."""
    rigid = rigid_leg(leg)
    chain, slopes = rigid.chain, rigid.posture.T
    # Without branches that move together the coordinates are those of the posture.
    own = np.array_equal(slopes, np.eye(chain.size))
    x = np.tile(leg.home, (len(pose), 1))
    gap = np.full(len(pose), np.inf)
    scale = np.tile(np.repeat([1.0 / length, 1.0], 3), chain.closures // 6)
    size = np.array([1.0 if each.kind == "rotation" else length for each in leg.posture])
    aim = np.zeros((len(pose), chain.closures))
    aim[:, :6] = pose
    active = np.arange(len(pose))
    for _ in range(ITERATIONS):
        ends, by = chain.close(x[active] if own else x[active] @ slopes.T)
        error = (aim[active] - ends) * scale
        gap[active] = np.max(np.abs(error), axis=-1)
        jacobian = (by if own else by @ slopes) * scale[:, None] * size
        normal = np.swapaxes(jacobian, -1, -2) @ jacobian
        largest = np.max(np.abs(normal), axis=(-2, -1), initial=1e-300)
        normal += (_DAMPING * largest)[:, None, None] * np.eye(x.shape[-1])
        step = np.linalg.solve(normal, np.swapaxes(jacobian, -1, -2) @ error[..., None])[..., 0]
        longest = np.max(np.abs(step), axis=-1, initial=_LONGEST)
        x[active] += step * size * (_LONGEST / longest)[:, None]
        active = active[~(gap[active] <= TOLERANCE)]
        if not active.size:
            break
    return x, gap


@lru_cache(maxsize=256)
def rigid_leg(leg: Leg) -> Built:
    """The leg without its elasticity: its coordinates are those of its joints."""
    return build(leg, rigid=True)
