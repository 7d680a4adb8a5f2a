"""A serial chain as data, and its pose, Jacobian and Hessian, all analytic and batched.

The chain is a product of fixed transforms and one-coordinate joints, as in Eq. 1 of the paper. Joints may be
tied, one coordinate moving several of them. Frames, units and the rotation vector are those of `vjm.frames`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from vjm import kernels
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
    def steps(self) -> tuple[tuple[int, float], ...]:
        """The translation as steps along some of the axes."""
        return tuple((i, float(part)) for i, part in enumerate(self.translation) if part)

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
        # Not by numpy: there are thousands of joints, and for three numbers its call takes longer than the rest.
        if not abs(math.hypot(*self.axis) - 1.0) <= 1e-12:
            raise ValueError(f"a joint axis must have length 1, got {self.axis}")

    @cached_property
    def along(self) -> int:
        """Number of the frame's own axis that the joint has, -1 for any other direction."""
        return next((i for i in range(3) if self.axis[i] == 1.0), -1)


Element = Fixed | Joint


def tied_apart(elements: tuple[Element, ...], name: str) -> tuple[Element, ...]:
    """The elements with the name before all their ties, so that they share no coordinate with others of a chain."""
    return tuple(
        replace(e, tie=f"{name}:{e.tie}") if isinstance(e, Joint) and e.tie is not None else e
        for e in elements
    )


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
        if not self._folds:
            return columns
        return (columns.reshape(-1, columns.shape[-1]) @ self.matrix).reshape(*columns.shape[:-1], self.size)

    @cached_property
    def _folds(self) -> bool:
        return self.size < self.coordinate.size or bool(np.any(self.share != 1.0))


@dataclass(frozen=True, eq=False)
class Mark:
    """A point of a chain: `offset` (3,), mm, in the frame after so many of its elements."""

    elements: int
    offset: Array

    def joints(self, chain: Chain) -> int:
        """Number of the joints that move it."""
        return sum(isinstance(e, Joint) for e in chain.elements[: self.elements])


