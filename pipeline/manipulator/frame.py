"""A manipulator at one posture as a frame of finite elements: nodes, beams and joints placed part by part.

Nothing but the description and the joints' coordinates is shared with the virtual springs; that every leg ends at
the platform is checked here again.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from fem.frame.errors import Errors
from fem.frame.section import section_of
from fem.frame.structure import ELEMENTS, RIGID, Beam, Joint, Structure, stiffness_at
from pipeline.manipulator.frame_hinges import HINGE, hinge_give, refuse
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.parts import Actuator, Elastic, Fork, Frame, Leg, Part, Passive, Virtual, branch_posture
from vjm.sensors import BaseSpring, DeadWeight, TrueMoment

Array = NDArray[np.float64]
BASE, PLATFORM = 0, 1
DRAWN = Errors()
_GAP = 1e-6
"""How far, mm, a leg may end from the platform point."""


def frame_stiffness(
    manipulator: Manipulator,
    pose: Array,
    coordinates: tuple[Array, ...],
    elements: int = ELEMENTS,
    errors: Errors = DRAWN,
) -> Array:
    """(6, 6) at the platform point by finite elements, base frame; pose (6,), per leg (m,) coordinates.

    errors: of bars and hinges of every parallelogram; those of other things are for others. ValueError for a leg that
    does not end at the platform point, and `fem.frame.structure.NoStiffness`.
    """
    return np.asarray(stiffness_at(frame_of(manipulator, pose, coordinates, errors), PLATFORM, elements))


def frame_of(
    manipulator: Manipulator, pose: Array, coordinates: tuple[Array, ...], errors: Errors = DRAWN
) -> Structure:
    """The structure: node 0 is the base, node 1 the platform at a pose (6,); coordinates (n,) of each leg."""
    build = _Builder([np.zeros(3), np.asarray(pose[:3], dtype=float)], errors=errors)
    grounds = _ground(build, manipulator)
    for leg, x in zip(manipulator.legs, coordinates, strict=True):
        _leg(build, leg, [float(v) for v in x])
    return Structure(np.array(build.positions), tuple(build.beams), tuple(build.joints), grounds)


def _ground(build: _Builder, manipulator: Manipulator) -> tuple[int, ...]:
    """Nodes that are fixed: the base, or the ground below its springs."""
    others = [s for s in manipulator.sensors if not isinstance(s, BaseSpring | DeadWeight | TrueMoment)]
    if others:
        raise ValueError(f"finite elements at rest have no {type(others[0]).__name__}")
    springs = [s for s in manipulator.sensors if isinstance(s, BaseSpring)]
    if not springs:
        return (BASE,)
    ground = build.new(np.zeros(3))
    give = np.diag(np.sum([s.compliance for s in springs], axis=0))
    build.join(ground, BASE, np.zeros(3), np.eye(3), [float(c) for c in give])
    return (ground,)


@dataclass
class _Builder:
    """The structure so far, and the end of the leg that is being placed: node, place, triad."""

    positions: list[Array]
    errors: Errors
    beams: list[Beam] = field(default_factory=list)
    joints: list[Joint] = field(default_factory=list)
    node: int = BASE
    place: Array = field(default_factory=lambda: np.zeros(3))
    triad: Array = field(default_factory=lambda: np.eye(3))

    def new(self, place: Array) -> int:
        self.positions.append(np.asarray(place, dtype=float))
        return len(self.positions) - 1

    def join(self, first: int, second: int, place: Array, triad: Array, compliance: list[float]) -> None:
        a, b, c, d, e, f = compliance
        self.joints.append(Joint(first, second, place, triad, (a, b, c, d, e, f)))

    def step(self, compliance: list[float]) -> None:
        """A joint at the end of the leg, and a new body behind it."""
        body = self.new(self.place)
        self.join(self.node, body, self.place, self.triad, compliance)
        self.node = body

    def move(self, shift: Array, turn: Array) -> None:
        self.place = self.place + self.triad @ shift
        self.triad = self.triad @ turn


def _leg(build: _Builder, leg: Leg, coordinates: list[float]) -> None:
    build.node, build.place, build.triad = BASE, np.zeros(3), np.eye(3)
    left = list(coordinates)
    for part in leg.parts:
        _place(build, part, left)
    gap = float(np.linalg.norm(build.place - build.positions[PLATFORM]))
    if gap > _GAP:
        raise ValueError(f"leg {leg.name} ends {gap:.3g} mm from the platform point")
    build.join(build.node, PLATFORM, build.place, np.eye(3), [RIGID] * 6)


def _place(build: _Builder, part: Part, left: list[float]) -> None:
    match part:
        case Frame():
            build.move(part.translation, part.rotation)
        case Actuator():
            more = build.errors.actuator_compliance
            given = 0.0 if part.stiffness is None else 1.0 / part.stiffness
            give = given + (more.mm_per_N if part.kind == "translation" else more.rad_per_Nmm)
            build.step(_along(part.kind, part.axis, give))
            _moved(build, part.kind, part.axis, left.pop(0))
        case Passive():
            for axis in part.axes:
                build.step(_along(axis.kind, axis.direction, hinge_give(axis.laws)))
                _moved(build, axis.kind, axis.direction, left.pop(0))
        case Virtual():
            build.step(_along(part.kind, part.axis, 1.0 / part.stiffness))
        case Elastic():
            _beam(build, part)
        case Fork():
            _fork(build, part, left)
        case Parallelogram():
            _linkage(build, part, left.pop(0))
        case _:
            raise ValueError(f"finite elements have no {type(part).__name__}")


def _fork(build: _Builder, part: Fork, left: list[float]) -> None:
    """Branches from one body to the one at the end of the first."""
    if part.ties:
        raise ValueError("finite elements have no laws between the branches of a fork")
    count = sum(len(branch_posture(branch)) for branch in part.branches)
    own = [share * left[0] for share in part.together] or left[:count]
    del left[: 1 if part.together else count]
    node, place, triad = build.node, build.place, build.triad
    ends = []
    for branch in part.branches:
        build.node, build.place, build.triad = node, place, triad
        for each in branch:
            _place(build, each, own)
        ends.append((build.node, build.place, build.triad))
    (first, *_), *others = ends
    for other, *_ in others:
        build.join(other, first, ends[0][1], np.eye(3), [RIGID] * 6)
    build.node, build.place, build.triad = ends[0]


def _along(kind: str, axis: tuple[float, float, float], compliance: float) -> list[float]:
    """Compliances of a joint that gives along or about one axis of its frame."""
    number = int(np.argmax(np.abs(axis)))
    if abs(abs(axis[number]) - 1.0) > 1e-12:
        raise ValueError(f"finite elements take joints along an axis of their frame, got {axis}")
    out = [RIGID] * 6
    out[number + (3 if kind == "rotation" else 0)] = compliance
    return out


def _moved(build: _Builder, kind: str, axis: tuple[float, float, float], value: float) -> None:
    a = np.array(axis)
    build.move(*((value * a, np.eye(3)) if kind == "translation" else (np.zeros(3), _turn(a, value))))


def _turn(axis: Array, angle: float) -> Array:
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + sin(angle) * cross + (1.0 - cos(angle)) * cross @ cross)


def _beam(build: _Builder, part: Elastic) -> None:
    length = part.link.length
    if length == 0.0:
        raise ValueError("finite elements have no elastic link of length zero")
    refuse(part.link, part.drawn, part.line_load)
    if np.any(part.link.give):
        raise ValueError("finite elements have elastic links without joints of their own")
    if not np.array_equal(build.positions[build.node], build.place):
        build.step([RIGID] * 6)
    tip = build.place + length * build.triad[:, 0]
    node = build.new(tip)
    stiffness = build.errors.link_compliance.scale * part.link.stiffness
    build.beams.append(Beam(build.node, node, section_of(stiffness, length), build.triad))
    build.node, build.place = node, tip


def _linkage(build: _Builder, part: Parallelogram, q: float) -> None:
    """Two beams between hinges; the leg goes on from a new body midway between their tips."""
    turned = build.triad @ _turn(np.array([0.0, 1.0, 0.0]), q)
    end = build.place + part.length * turned[:, 0]
    body = build.new(end)
    errors, scale = build.errors, build.errors.modulus_error.scale
    width = part.width + part.as_built.wider + errors.dimension_error.width_mm
    spring = errors.joint_torsional_stiffness.stiffness_Nmm_per_rad
    hinges = [hinge_give(laws, spring) for laws in part.as_built.hinges]
    radial, tilt = errors.axis_flexibility.radial_mm_per_N, errors.axis_flexibility.tilt_rad_per_Nmm
    softer = np.array([radial, 0.0, radial, tilt, 0.0, tilt])
    scales = (scale, scale * errors.bar_stiffness_asymmetry.ratio)
    bars = zip((-0.5, 0.5), part.as_built.links, scales, (hinges[:2], hinges[2:]), strict=True)
    for side, link, own, about in bars:
        refuse(link, part.length, part.as_built.line_load)
        arm = side * width * build.triad[:, 2]
        base, tip = build.new(build.place + arm), build.new(end + arm)
        section = section_of(link.stiffness, link.length)
        build.beams.append(Beam(base, tip, section if own == 1.0 else section.scaled(own), turned))
        for nodes, place, give, hinge in (
            ((build.node, base), build.place + arm, link.base_give, about[0]),
            ((tip, body), end + arm, link.tip_give, about[1]),
        ):
            compliance = [float(c) for c in np.diag(give) + softer]
            compliance[HINGE] = hinge
            build.join(*nodes, place, turned, compliance)
    build.node, build.place = body, end
