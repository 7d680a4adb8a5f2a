"""What a leg is made of, from the base to the platform; each part starts in the frame where the one before it ends.

Frames, units and orders are those of `vjm.frames`. Where its parts stand before any load is the posture of a leg: one
coordinate, mm or rad, for each axis of an actuator or a passive joint, in the order of the parts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, Protocol

import numpy as np

from vjm import checks
from vjm.bars import BarModel, X, Y, Z, spring_joints
from vjm.chain import Chain, Fixed, Joint, Role
from vjm.frames import Array
from vjm.laws import Law
from vjm.link import Link
from vjm.lumped import Lumped
from vjm.mechanism import rank
from vjm.refined import Refined
from vjm.site_joint import SiteJoint

Kind = Literal["translation", "rotation"]
_NOWHERE, _STRAIGHT = np.zeros(3), np.eye(3)
_NOWHERE.flags.writeable = _STRAIGHT.flags.writeable = False
_ASIDE = 0.07
"""rad or mm."""
Direction = tuple[float, float, float]


@dataclass(frozen=True)
class Coordinate:
    """A coordinate of the posture: mm for a translation, rad for a rotation.

    home: where inverse kinematics starts. limits: lowest and highest. driven: whether a drive sets it.
    """

    kind: Kind
    home: float = 0.0
    limits: tuple[float, float] = (-np.inf, np.inf)
    driven: bool = False


@dataclass(frozen=True, eq=False)
class Frame:
    """Rigid link: translate by (3,), mm, then turn by (3, 3)."""

    translation: Array = field(default_factory=lambda: _NOWHERE)
    rotation: Array = field(default_factory=lambda: _STRAIGHT)


@dataclass(frozen=True)
class Actuator:
    """Actuated joint along or about a unit axis.

    stiffness: of drive and transmission, N/mm or N·mm/rad; None: rigid. home, limits: see `Coordinate`.
    """

    kind: Kind
    axis: Direction
    stiffness: float | None = None
    home: float = 0.0
    limits: tuple[float, float] = (-np.inf, np.inf)

    @property
    def posture(self) -> tuple[Coordinate, ...]:
        """Its one coordinate."""
        return (Coordinate(self.kind, self.home, self.limits, driven=True),)


@dataclass(frozen=True)
class Axis:
    """One axis of a passive joint, along or about a unit direction in the frame that the axis before it has moved.

    laws: what acts along or about it, relaxed at its coordinate in the posture; none for a perfect joint.
    """

    kind: Kind
    direction: Direction
    laws: tuple[Law, ...] = ()
    home: float = 0.0


@dataclass(frozen=True)
class Passive:
    """Passive joint of one to three axes, one after the other. ValueError for another number."""

    axes: tuple[Axis, ...]

    def __post_init__(self) -> None:
        if not 1 <= len(self.axes) <= 3:
            raise ValueError(f"a passive joint has one to three axes, got {len(self.axes)}")

    @property
    def posture(self) -> tuple[Coordinate, ...]:
        """One coordinate for each axis."""
        return tuple(Coordinate(axis.kind, axis.home) for axis in self.axes)


@dataclass(frozen=True)
class Virtual:
    """One-coordinate spring along or about a unit axis; stiffness N/mm or N·mm/rad."""

    kind: Kind
    axis: Direction
    stiffness: float


@dataclass(frozen=True, eq=False)
class Elastic:
    """Elastic member along x, from where the part begins to its tip.

    link: the member as built, of length 0 for a notch, a bearing or a clamp. model: how its elasticity becomes part of
    the chain (`vjm.lumped`, `vjm.refined`). line_load: (3,) N/mm along it, base frame. straight: length that rigid
    kinematics goes by, mm, if not that of the link.
    """

    link: Link
    model: BarModel = field(default_factory=Lumped)
    line_load: Array = field(default_factory=lambda: np.zeros(3))
    straight: float | None = None

    @property
    def drawn(self) -> float:
        """Length for rigid kinematics, mm."""
        return self.link.length if self.straight is None else self.straight


@dataclass(frozen=True, eq=False)
class Swinging:
    """One pseudo-rigid bar that swings about y while its end keeps its orientation; it gives in all but z and ry.

    length: mm. springs: (..., 5, 5) stiffness of (x, y, rx, ry, rz) at its end in the bar frame, at angles (...), rad;
    ry there is a turn of the end against the bar.
    """

    length: float
    springs: Callable[[Array], Array]
    home: float = 0.0

    @property
    def posture(self) -> tuple[Coordinate, ...]:
        """Its angle."""
        return (Coordinate("rotation", self.home),)


@dataclass(frozen=True, eq=False)
class Tie:
    """A law on a sum of turns or shifts in a fork, relaxed in the posture, as of a spring between two branches.

    shares: by (branch, axis among those of its passive joints), both counted from 0, the share in the sum.
    """

    shares: tuple[tuple[tuple[int, int], float], ...]
    law: Law


@dataclass(frozen=True, eq=False)
class Fork:
    """Branches side by side between the same two bodies, jointed or clamped; the leg goes on at the end of the first.

    together: shares by which one coordinate of the posture moves the axes of the passive joints, branch after branch,
    where the branches then stay closed, as 1, -1, 1, -1 of a parallelogram; none: each axis has a coordinate of its
    own. home: of that one. ties: laws between its joints.
    ValueError for less than two branches, one without an elastic member or joint, or shares that do not fit.
    """

    branches: tuple[tuple[Part, ...], ...]
    together: tuple[float, ...] = ()
    home: float = 0.0
    ties: tuple[Tie, ...] = ()

    def __post_init__(self) -> None:
        if len(self.branches) < 2:
            raise ValueError(f"a fork has two branches or more, got {len(self.branches)}")
        for number, branch in enumerate(self.branches, start=1):
            if all(isinstance(part, Frame) for part in branch):
                raise ValueError(f"branch {number} of a fork is rigid, its ends would be one body")
        count = sum(len(branch_posture(branch)) for branch in self.branches)
        if self.together and len(self.together) != count:
            raise ValueError(f"{count} axes of a fork need as many shares, got {len(self.together)}")
        if self.together and any(isinstance(part, Fork) for branch in self.branches for part in branch):
            raise ValueError("a fork whose joints move together has no further fork inside")

    @property
    def posture(self) -> tuple[Coordinate, ...]:
        """The one coordinate of `together`, or those of all branches."""
        if self.together:
            return (Coordinate(branch_posture(self.branches[0])[0].kind, self.home),)
        return tuple(each for branch in self.branches for each in branch_posture(branch))


class Compound(Protocol):
    """A part as a drawing has it, which stands for others: a parallelogram and what has been made of it."""

    @property
    def parts(self) -> tuple[Part, ...]: ...

    @property
    def posture(self) -> tuple[Coordinate, ...]: ...


Moving = Actuator | Passive | Swinging | Fork | Compound
"""Parts with coordinates in the posture."""
Part = Frame | Virtual | Elastic | SiteJoint | Moving


def posture_of(part: Part) -> tuple[Coordinate, ...]:
    """Coordinates that a part has in the posture; none for what only moves elastically."""
    return () if isinstance(part, Frame | Virtual | Elastic | SiteJoint) else part.posture


def branch_posture(parts: tuple[Part, ...]) -> tuple[Coordinate, ...]:
    """Coordinates of parts in series."""
    return tuple(each for part in parts for each in posture_of(part))


@dataclass(frozen=True, eq=False)
class Leg:
    """Parts from the base frame to the platform point, and a name for messages.

    ValueError for a rod between two balls, which spins freely about itself.
    """

    name: str
    parts: tuple[Part, ...]

    def __post_init__(self) -> None:
        for rod in spinning(self.parts):
            raise ValueError(
                f"leg {self.name}: {rod} spins freely about itself: make one end a universal joint"
            )

    @cached_property
    def posture(self) -> tuple[Coordinate, ...]:
        """(m) coordinates, base first."""
        return branch_posture(self.parts)

    @property
    def home(self) -> Array:
        """(m,) where inverse kinematics starts."""
        return np.array([each.home for each in self.posture], dtype=float)


def spinning(parts: tuple[Part, ...]) -> Iterator[str]:
    """Elastic members that can turn without any load between the passive joints around them, as words."""
    for k, part in enumerate(parts):
        if isinstance(part, Fork):
            for number, branch in enumerate(part.branches, start=1):
                yield from (f"branch {number}, {rod}" for rod in spinning(branch))
        elif isinstance(part, Elastic) and part.link.length and _spins(parts, k):
            yield f"part {k + 1}, a member of {part.link.length:g} mm,"


def _spins(parts: tuple[Part, ...], member: int) -> bool:
    """Whether the joints next to it, with rigid links between, leave a member a motion that moves neither of its
    bodies."""
    first = last = member
    while first and isinstance(parts[first - 1], Passive | Frame):
        first -= 1
    while last + 1 < len(parts) and isinstance(parts[last + 1], Passive | Frame):
        last += 1
    sides = parts[first:member], parts[member : last + 1]
    before, after = ([p for p in side if isinstance(p, Passive)] for side in sides)
    if sum(len(part.axes) for part in (*before, *after)) < 3 or not before or not after:
        return False
    elements: list[Fixed | Joint] = []
    home: list[float] = []
    for part in parts[first : last + 1]:
        if isinstance(part, Frame):
            elements.append(Fixed(part.translation, part.rotation))
        elif isinstance(part, Elastic):
            elements.append(Fixed(part.drawn * np.array(X)))
        elif isinstance(part, Passive):
            elements += [Joint(axis.kind, axis.direction, Role.PASSIVE) for axis in part.axes]
            home += [axis.home for axis in part.axes]
    # Off any posture in which two axes happen to lie in one line.
    home = [value + _ASIDE * (k + 1) for k, value in enumerate(home)]
    chain, length = Chain(tuple(elements)), parts[member].drawn  # type: ignore[union-attr]
    turns = np.array([joint.kind == "rotation" for joint in chain.joints])
    jacobian = chain.jacobian(home) / np.repeat([length, 1.0], 3)[:, None] * np.where(turns, 1.0, length)
    return rank(jacobian) < chain.size


def hinge(direction: Direction, *laws: Law, home: float = 0.0) -> Passive:
    """A joint that turns about one axis."""
    return Passive((Axis("rotation", direction, laws, home),))


def slide(direction: Direction, *laws: Law, home: float = 0.0) -> Passive:
    """A joint that shifts along one axis."""
    return Passive((Axis("translation", direction, laws, home),))


def universal(first: Direction = Y, second: Direction = Z, home: tuple[float, float] = (0.0, 0.0)) -> Passive:
    """A joint that turns about two axes, the second one carried by the first."""
    return Passive(tuple(Axis("rotation", d, (), h) for d, h in zip((first, second), home, strict=True)))


def ball(home: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Passive:
    """A ball joint: turns about x, then y, then z; it must stay off a right angle about y."""
    return Passive(tuple(Axis("rotation", d, (), h) for d, h in zip((X, Y, Z), home, strict=True)))


def elastic(length: float, stiffness: Array, segments: int = 0) -> Elastic:
    """A member by its (6, 6) at the tip, base clamped, in its own frame.

    segments: number of beam segments, which have geometric stiffness (`vjm.refined`); 0: the 6x6 lumped at the tip.
    ValueError for a length below zero or a stiffness that is not symmetric positive definite.
    """
    if not (np.isfinite(length) and length >= 0.0):
        raise ValueError(f"length must be zero or more and finite, got {length}")
    if segments and length == 0.0:
        raise ValueError("a link of no length has no segments")
    matrix = checks.stiffness_matrix("stiffness", stiffness)
    return Elastic(Link(length, matrix), Refined(segments) if segments else Lumped())


def beside(*branches: tuple[Part, ...], apart: float, across: Direction = Z) -> tuple[tuple[Part, ...], ...]:
    """Branches at equal distances, `apart` from the first to the last along a direction, that begin and end midway."""
    share = np.linspace(-0.5, 0.5, len(branches))
    offsets = [s * apart * np.array(across) for s in share]
    return tuple(
        (Frame(offset), *branch, Frame(-offset)) for offset, branch in zip(offsets, branches, strict=True)
    )


def parallelogram(
    bars: tuple[Elastic, Elastic],
    width: float,
    laws: tuple[tuple[Law, ...], ...] = ((), (), (), ()),
    home: float = 0.0,
) -> Fork:
    """Two bars between four hinges about y, `width` mm apart along z (Eq. 1); its end keeps its orientation.

    laws: of the hinges at base and tip of bar 1, then of bar 2. home: of the bars' angle, see `Coordinate`.
    """
    pairs = ((bars[0], laws[:2]), (bars[1], laws[2:]))
    branches = [(hinge(Y, *base), bar, hinge(Y, *tip)) for bar, (base, tip) in pairs]
    return Fork(beside(*branches, apart=width), (1.0, -1.0, 1.0, -1.0), home)


def leaf_pair(leaf: Elastic, width: float) -> Fork:
    """Two leaf springs clamped at both ends, `width` mm apart along z: a guide that shifts along z."""
    return Fork(beside((leaf,), (leaf,), apart=width))


def rod_pair(rod: Elastic, width: float) -> Fork:
    """Two rods, `width` mm apart along y, each with a universal joint at its base and a ball at its tip."""
    return Fork(beside(*[(universal(Y, Z), rod, ball())] * 2, apart=width, across=Y))


def notch(stiffness: Array) -> Elastic:
    """A flexure of no length by its (6, 6): notch hinge, bearing or clamp."""
    return elastic(0.0, stiffness)


def swinging_elements(part: Swinging, tie: str) -> tuple[Fixed | Joint, ...]:
    """Elements of a chain of a swinging bar: its angle, named by the tie, z free beside it, then its five springs."""
    virtual = spring_joints()
    free = Joint("translation", Z, Role.PASSIVE)
    turned, back = (Joint("rotation", Y, Role.ACTUATED, tie, share) for share in (1.0, -1.0))
    return (turned, Fixed(part.length * np.array(X)), free, *virtual[:2], *virtual[3:], back)
