"""A serial chain as data, and its pose, Jacobian and Hessian, all analytic and batched.

The chain is a product of fixed transforms and one-coordinate joints, as in Eq. 1 of the paper. Frames, units
and the rotation vector are those of `vjm.frames`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array, inverse_rotation_jacobian, log, moment, moment_gradient, skew


class Role(Enum):
    """What sets a coordinate: nothing (passive joint), a drive (actuated) or a spring (virtual)."""

    PASSIVE = "passive"
    ACTUATED = "actuated"
    VIRTUAL = "virtual"


@dataclass(frozen=True, eq=False)
class Fixed:
    """Constant transform: translate by `translation` (3,), mm, then turn by `rotation` (3, 3)."""

    translation: Array = field(default_factory=lambda: np.zeros(3))
    rotation: Array = field(default_factory=lambda: np.eye(3))


@dataclass(frozen=True, eq=False)
class Joint:
    """One coordinate: translation along (mm) or rotation about (rad) a unit axis of its own frame."""

    kind: Literal["translation", "rotation"]
    axis: tuple[float, float, float]
    role: Role

    def __post_init__(self) -> None:
        if abs(np.linalg.norm(self.axis) - 1.0) > 1e-12:
            raise ValueError(f"a joint axis must have length 1, got {self.axis}")

    @cached_property
    def generator(self) -> Array:
        return skew(self.axis)

    def turn(self, angle: Array) -> Array:
        """Rotation (..., 3, 3) by the angle (...)."""
        s = self.generator
        angle = angle[..., None, None]
        return np.eye(3) + np.sin(angle) * s + 2.0 * np.sin(angle / 2) ** 2 * (s @ s)


Element = Fixed | Joint


@dataclass(frozen=True, eq=False)
class Kinematics:
    """A chain at given coordinates: pose (..., 6), its Jacobian (..., 6, n), and Hessians on demand."""

    pose: Array
    jacobian: Array
    _linear: Array
    _angular: Array

    def hessian(self, multiplier: ArrayLike) -> Array:
        """Second derivative (..., n, n) of Psi = pose^T lambda at fixed lambda (..., 6).

        A joint nearer the base carries those after it along: d²p/dx_i dx_j = w_i x v_j and
        dw_j/dx_i = w_i x w_j for i before j, v and w being columns of the spatial velocity Jacobian.
        """
        multiplier = np.asarray(multiplier, dtype=float)
        force, phi = multiplier[..., :3], self.pose[..., 3:]
        w, v = self._angular, self._linear
        turning = moment(phi, multiplier[..., 3:])
        position = np.swapaxes(w, -1, -2) @ (-skew(force) @ v)
        orientation = np.swapaxes(w, -1, -2) @ (-skew(turning) @ w)
        ordered = np.triu(position) + np.swapaxes(np.triu(position, 1), -1, -2)
        slope = np.swapaxes(w, -1, -2) @ moment_gradient(phi, multiplier[..., 3:]) @ self.jacobian[..., 3:, :]
        # slope[j, i] + orientation[i, j] (i < j) is symmetric as a sum only; the upper triangle is mirrored.
        upper = np.triu(np.swapaxes(slope, -1, -2) + np.triu(orientation, 1))
        return ordered + upper + np.swapaxes(np.triu(upper, 1), -1, -2)


@dataclass(frozen=True, eq=False)
class Chain:
    """Serial chain from the base frame to the platform point.

    elements: fixed transforms and joints, base first; coordinates are numbered in the order of the joints.
    reference: (3, 3) orientation of the last frame from which the rotation vector of the pose is measured.
    """

    elements: tuple[Element, ...]
    reference: Array = field(default_factory=lambda: np.eye(3))

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        return tuple(e for e in self.elements if isinstance(e, Joint))

    @property
    def size(self) -> int:
        """Number of coordinates n."""
        return len(self.joints)

    def indices(self, *roles: Role) -> np.ndarray:
        """Numbers of the coordinates that have one of the roles."""
        return np.array([k for k, joint in enumerate(self.joints) if joint.role in roles], dtype=int)

    def pose(self, coordinates: ArrayLike) -> Array:
        """(p, phi) (..., 6) of the last frame; coordinates (..., n)."""
        return self.kinematics(coordinates).pose

    def jacobian(self, coordinates: ArrayLike) -> Array:
        """Derivative of (p, phi) by the coordinates: (..., 6, n)."""
        return self.kinematics(coordinates).jacobian

    def hessian(self, coordinates: ArrayLike, multiplier: ArrayLike) -> Array:
        """Second derivative of Psi = pose^T lambda by the coordinates: (..., n, n)."""
        return self.kinematics(coordinates).hessian(multiplier)

    def kinematics(self, coordinates: ArrayLike) -> Kinematics:
        """One forward pass for pose, Jacobian and Hessian. ValueError if the last axis is not n long."""
        x = np.asarray(coordinates, dtype=float)
        if x.shape[-1] != self.size:
            raise ValueError(f"this chain has {self.size} coordinates, got an array of shape {x.shape}")
        rotation, position, axes, origins = self._forward(x)
        turns = np.array([joint.kind == "rotation" for joint in self.joints])
        arms = np.where(turns, position[..., None] - origins, 0.0)
        linear = np.where(turns, np.cross(axes, arms, axis=-2), axes)
        angular = np.where(turns, axes, 0.0)
        phi = log(rotation @ self.reference.T)
        jacobian = np.concatenate([linear, inverse_rotation_jacobian(phi) @ angular], axis=-2)
        return Kinematics(np.concatenate([position, phi], axis=-1), jacobian, linear, angular)

    def _forward(self, x: Array) -> tuple[Array, Array, Array, Array]:
        """Last rotation (..., 3, 3) and position (..., 3); joint axes and origins (..., 3, n), base frame."""
        batch = x.shape[:-1]
        rotation = np.broadcast_to(np.eye(3), (*batch, 3, 3))
        position = np.zeros((*batch, 3))
        axes, origins = np.empty((*batch, 3, self.size)), np.empty((*batch, 3, self.size))
        k = 0
        for element in self.elements:
            if isinstance(element, Fixed):
                position = position + rotation @ element.translation
                rotation = rotation @ element.rotation
                continue
            axes[..., k] = rotation @ np.asarray(element.axis)
            origins[..., k] = position
            if element.kind == "rotation":
                rotation = rotation @ element.turn(x[..., k])
            else:
                position = position + axes[..., k] * x[..., k, None]
            k += 1
        return rotation, position, axes, origins
