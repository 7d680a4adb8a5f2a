"""A leg of parts as a chain: coordinates, springs, the path to the platform, and the loops that its forks close.

The second branch of a fork starts and ends on the same two bodies as the first one, so a loop closes by the paper's
T_1 = T_2, written between these bodies: both sides are short chains of the leg's own coordinates. Coordinates of the
path to the platform come first, then those of further branches.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np

from vjm.bars import Limb, X
from vjm.built_leg import Built, Member, named
from vjm.chain import Chain, Element, Fixed, Joint, Role
from vjm.frames import Array, exp
from vjm.laws import Law, OnSum, Spring
from vjm.loads import DeadLoads
from vjm.mechanism import Drive, ElasticChain, Loop, Path, Varying, joints_of
from vjm.parts import (
    Actuator,
    Elastic,
    Fork,
    Frame,
    Leg,
    Moving,
    Part,
    Passive,
    Swinging,
    Virtual,
    branch_posture,
    swinging_elements,
)
from vjm.site_joint import SiteJoint
from vjm.under_load import Bar, under_load

Side = tuple[tuple[Element, ...], np.ndarray]
"""One side of a loop: its elements and the numbers of their coordinates."""


def posture_input(leg: str, number: int) -> str:
    """Name of the input that is the coordinate `number` of the posture of a leg."""
    return f"{leg}.q{number}"


def turn_input(leg: str, coordinate: int) -> str:
    """Name of the input that is the turn of a hinge from where it is drawn to where it stands unloaded."""
    return f"{leg}.turn{coordinate}"


@lru_cache(maxsize=256)
def leg_chain(leg: Leg, name: str, turning: bool = False) -> ElasticChain:
    """A leg at home, with its posture among its inputs, see `posture_input`.

    name: of the leg, before those of its inputs. turning: whether where its hinges are relaxed is an input too.
    """
    of = build(leg)
    home = leg.home
    drives = [
        Drive(posture_input(name, k), float(home[k]), slope, posture=True)
        for k, slope in enumerate(of.posture)
    ]
    if turning:
        unit = np.eye(of.rest.size)
        drives += [Drive(turn_input(name, k), 0.0, unit[k], posture=True) for k in of.together]
    varying = tuple(
        Varying(numbers, posture_input(name, number), part.springs) for part, number, numbers in of.swinging
    )
    rest = sum((value * slope for value, slope in zip(home, of.posture, strict=True)), start=of.rest)
    return of.set_by(tuple(drives), rest, varying)


def build(leg: Leg, rigid: bool = False) -> Built:
    """The leg as a chain; rigid: without its elasticity and its laws, as inverse kinematics sees it.

    Branches that one coordinate of the posture moves together stay closed in it: rigid, the first one is enough.
    """
    work = _Work(rigid, [{} for _ in leg.posture])
    track = _Track([], [])
    work.walk(track, leg.parts, 0)
    work.close()
    return work.built(leg, Chain(tuple(track.elements)))


def _loop(both: tuple[Side, Side], home: Array) -> Loop:
    """A loop whose rotation vectors count from where it stands at home (n,), so that they stay small."""
    first = Chain(both[0][0]).pose(home[both[0][1]])
    turned = exp(first[3:]) if np.max(np.abs(first[3:])) > 1e-9 else np.eye(3)
    return Loop(*(Path(Chain(elements, turned), numbers) for elements, numbers in both))


@dataclass
class _Track:
    """A way from the base to a body: its elements, and the numbers of its coordinates in the leg."""

    elements: list[Element]
    numbers: list[int]

    def copy(self) -> _Track:
        return _Track(list(self.elements), list(self.numbers))

    def since(self, other: _Track) -> Side:
        """What it has beyond another one with which it begins."""
        return tuple(self.elements[len(other.elements) :]), np.array(
            self.numbers[len(other.numbers) :], dtype=int
        )


@dataclass(frozen=True, eq=False)
class _Branch:
    """A further branch of a fork: the way to it, its number, the first number in the posture of what it has there, the
    number of its first joint among those of the fork, and the other side of its loop."""

    start: _Track
    fork: _Forked
    number: int
    at: int
    joint: int
    first: Side


@dataclass(frozen=True, eq=False)
class _Forked:
    """A fork that is being placed; axes: by branch the numbers of the coordinates of its joints."""

    part: Fork
    axes: list[list[int]]


@dataclass
class _Work:
    """Collects a leg part by part. posture: of each coordinate of the posture, what it moves and by which share."""

    rigid: bool
    posture: list[dict[int, float]]
    size: int = 0
    springs: list[Spring] = field(default_factory=list)
    blocks: list[tuple[np.ndarray, Array]] = field(default_factory=list)
    rest: dict[int, float] = field(default_factory=dict)
    loads: list[DeadLoads] = field(default_factory=list)
    inputs: list[tuple[str, np.ndarray, Array]] = field(default_factory=list)
    swinging: list[tuple[Swinging, int, np.ndarray]] = field(default_factory=list)
    members: list[Member] = field(default_factory=list)
    bars: list[Bar] = field(default_factory=list)
    pending: list[_Branch] = field(default_factory=list)
    loops: list[tuple[Side, Side]] = field(default_factory=list)

    def walk(self, track: _Track, parts: tuple[Part, ...], at: int) -> None:
        """Adds parts in series; at: number of their first coordinate in the posture."""
        for part in parts:
            at += self._add(track, part, at)

    def _add(self, track: _Track, part: Part, at: int) -> int:
        """Adds a part; the number of its coordinates in the posture."""
        match part:
            case Frame():
                track.elements.append(Fixed(part.translation, part.rotation))
            case Elastic():
                self._member(track, part)
            case Virtual():
                self._spring(track, part.kind, part.axis, part.stiffness)
            case SiteJoint():
                self._site(track, part)
            case _:
                self._moving(track, part, at)
                return len(part.posture)
        return 0

    def _moving(self, track: _Track, part: Moving, at: int) -> None:
        """Adds a part with coordinates in the posture, `at` the first of them."""
        match part:
            case Actuator():
                self.posture[at][self._joint(track, Joint(part.kind, part.axis, Role.ACTUATED))] = 1.0
                if part.stiffness is not None:
                    self._spring(track, part.kind, part.axis, part.stiffness)
            case Passive():
                for number, axis in enumerate(part.axes):
                    where = self._joint(track, Joint(axis.kind, axis.direction, Role.PASSIVE))
                    self.posture[at + number][where] = 1.0
                    self._laws((where,), axis.laws)
            case Swinging():
                self._swing(track, part, at)
            case Fork():
                self._fork(track, part, at)
            case _:
                self.walk(track, part.parts, at)

    def _joint(self, track: _Track, joint: Joint) -> int:
        """Number of the coordinate of a further joint."""
        track.elements.append(joint)
        track.numbers.append(self.size)
        self.size += 1
        return self.size - 1

    def _laws(self, where: tuple[int, ...], laws: tuple[Law, ...]) -> None:
        if not self.rigid:
            self.springs += [Spring(where, law) for law in laws]

    def _spring(self, track: _Track, kind: str, axis: tuple[float, float, float], stiffness: float) -> None:
        if not self.rigid:
            where = self._joint(track, Joint(kind, axis, Role.VIRTUAL))  # type: ignore[arg-type]
            self.blocks.append((np.array([where]), np.array([[stiffness]])))

    def _site(self, track: _Track, part: SiteJoint) -> None:
        if self.rigid:
            return
        where = self._joint(track, part.joint)
        law = part.from_unloaded
        if law is None:
            self.inputs.append((part.name, np.array([where]), np.ones(1)))
            return
        self._laws((where,), (law,))
        if part.unloaded:
            self.rest[where] = part.unloaded

    def _member(self, track: _Track, part: Elastic) -> None:
        if self.rigid:
            track.elements.append(Fixed(part.drawn * np.array(X)))
            return
        for law in part.link.slides:
            where = self._joint(track, Joint("translation", X, Role.VIRTUAL))
            self._laws((where,), (law,))
        for site in part.link.base_joints:
            self._site(track, site)
        limb, start = part.model.limb(part.link), len(track.elements)
        # Members name their ties alike.
        name = str(self.size) if self.members else ""
        before = tuple(track.elements)
        numbers = self._limb(track, limb, name)
        self.members.append(Member(part, before, np.array(track.numbers, dtype=int), name))
        self.blocks.append((numbers, limb.stiffness))
        laws = limb.numbered_from(int(numbers[0]))
        self.springs += laws
        # What lengthens it is along its axis; its first part where it has several.
        axial = int(numbers[np.flatnonzero(limb.stretch)[0]])
        self.bars.append(Bar(numbers, limb.stiffness, laws, axial))
        self.rest |= {int(k): float(v) for k, v in zip(numbers, limb.rest, strict=True) if v}
        self.inputs += [(name, numbers, rate * limb.stretch) for name, rate in part.link.elongation]
        if np.any(part.line_load):
            marks = tuple(replace(mark, elements=start + mark.elements) for mark, _ in limb.stations)
            shares = np.array([share for _, share in limb.stations])
            path, every = Chain(tuple(track.elements)), np.array(track.numbers, dtype=int)
            force = shares[:, None] * part.link.length * part.line_load
            self.loads.append(DeadLoads(path, every, marks, force))
        for site in part.link.tip_joints:
            self._site(track, site)

    def _limb(self, track: _Track, limb: Limb, name: str) -> np.ndarray:
        """Numbers of the coordinates of a limb."""
        numbers = self.size + np.arange(limb.rest.size)
        track.elements += named(limb.elements, name)
        track.numbers += numbers.tolist()
        self.size += limb.rest.size
        return numbers

    def _swing(self, track: _Track, part: Swinging, at: int) -> None:
        whole, first = swinging_elements(part, f"q{at}"), self.size
        elements = tuple(e for e in whole if isinstance(e, Fixed) or e.tie) if self.rigid else whole
        count = Chain(elements).size
        track.elements += elements
        track.numbers += range(first, first + count)
        self.size += count
        self.posture[at][first] = 1.0
        if not self.rigid:
            self.swinging.append((part, at, first + 2 + np.arange(5)))

    def _fork(self, track: _Track, part: Fork, at: int) -> None:
        before, fork = track.copy(), _Forked(part, [])
        self._branch(track, fork, 0, at, 0)
        if self.rigid and part.together:
            return
        first, joint = track.since(before), 0
        for number in range(1, len(part.branches)):
            joint += len(branch_posture(part.branches[number - 1]))
            own = at if part.together else at + joint
            self.pending.append(_Branch(before, fork, number, own, joint, first))

    def _branch(self, track: _Track, fork: _Forked, number: int, at: int, joint: int) -> None:
        """One branch; where one coordinate of the posture moves all branches, its joints follow that."""
        parts, together = fork.part.branches[number], fork.part.together
        count = len(branch_posture(parts))
        if not together:
            self.walk(track, parts, at)
            fork.axes.append([next(iter(self.posture[at + k])) for k in range(count)])
            return
        outer, shares = self.posture, together[joint : joint + count]
        self.posture = [{} for _ in range(count)]
        start = track.copy()
        self.walk(track, parts, 0)
        axes, self.posture = [next(iter(each)) for each in self.posture], outer
        fork.axes.append(axes)
        if self.rigid:
            self._one_coordinate(track, start, shares, at)
            return
        self.posture[at] |= dict(zip(axes, shares, strict=True))

    def _one_coordinate(self, track: _Track, start: _Track, shares: tuple[float, ...], at: int) -> None:
        """Ties the joints since `start`, each by its share, to one coordinate."""
        left = iter(shares)
        begin, first = len(start.elements), len(start.numbers)
        track.elements[begin:] = [
            replace(e, tie=f"q{at}", share=next(left)) if isinstance(e, Joint) else e
            for e in track.elements[begin:]
        ]
        self.size = track.numbers[first] + 1
        del track.numbers[first + 1 :]
        self.posture[at][track.numbers[first]] = 1.0

    def close(self) -> None:
        """Further branches, numbered after all else, and the loops that they close."""
        while self.pending:
            branch = self.pending.pop(0)
            track = branch.start.copy()
            self._branch(track, branch.fork, branch.number, branch.at, branch.joint)
            self.loops.append((branch.first, track.since(branch.start)))
            if branch.number == len(branch.fork.part.branches) - 1:
                for tie in branch.fork.part.ties:
                    where = tuple(branch.fork.axes[b][axis] for (b, axis), _ in tie.shares)
                    self._laws(where, (OnSum(tie.law, tuple(share for _, share in tie.shares)),))

    def built(self, leg: Leg, main: Chain) -> Built:
        """All that has been collected; the leg's path to the platform is `main`."""
        rest, slopes = np.zeros(self.size), np.zeros((len(self.posture), self.size))
        for k, value in self.rest.items():
            rest[k] = value
        for number, shares in enumerate(self.posture):
            slopes[number, list(shares)] = list(shares.values())
        home = rest + leg.home @ slopes
        loops = tuple(_loop(both, home) for both in self.loops)
        joints = enumerate(joints_of(main, loops) if loops else main.joints)
        virtual = np.array([k for k, joint in joints if joint.role is Role.VIRTUAL], dtype=int)
        linear = np.zeros((self.size, self.size))
        for numbers, block in self.blocks:
            linear[numbers[:, None], numbers] = block
        drives = tuple(Drive(of, 0.0, slope) for of, slope in self._slopes())
        return Built(
            leg.name,
            main,
            linear[virtual[:, None], virtual],
            rest,
            tuple(under_load(spring, self.bars) for spring in self.springs),
            tuple(self.loads),
            drives,
            loops,
            slopes,
            tuple(self.swinging),
            tuple(self.members),
        )

    def _slopes(self) -> list[tuple[str, Array]]:
        """Change (n,) of the coordinates by each input, all members together."""
        out: dict[str, Array] = {}
        for name, numbers, slope in self.inputs:
            out.setdefault(name, np.zeros(self.size))[numbers] += slope
        return list(out.items())
