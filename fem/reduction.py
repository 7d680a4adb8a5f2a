"""A linkage's unknowns: the displacements of all inner nodes, then the generalised coordinates of the rigid faces.

Generalised coordinates: x y z rx ry rz of the platform, then the hinge angles, member by member, base before tip.
Nodal quantities of a member are in that member's own frame, generalised ones in the base frame.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from fem.linkage import PLATFORM, Linkage, Member
from fem.rigid_face import Face, FacePlacement, PlatformPose, faces_of, to_bar_frame
from meshes.solid import Floats, Ints


@dataclass(frozen=True)
class Placement:
    """Where the rigid faces are: platform pose and hinge angles, rad."""

    pose: PlatformPose
    angles: Floats


@dataclass(frozen=True)
class Reduction:
    """Numbering of the unknowns of a linkage and the maps between them and the nodes."""

    linkage: Linkage

    @cached_property
    def faces(self) -> tuple[tuple[Face, Face], ...]:
        return faces_of(self.linkage)

    @cached_property
    def inner(self) -> tuple[Ints, ...]:
        """Node dofs of each member that belong to no rigid face."""
        kept = []
        for member, pair in zip(self.linkage.members, self.faces, strict=True):
            mask = np.ones(len(member.space.mesh.points), dtype=bool)
            for face in pair:
                mask[face.nodes] = False
            kept.append(np.flatnonzero(np.repeat(mask, 3)))
        return tuple(kept)

    @cached_property
    def outer(self) -> tuple[Ints, ...]:
        """Node dofs of the rigid faces of each member, base before tip."""
        return tuple(node_dofs(np.concatenate([face.nodes for face in pair])) for pair in self.faces)

    @cached_property
    def starts(self) -> tuple[int, ...]:
        """First unknown of each member, and the first generalised coordinate."""
        return tuple(int(s) for s in np.concatenate(([0], np.cumsum([len(i) for i in self.inner]))))

    @property
    def generalised(self) -> int:
        return 6 + self.linkage.hinges

    @property
    def size(self) -> int:
        return self.starts[-1] + self.generalised

    @property
    def rest(self) -> Placement:
        """The unloaded placement."""
        return Placement(PlatformPose(self.linkage.point, np.eye(3)), np.zeros(self.linkage.hinges))

    def platform(self, names: Sequence[str]) -> Ints:
        """Unknowns of the named platform coordinates; ValueError names a wrong one."""
        for name in names:
            if name not in PLATFORM:
                raise ValueError(
                    f"platform coordinate {name!r} is unknown, allowed are {', '.join(PLATFORM)}"
                )
        return np.array([self.starts[-1] + PLATFORM.index(n) for n in names], dtype=np.int64)

    def others(self, names: Sequence[str]) -> Ints:
        """All unknowns but the named platform coordinates."""
        mask = np.ones(self.size, dtype=bool)
        mask[self.platform(names)] = False
        return np.flatnonzero(mask)

    def placed(self, at: Placement) -> tuple[tuple[FacePlacement, FacePlacement], ...]:
        """Every face at a placement."""
        return tuple((self._place(base, at), self._place(tip, at)) for base, tip in self.faces)

    def _place(self, face: Face, at: Placement) -> FacePlacement:
        angle = at.angles[face.columns[-1] - 6] if face.axis is not None else 0.0
        return face.place(at.pose, self.linkage.point, angle)

    def face_jacobians(self, at: Placement) -> tuple[Floats, ...]:
        """∂(face displacements)/∂(generalised coordinates) of each member, (3 nodes of both faces, generalised)."""
        parts = []
        for member, pair, placed in zip(self.linkage.members, self.faces, self.placed(at), strict=True):
            for face, place in zip(pair, placed, strict=True):
                block = np.zeros((3 * len(face.nodes), self.generalised))
                turned = np.einsum("ab,nac->nbc", member.turn, place.jacobian())
                block[:, face.columns] = turned.reshape(len(block), -1)
                parts.append(block)
        return tuple(np.concatenate(pair) for pair in zip(parts[::2], parts[1::2], strict=True))

    def fields(self, motion: Floats, at: Placement) -> tuple[Floats, ...]:
        """Node displacements (dofs, ...) of each member for a small `motion` (size, ...) of the unknowns."""
        coordinates = motion[self.starts[-1] :]
        made = []
        for index, (member, jacobian) in enumerate(
            zip(self.linkage.members, self.face_jacobians(at), strict=True)
        ):
            u = np.zeros((member.space.dofs, *motion.shape[1:]))
            u[self.inner[index]] = motion[self.starts[index] : self.starts[index + 1]]
            u[self.outer[index]] = jacobian @ coordinates
            made.append(u)
        return tuple(made)

    def loads(self, forces: Sequence[Floats], at: Placement) -> Floats:
        """Generalised forces (size,) of nodal forces (dofs,) of each member: the transpose of `fields`."""
        parts = [force[inner] for force, inner in zip(forces, self.inner, strict=True)]
        ends = [
            jacobian.T @ force[outer]
            for force, outer, jacobian in zip(forces, self.outer, self.face_jacobians(at), strict=True)
        ]
        return np.concatenate((*parts, np.sum(ends, axis=0)))

    def reduce(self, matrices: Sequence[sp.csr_matrix], at: Placement) -> sp.csr_matrix:
        """Σ Tᵀ A T over the members for symmetric A, with T = ∂(node displacements)/∂(unknowns); (size, size)."""
        corner = np.zeros((self.generalised, self.generalised))
        rows, borders = [], []
        total = self.starts[-1]
        for index, (matrix, jacobian) in enumerate(zip(matrices, self.face_jacobians(at), strict=True)):
            inner, outer = self.inner[index], self.outer[index]
            # Few columns, so symmetry makes them from rows.
            ends = matrix[outer]
            border = sp.csr_matrix(ends[:, inner].T @ sp.csr_matrix(jacobian))
            corner += jacobian.T @ (ends[:, outer] @ jacobian)
            before = sp.csr_matrix((len(inner), self.starts[index]))
            after = sp.csr_matrix((len(inner), total - self.starts[index + 1]))
            rows.append(sp.hstack((before, matrix[inner][:, inner], after, border), format="csr"))
            borders.append(border.T)
        rows.append(sp.hstack((*borders, sp.csr_matrix(0.5 * (corner + corner.T))), format="csr"))
        return sp.csr_matrix(sp.vstack(rows, format="csr"))

    def curvature(self, forces: Sequence[Floats], at: Placement) -> sp.csr_matrix:
        """Σ f·∂²u over the rigid faces for nodal forces (dofs,) of each member, sparse (size, size)."""
        total = np.zeros((self.generalised, self.generalised))
        for member, pair, placed, force in zip(
            self.linkage.members, self.faces, self.placed(at), forces, strict=True
        ):
            nodal = force.reshape(-1, 3)
            for face, place in zip(pair, placed, strict=True):
                total[np.ix_(face.columns, face.columns)] += place.curvature(
                    nodal[face.nodes] @ member.turn.T
                )
        start = self.starts[-1]
        return sp.block_diag((sp.csr_matrix((start, start)), sp.csr_matrix(total)), format="csr")

    def displacements(self, inner: Floats, at: Placement) -> tuple[Floats, ...]:
        """Node displacements (dofs,) of each member from inner displacements and a placement."""
        fields = []
        for index, (member, pair, placed) in enumerate(
            zip(self.linkage.members, self.faces, self.placed(at), strict=True)
        ):
            u = np.zeros(member.space.dofs)
            u[self.inner[index]] = inner[self.starts[index] : self.starts[index + 1]]
            for face, place in zip(pair, placed, strict=True):
                u[node_dofs(face.nodes)] = face_displacement(member, face, place)
            fields.append(u)
        return tuple(fields)


def face_displacement(member: Member, face: Face, place: FacePlacement) -> Floats:
    """Node displacements of a placed face in the bar's frame, (3 n,) mm."""
    return (to_bar_frame(member, place.positions) - member.space.mesh.points[face.nodes]).ravel()


def node_dofs(nodes: Ints) -> Ints:
    """Displacement unknowns of nodes, node by node."""
    return (3 * nodes[:, None] + np.arange(3)).ravel()
