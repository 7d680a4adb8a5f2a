"""Beams, rigid bodies and joints in any arrangement, trees and loops alike, at rest: assembly and stiffness.

    structure = Structure(positions, beams, joints, fixed=(0,))
    K = stiffness_at(structure, node)

A node is a rigid body: a point with six motions. A beam runs between two nodes. A joint ties two nodes at a place,
each with its lever to it; along and about each axis of its frame it is rigid, free, or a spring. Joint forces are
unknowns beside the motions, so a rigid direction is a compliance of zero and a closed loop needs no care.
"""

from dataclasses import dataclass
from math import inf

import numpy as np

from fem.frame.condensation import condense
from fem.frame.element import force_and_tangent
from fem.frame.reference import Bars, bowed_axis, reference
from fem.frame.section import Section
from fem.frame.so3 import hat
from meshes.solid import Floats

ELEMENTS = 8
FREE, RIGID = inf, 0.0
_SINGULAR = 1e-13
"""Smallest over largest singular value of the scaled system that still counts as regular."""


class NoStiffness(ValueError):
    """The structure moves without load, or is held more often than it can answer."""


@dataclass(frozen=True, eq=False)
class Beam:
    """Beam from node `base` to node `tip`; frame (3, 3): bar frame in the base frame. Its length is their distance.

    ValueError from `stiffness_at` where the tip does not lie on the x axis of the frame.
    """

    base: int
    tip: int
    section: Section
    frame: Floats


@dataclass(frozen=True, eq=False)
class Joint:
    """Joint between nodes `first` and `second` at `place` (3,) mm, base frame.

    frame (3, 3): its axes. compliance: along x y z and about x y z, mm/N and rad/(N mm): RIGID, FREE or a number.
    """

    first: int
    second: int
    place: Floats
    frame: Floats
    compliance: tuple[float, float, float, float, float, float]


@dataclass(frozen=True, eq=False)
class Structure:
    """Nodes at positions (N, 3) mm, beams and joints between them; fixed: numbers of nodes that do not move."""

    positions: Floats
    beams: tuple[Beam, ...]
    joints: tuple[Joint, ...]
    fixed: tuple[int, ...] = (0,)


def stiffness_at(structure: Structure, node: int, elements: int = ELEMENTS) -> Floats:
    """(6, 6) stiffness at a node, base frame, N, mm, rad; all others free. NoStiffness where that is singular."""
    K, C, give = _assembled(structure, elements)
    length = float(np.ptp(structure.positions, axis=0).max()) or 1.0
    motion = np.tile(np.repeat([1.0, 1.0 / length], 3), len(structure.positions))
    force = float(np.abs(np.diag(K) * motion**2).max(initial=1.0))
    whole = np.block([[K, C.T], [C, -np.diag(give)]])
    # Motions in mm of arc, joint forces in units of `force`: rows and columns then weigh alike.
    scale = np.concatenate((motion / np.sqrt(force), _joint_scale(C, give, motion, force)))
    whole = scale[:, None] * whole * scale
    held = [6 * n + i for n in structure.fixed for i in range(6)]
    own = [6 * node + i for i in range(6)]
    rest, place = np.setdiff1d(np.arange(len(whole)), [*held, *own]), np.array(own)
    inner = whole[np.ix_(rest, rest)]
    values = np.linalg.svd(inner, compute_uv=False)
    if len(values) and values[-1] < _SINGULAR * values[0]:
        raise NoStiffness(f"node {node} held, the structure still moves, or is held twice in some direction")
    mixed = whole[np.ix_(rest, place)]
    left = whole[np.ix_(place, place)] - mixed.T @ np.linalg.solve(inner, mixed)
    left = left / scale[place][:, None] / scale[place]
    return np.asarray(0.5 * (left + left.T))


def _joint_scale(C: Floats, give: Floats, motion: Floats, force: float) -> Floats:
    """Size of joint forces that brings the largest entry of each scaled row, of C or of what the joint gives, to one.

    A joint that gives much is nearly free: its row says that it carries nothing, and is no measure of the others.
    """
    if not len(C):
        return np.zeros(0)
    largest = np.abs(C * motion / np.sqrt(force)).max(1)
    return np.asarray(1.0 / np.maximum(largest, np.sqrt(give)))


def _assembled(structure: Structure, elements: int) -> tuple[Floats, Floats, Floats]:
    """Stiffness (6 N, 6 N) of the beams, rows (J, 6 N) of relative joint motions and their compliance (J,)."""
    count = 6 * len(structure.positions)
    K = np.zeros((count, count))
    for beam in structure.beams:
        at = np.r_[6 * beam.base : 6 * beam.base + 6, 6 * beam.tip : 6 * beam.tip + 6]
        K[at[:, None], at] += _beam_stiffness(structure, beam, elements)
    rows, give = [], []
    for joint in structure.joints:
        row = np.zeros((6, count))
        for node, sign in ((joint.first, -1.0), (joint.second, 1.0)):
            motion = np.eye(6)
            motion[:3, 3:] = -hat(joint.place - structure.positions[node])
            both = np.kron(np.eye(2), joint.frame.T)
            row[:, 6 * node : 6 * node + 6] += sign * both @ motion
        kept = np.isfinite(joint.compliance)
        rows.append(row[kept])
        give.append(np.array(joint.compliance)[kept])
    empty = np.zeros((0, count))
    return K, np.concatenate([empty, *rows]), np.concatenate([np.zeros(0), *give])


def _beam_stiffness(structure: Structure, beam: Beam, elements: int) -> Floats:
    """(12, 12) of one beam between its ends, base frame."""
    way = structure.positions[beam.tip] - structure.positions[beam.base]
    length = float(np.linalg.norm(way))
    if not np.allclose(beam.frame[:, 0] * length, way, atol=1e-6 * max(length, 1.0)):
        raise ValueError(
            f"the beam from node {beam.base} to node {beam.tip} does not lie along its frame's x"
        )
    bars = Bars.of([[beam.section]], np.zeros((1, 2)), elements)
    lengths = np.full((1, 1), length)
    x, R = bowed_axis(bars, lengths)
    _, tangent = force_and_tangent(x, R, reference(bars, lengths))
    local = condense(tangent, np.zeros((*tangent.shape[:-1], 1))).stiffness[0, 0]
    turn = np.kron(np.eye(4), beam.frame)
    return np.asarray(turn @ local @ turn.T)
