"""Linkages of solid bars: every bar's base face on the ground, its tip face on one rigid platform.

A face is rigid; it is clamped to its body or pinned to it by a hinge whose axis is fixed in that body. All
vectors are in the base frame (x along the unloaded bars at q = 0, y normal to the plane of the linkage), the
mesh of a bar is in the bar's own frame.
"""

from dataclasses import dataclass

import numpy as np

from fem.rotation import rotation
from fem.space import Space
from meshes.solid import Floats

PLATFORM = ("x", "y", "z", "rx", "ry", "rz")
Y_AXIS = (0.0, 1.0, 0.0)
Axis = tuple[float, float, float]


@dataclass(frozen=True)
class Member:
    """One bar.

    space     : displacement space of its mesh
    origin    : (3,) base-frame position of the middle of its base face, mm
    turn      : (3, 3) rotation from the bar's frame to the base frame, unloaded
    tip_middle : (3,) middle of its tip face in the bar's frame, mm
    base_axis, tip_axis : hinge axis of the face, or None where it is clamped
    """

    space: Space
    origin: Floats
    turn: Floats
    tip_middle: Floats
    base_axis: Axis | None = None
    tip_axis: Axis | None = None

    @property
    def tip(self) -> Floats:
        """Base-frame position of the middle of the tip face, mm."""
        return self.origin + self.turn @ self.tip_middle


@dataclass(frozen=True)
class Linkage:
    """Bars between ground and platform; `point` is the platform point in the base frame, mm."""

    members: tuple[Member, ...]
    point: Floats

    @property
    def hinges(self) -> int:
        """Number of hinge coordinates."""
        return sum((m.base_axis is not None) + (m.tip_axis is not None) for m in self.members)

    @property
    def dofs(self) -> int:
        """Displacement unknowns of all meshes."""
        return sum(m.space.dofs for m in self.members)


def single_bar(space: Space, length: float, pinned: bool = False) -> Linkage:
    """One bar from the origin along x, both faces clamped or both pinned about y."""
    axis = Y_AXIS if pinned else None
    member = Member(space, np.zeros(3), np.eye(3), np.array([length, 0.0, 0.0]), axis, axis)
    return Linkage((member,), member.tip)


def parallelogram(space: Space, length: float, width: float, q: float) -> Linkage:
    """Two equal bars at z = ∓width/2, pinned about y at both ends, turned by R_y(q), q in rad."""
    turn = rotation(np.array([0.0, q, 0.0]))
    along = np.array([length, 0.0, 0.0])
    members = tuple(
        Member(space, np.array([0.0, 0.0, eta * width / 2]), turn, along, Y_AXIS, Y_AXIS)
        for eta in (-1.0, 1.0)
    )
    return Linkage(members, turn @ along)
