"""A serial chain as data, and its pose, Jacobian and Hessian, all analytic and batched.

The chain is a product of fixed transforms and one-coordinate joints, as in Eq. 1 of the paper. Joints may be
tied, one coordinate moving several of them. Frames, units and the rotation vector are those of `vjm.frames`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array, inverse_rotation_jacobian, log, moment_gradient, skew


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

    @cached_property
    def turns(self) -> bool:
        """Whether it turns at all."""
        return not np.array_equal(self.rotation, np.eye(3))


@dataclass(frozen=True, eq=False)
class Joint:
    """One coordinate: translation along (mm) or rotation about (rad) a unit axis of its own frame.

    tie: joints of one chain with the same tie follow one coordinate, each moving by its share of it, as a
    rotation made half before and half after something else.
    """

    kind: Literal["translation", "rotation"]
    axis: tuple[float, float, float]
    role: Role
    tie: str | None = None
    share: float = 1.0

    def __post_init__(self) -> None:
        if abs(np.linalg.norm(self.axis) - 1.0) > 1e-12:
            raise ValueError(f"a joint axis must have length 1, got {self.axis}")

    @cached_property
    def generators(self) -> tuple[Array, Array]:
        """S = axis x and S², of Rodrigues' formula."""
        s = skew(self.axis)
        return s, s @ s

    @cached_property
    def along(self) -> int:
        """Number of the frame's own axis that the joint has, -1 for any other direction."""
        return next((i for i in range(3) if self.axis[i] == 1.0), -1)


Element = Fixed | Joint


@dataclass(frozen=True, eq=False)
class Tie:
    """How joints follow coordinates: joint values = share x coordinate.

    coordinate: (joints,) number of the coordinate that moves each joint. share: (joints,).
    """

    coordinate: np.ndarray
    share: Array

    @cached_property
    def matrix(self) -> Array:
        """(joints, n): joint values by the coordinates."""
        return self.share[:, None] * (self.coordinate[:, None] == np.arange(self.size))

    @property
    def size(self) -> int:
        """Number of coordinates n."""
        return int(self.coordinate.max(initial=-1)) + 1

    @cached_property
    def interleaved(self) -> tuple[tuple[slice, slice], ...]:
        """(joints, coordinates) of each run of joints within which coordinates alternate."""
        runs, start, first = [], 0, 0
        for end in range(1, self.coordinate.size + 1):
            seen = int(self.coordinate[:end].max()) + 1
            if np.any(self.coordinate[end:] < seen):
                continue
            if end - start > seen - first:
                runs.append((slice(start, end), slice(first, seen)))
            start, first = end, seen
        return tuple(runs)

    def fold(self, columns: Array) -> Array:
        """Columns (..., joints) by joint values turned into columns (..., n) by coordinates."""
        return columns @ self.matrix if self._folds else columns

    @cached_property
    def _folds(self) -> bool:
        return self.size < self.coordinate.size or bool(np.any(self.share != 1.0))


@dataclass(frozen=True, eq=False)
class Kinematics:
    """A chain at given coordinates: pose (..., 6), its Jacobian (..., 6, n), and Hessians on demand."""

    pose: Array
    jacobian: Array
    _linear: Array
    _angular: Array
    _rate: Array
    _tie: Tie

    def hessian(self, multiplier: ArrayLike) -> Array:
        """Second derivative (..., n, n) of Psi = pose^T lambda at fixed lambda (..., 6).

        A joint nearer the base carries those after it along: d²p/dx_i dx_j = w_i x v_j and
        dw_j/dx_i = w_i x w_j for i before j, v and w being columns of the spatial velocity Jacobian. With
        m = B(phi)^T mu and phi_dot = B omega this sums to w_i·z_j for i up to j,
        z = v x f + w x m + (dm/dphi B)^T w.
        """
        multiplier = np.asarray(multiplier, dtype=float)
        mu, w = multiplier[..., 3:], self._angular
        moment = np.einsum("...ji,...j->...i", self._rate, mu)
        slope = moment_gradient(self.pose[..., 3:], mu) @ self._rate
        z = (np.swapaxes(slope, -1, -2) - skew(moment)) @ w - skew(multiplier[..., :3]) @ self._linear
        tie = self._tie
        hessian = _ordered_product(tie.fold(w), tie.fold(z))
        for joints, coordinates in tie.interleaved:
            matrix = tie.matrix[joints, coordinates]
            block = _ordered_product(w[..., joints], z[..., joints])
            hessian[..., coordinates, coordinates] = matrix.T @ block @ matrix
        return hessian


