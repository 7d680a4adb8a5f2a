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
from vjm.frames import Array, flat
from vjm.program import Program


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

    @property
    def size(self) -> int:
        """Number of coordinates n."""
        return int(self.coordinate.max(initial=-1)) + 1


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
    """A chain at given coordinates, under a multiplier lambda of its pose.

    pose: (..., 6). jacobian: (..., 6, n) of it by the coordinates. pull: (..., n) jacobian^T lambda. hessian:
    (..., n, n) second derivative of pose^T lambda at fixed lambda.
    """

    pose: Array
    jacobian: Array
    pull: Array
    hessian: Array


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

    def kinematics(self, coordinates: ArrayLike, multiplier: ArrayLike = 0.0) -> Kinematics:
        """Pose and derivatives at coordinates (..., n) under a multiplier (..., 6), default none.

        ValueError if the last axis is not n long.
        """
        x, dual = self._checked(coordinates), np.asarray(multiplier, dtype=float)
        batch, n = np.broadcast_shapes(x.shape[:-1], dual.shape[:-1]), self.size
        x, dual = flat(np.broadcast_to(x, (*batch, n))), flat(np.broadcast_to(dual, (*batch, 6)))
        pose, pull, matrix = np.zeros(dual.shape), np.zeros(x.shape), np.zeros((len(x), n + 6, n + 6))
        kernels.close(self.program, np.arange(n), x, dual, 0, 1.0, n, pose, pull, matrix)
        parts = (pose, matrix[:, n:, :n], pull, matrix[:, :n, :n])
        return Kinematics(*(part.reshape(*batch, *part.shape[1:]) for part in parts))

    def _checked(self, coordinates: ArrayLike) -> Array:
        x = np.asarray(coordinates, dtype=float)
        if x.shape[-1] != self.size:
            raise ValueError(f"this chain has {self.size} coordinates, got an array of shape {x.shape}")
        return x

    @cached_property
    def program(self) -> Program:
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
        return Program(
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
