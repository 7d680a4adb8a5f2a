"""Motion of a rigid face: position, first and second derivatives in its generalised coordinates.

A face carried by the platform has seven coordinates: translation of the platform point (3), spin of the platform
about it (3, applied as exp of a small vector to the current orientation), hinge angle (1). A face on the ground has
the hinge angle alone.

The second derivative is not a refinement. A *linear* tie leaves it out, and then a rigid turn of a stressed body
does work: the geometric stiffness gains a spurious, mesh-dependent torsional mode. For the rotation block it is
(S + Sᵀ)/2 - tr(S) I with S = Σ f ⊗ r over the face nodes.
"""

from dataclasses import dataclass

import numpy as np

from fem.linkage import Axis, Linkage, Member
from fem.rotation import rotation
from meshes.solid import Floats, Ints


@dataclass(frozen=True)
class PlatformPose:
    """Position of the platform point, (3,) mm, and orientation, (3, 3), in the base frame."""

    position: Floats
    orientation: Floats

    def moved(self, step: Floats) -> "PlatformPose":
        """The pose after a translation step[:3] and a spin step[3:], both in the base frame."""
        return PlatformPose(self.position + step[:3], rotation(step[3:]) @ self.orientation)


@dataclass(frozen=True)
class Face:
    """A rigid end face of a member: its nodes, where they are, and which coordinates move it.

    rest    : (n, 3) unloaded base-frame positions, mm
    pin     : (3,) unloaded base-frame position of the hinge (the middle of the face)
    columns : generalised coordinates that move it; platform coordinates first, the hinge last
    """

    nodes: Ints
    rest: Floats
    pin: Floats
    axis: Axis | None
    on_platform: bool
    columns: Ints

    def place(self, pose: PlatformPose, rest_point: Floats, angle: float) -> "FacePlacement":
        """Positions and derivatives at a platform pose and hinge angle (rad)."""
        axis = np.zeros(3) if self.axis is None else np.array(self.axis)
        arm = (self.rest - self.pin) @ rotation(angle * axis).T
        if not self.on_platform:
            return FacePlacement(self.pin + arm, np.zeros_like(arm), arm, axis, False, self.axis is not None)
        arm = arm @ pose.orientation.T
        from_point = (self.pin - rest_point) @ pose.orientation.T + arm
        axis = pose.orientation @ axis
        return FacePlacement(pose.position + from_point, from_point, arm, axis, True, self.axis is not None)


@dataclass(frozen=True)
class FacePlacement:
    """A face in place: node `positions`, arms from the platform point and from the hinge, current hinge axis."""

    positions: Floats
    from_point: Floats
    from_pin: Floats
    axis: Floats
    on_platform: bool
    hinged: bool

    def jacobian(self) -> Floats:
        """∂position/∂coordinates, (n, 3, c)."""
        parts = []
        if self.on_platform:
            count = len(self.positions)
            parts.append(np.broadcast_to(np.eye(3), (count, 3, 3)))
            parts.append(np.stack([np.cross(e, self.from_point) for e in np.eye(3)], axis=-1))
        if self.hinged:
            parts.append(np.cross(self.axis, self.from_pin)[:, :, None])
        return np.concatenate(parts, axis=2) if parts else np.zeros((len(self.positions), 3, 0))

    def curvature(self, force: Floats) -> Floats:
        """Σ f·∂²position/∂coordinates², (c, c), for nodal forces (n, 3) N in the base frame."""
        size = 6 * self.on_platform + self.hinged
        h = np.zeros((size, size))
        if self.on_platform:
            s = force.T @ self.from_point
            h[3:6, 3:6] = 0.5 * (s + s.T) - np.trace(s) * np.eye(3)
        if self.hinged:
            swing = np.cross(self.axis, self.from_pin)
            h[-1, -1] = np.sum(force * np.cross(self.axis, swing))
            if self.on_platform:
                h[3:6, -1] = h[-1, 3:6] = np.cross(swing, force).sum(axis=0)
        return h


def faces_of(linkage: Linkage) -> tuple[tuple[Face, Face], ...]:
    """Base and tip face of every member; hinge coordinates are numbered after the six of the platform."""
    following = 6
    pairs = []
    for member in linkage.members:
        pair = []
        for name, axis, pin in (
            ("base", member.base_axis, member.origin),
            ("tip", member.tip_axis, member.tip),
        ):
            columns = list(range(6)) if name == "tip" else []
            if axis is not None:
                columns.append(following)
                following += 1
            nodes = member.space.mesh.face_nodes(name)
            rest = to_base_frame(member, member.space.mesh.points[nodes])
            pair.append(Face(nodes, rest, pin, axis, name == "tip", np.array(columns, dtype=np.int64)))
        pairs.append((pair[0], pair[1]))
    return tuple(pairs)


def to_base_frame(member: Member, points: Floats) -> Floats:
    """Positions in the bar's frame, (n, 3), as positions in the base frame."""
    return member.origin + points @ member.turn.T


def to_bar_frame(member: Member, points: Floats) -> Floats:
    """Positions in the base frame, (n, 3), as positions in the bar's frame."""
    return (points - member.origin) @ member.turn