@dataclass(frozen=True, eq=False)
class Chain:
    """Serial chain from the base frame to the platform point.

    elements: fixed transforms and joints, base first; coordinates are numbered in the order of the joints,
    a tied one where its first joint stands.
    reference: (3, 3) orientation of the last frame from which the rotation vector of the pose is measured.
    """

    elements: tuple[Element, ...]
    reference: Array = field(default_factory=lambda: np.eye(3))

    @cached_property
    def moved(self) -> tuple[Joint, ...]:
        """All joints, base first."""
        return tuple(e for e in self.elements if isinstance(e, Joint))

    @cached_property
    def tie(self) -> Tie:
        """Which coordinate moves which joint."""
        numbers: dict[str | int, int] = {}
        names = [k if joint.tie is None else joint.tie for k, joint in enumerate(self.moved)]
        coordinate = np.array([numbers.setdefault(name, len(numbers)) for name in names], dtype=int)
        return Tie(coordinate, np.array([joint.share for joint in self.moved]))

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """The first joint of every coordinate, which stands for its kind and role."""
        _, first = np.unique(self.tie.coordinate, return_index=True)
        return tuple(self.moved[k] for k in first)

    @property
    def size(self) -> int:
        """Number of coordinates n."""
        return self.tie.size

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
        tie = self.tie
        rotation, position, axes, origins = self._forward(x[..., tie.coordinate] * tie.share)
        turns = self._turns
        arms = np.where(turns, position[..., None] - origins, 0.0)
        linear = np.where(turns, _cross(axes, arms), axes)
        angular = np.where(turns, axes, 0.0)
        phi = log(rotation @ self.reference.T)
        rate = inverse_rotation_jacobian(phi)
        jacobian = tie.fold(np.concatenate([linear, rate @ angular], axis=-2))
        return Kinematics(np.concatenate([position, phi], axis=-1), jacobian, linear, angular, rate, tie)

    @cached_property
    def _turns(self) -> np.ndarray:
        return np.array([joint.kind == "rotation" for joint in self.moved], dtype=bool)

    def _forward(self, values: Array) -> tuple[Array, Array, Array, Array]:
        """Last rotation (..., 3, 3) and position (..., 3); joint axes and origins (..., 3, joints)."""
        batch, count = values.shape[:-1], values.shape[-1]
        rotation = np.broadcast_to(np.eye(3), (*batch, 3, 3))
        position = np.zeros((*batch, 3))
        axes, origins = np.empty((*batch, 3, count)), np.empty((*batch, 3, count))
        sine, versine = np.sin(values), 2.0 * np.sin(0.5 * values) ** 2
        k = 0
        for element in self.elements:
            if isinstance(element, Fixed):
                position = position + rotation @ element.translation
                if element.turns:
                    rotation = rotation @ element.rotation
                continue
            axis = axes[..., k] = (
                rotation[..., element.along] if element.along >= 0 else rotation @ element.axis
            )
            origins[..., k] = position
            if element.kind == "rotation":
                s, square = element.generators
                turn = np.eye(3) + sine[..., k, None, None] * s + versine[..., k, None, None] * square
                rotation = rotation @ turn
            else:
                position = position + axis * values[..., k, None]
            k += 1
        return rotation, position, axes, origins


def _cross(a: Array, b: Array) -> Array:
    """Cross products of the columns of (..., 3, n)."""
    x, y, z = a[..., 0, :], a[..., 1, :], a[..., 2, :]
    u, v, w = b[..., 0, :], b[..., 1, :], b[..., 2, :]
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=-2)


def _ordered_product(w: Array, z: Array) -> Array:
    """Symmetric (..., n, n) with the entries w_i·z_j, i up to j, of columns (..., 3, n)."""
    product = np.swapaxes(w, -1, -2) @ z
    return np.triu(product) + np.swapaxes(np.triu(product, 1), -1, -2)