@dataclass(frozen=True, eq=False)
class Kinematics:
    """A chain at given coordinates: its pose (..., 6); Jacobian and Hessian on demand.

    axes, origins: (3, joints, ...) of the joints. places: (3, s, ...) of the marks. turns: (joints,) that turn.
    """

    pose: Array
    axes: Array
    origins: Array
    places: Array
    turns: np.ndarray
    tie: Tie

    @cached_property
    def jacobian(self) -> Array:
        """(..., 6, n) of pose by the coordinates."""
        return self.tie.fold(np.concatenate([self._linear, self._rate @ self._angular], axis=-2))

    def pull(self, multiplier: Array) -> Array:
        """Jacobian^T lambda (..., n) of lambda (..., 6), without the Jacobian."""
        force = np.moveaxis(multiplier[..., :3], -1, 0)[:, None]
        moment = np.einsum("...ji,...j->...i", self._rate, multiplier[..., 3:])
        place, turns = np.moveaxis(self.pose[..., :3], -1, 0)[:, None], self.turns
        along = np.empty(self.axes.shape[1:])
        along[~turns] = np.sum(self.axes[:, ~turns] * force, axis=0)
        whole = _cross(place - self.origins[:, turns], force) + np.moveaxis(moment, -1, 0)[:, None]
        along[turns] = np.sum(self.axes[:, turns] * whole, axis=0)
        return self.tie.fold(np.ascontiguousarray(np.moveaxis(along, 0, -1)))

    @cached_property
    def _rate(self) -> Array:
        return inverse_rotation_jacobian(self.pose[..., 3:])

    @cached_property
    def _linear(self) -> Array:
        """(..., 3, joints) velocity of the platform point."""
        linear, turns = self.axes.copy(), self.turns
        place = np.moveaxis(self.pose[..., :3], -1, 0)[:, None]
        linear[:, turns] = _cross(linear[:, turns], place - self.origins[:, turns])
        return _columns(linear)

    @cached_property
    def _angular(self) -> Array:
        """(..., 3, joints) spatial angular velocity."""
        angular = self.axes.copy()
        angular[:, ~self.turns] = 0.0
        return _columns(angular)

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
        return self.second(z)

    def second(self, z: Array) -> Array:
        """Symmetric (..., n, n) by the coordinates of what is w_i·z_j for joints i up to j; z (..., 3, joints)."""
        tie, w = self.tie, self._angular
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
        x = self._checked(coordinates)
        out = np.empty((*x.shape[:-1], 6))
        kernels.poses(self.program, flat(x), out.reshape(-1, 6))
        return out

    def jacobian(self, coordinates: ArrayLike) -> Array:
        """Derivative of (p, phi) by the coordinates: (..., 6, n)."""
        return self.kinematics(coordinates).jacobian

    def hessian(self, coordinates: ArrayLike, multiplier: ArrayLike) -> Array:
        """Second derivative of Psi = pose^T lambda by the coordinates: (..., n, n)."""
        return self.kinematics(coordinates).hessian(multiplier)

    def kinematics(self, coordinates: ArrayLike, marks: tuple[Mark, ...] = ()) -> Kinematics:
        """One forward pass for pose, Jacobian, Hessian and the places of marks, those nearer the base first.

        ValueError if the last axis is not n long.
        """
        x = self._checked(coordinates)
        rotation, position, axes, origins, places = self._forward(
            x[..., self.tie.coordinate] * self.tie.share, marks
        )
        phi = log(rotation @ self.reference.T)
        pose = np.concatenate([position, phi], axis=-1)
        return Kinematics(pose, axes, origins, places, self._turns, self.tie)

    def _checked(self, coordinates: ArrayLike) -> Array:
        x = np.asarray(coordinates, dtype=float)
        if x.shape[-1] != self.size:
            raise ValueError(f"this chain has {self.size} coordinates, got an array of shape {x.shape}")
        return x

    @cached_property
    def program(self) -> kernels.Program:
        """The chain as compiled functions read it."""
        kinds, vectors = [], []
        rotations = np.zeros((len(self.elements), 3, 3))
        for k, element in enumerate(self.elements):
            if isinstance(element, Joint):
                kinds.append(kernels.TURN if element.kind == "rotation" else kernels.SLIDE)
                # An axis that is one of the frame's to rounding is that one in all that follows.
                along = element.along
                vectors.append(element.axis if along < 0 else tuple(float(along == i) for i in range(3)))
            else:
                kinds.append(kernels.FIXED if element.turns else kernels.SHIFT)
                vectors.append(tuple(element.translation.tolist()))
                rotations[k] = element.rotation
        return kernels.Program(
            np.array(kinds, dtype=np.int64),
            np.array([e.along if isinstance(e, Joint) else -1 for e in self.elements], dtype=np.int64),
            np.array(vectors, dtype=float).reshape(-1, 3),
            rotations,
            self.tie.coordinate.astype(np.int64),
            self.tie.share.astype(float),
            self._turns,
            np.array(self.reference, dtype=float, order="C"),
        )

    @cached_property
    def _turns(self) -> np.ndarray:
        return np.array([joint.kind == "rotation" for joint in self.moved], dtype=bool)

    def _forward(self, values: Array, marks: tuple[Mark, ...]) -> tuple[Array, Array, Array, Array, Array]:
        """Last rotation (..., 3, 3) and position (..., 3); joint axes and origins (3, joints, ...), places of marks.

        Batch axes stand last: short products of small matrices cost more than the arithmetic in them.
        """
        batch, each = values.shape[:-1], np.ascontiguousarray(np.moveaxis(values, -1, 0))
        frame = np.broadcast_to(np.eye(3).reshape(3, 3, *[1] * len(batch)), (3, 3, *batch)).copy()
        position: Array = np.zeros((3, *batch))
        axes, origins = np.empty((2, 3, len(each), *batch))
        sine, cosine = np.sin(each), np.cos(each)
        places, waiting = np.empty((3, len(marks), *batch)), list(enumerate(marks))
        k = 0
        for number, element in enumerate(self.elements):
            while waiting and waiting[0][1].elements == number:
                m, mark = waiting.pop(0)
                places[:, m] = position + _along(mark.offset, frame)
            if isinstance(element, Fixed):
                for i, part in element.steps:
                    position = position + part * frame[i]
                if element.turns:
                    frame = _along(element.rotation.T, frame)
                continue
            axis = frame[element.along] if element.along >= 0 else _along(np.asarray(element.axis), frame)
            axes[:, k], origins[:, k] = axis, position
            if element.kind == "translation":
                position = position + axis * each[k]
            elif element.along >= 0:
                i, j = (element.along + 1) % 3, (element.along + 2) % 3
                swung = sine[k] * frame[i]
                frame[i] = cosine[k] * frame[i] + sine[k] * frame[j]
                frame[j] = cosine[k] * frame[j] - swung
            else:
                # Rodrigues' formula, on each of the frame's own axes.
                for own, part in zip(frame, element.axis, strict=True):
                    own[:] = cosine[k] * own + sine[k] * _cross(axis, own) + (1.0 - cosine[k]) * part * axis
            k += 1
        for m, mark in waiting:
            places[:, m] = position + _along(mark.offset, frame)
        rotation = np.moveaxis(frame, (0, 1), (-1, -2))
        return np.ascontiguousarray(rotation), np.moveaxis(position, 0, -1), axes, origins, places


def flat(rows: Array) -> Array:
    """(..., n) as a contiguous (B, n) of floats that can be written to, as compiled functions are made for."""
    whole = np.require(rows, dtype=float, requirements=("C", "W"))
    return whole.reshape(math.prod(rows.shape[:-1]), rows.shape[-1])


def _along(vectors: Array, frame: Array) -> Array:
    """Vectors (..., 3) of a frame, whose axes are (3, 3, batch), in base axes (..., 3, batch)."""
    return np.tensordot(vectors, frame, 1)


def _cross(a: Array, b: Array) -> Array:
    """Cross products of (3, ...)."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def _columns(vectors: Array) -> Array:
    """(3, n, ...) as (..., 3, n)."""
    return np.ascontiguousarray(np.moveaxis(vectors, (0, 1), (-2, -1)))


def _ordered_product(w: Array, z: Array) -> Array:
    """Symmetric (..., n, n) with the entries w_i·z_j, i up to j, of columns (..., 3, n)."""
    product = np.swapaxes(w, -1, -2) @ z
    upper = np.arange(w.shape[-1])[:, None] <= np.arange(w.shape[-1])
    return np.where(upper, product, np.swapaxes(product, -1, -2))
