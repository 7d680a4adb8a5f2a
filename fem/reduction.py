"""A linkage's unknowns: the displacements of all inner nodes, then the generalised coordinates of the rigid faces.

Generalised coordinates: x y z rx ry rz of the platform, then the hinge angles, member by member, base before tip.
Nodal quantities of a member are in that member's own frame, generalised ones in the base frame.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.linkage import PLATFORM, Linkage, Member
from fem.rigid_face import Face, FacePlacement, PlatformPose, faces_of, to_bar_frame
from meshes.solid import Floats, Ints

Numbers = npt.NDArray[np.int32]


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

    @cached_property
    def numbers(self) -> tuple[Numbers, ...]:
        """Unknown of every node dof of each member, -1 on its rigid faces."""
        found = []
        for member, inner, start in zip(self.linkage.members, self.inner, self.starts, strict=False):
            number = np.full(member.space.dofs, -1, dtype=np.int32)
            number[inner] = start + np.arange(len(inner))
            found.append(number)
        return tuple(found)

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

    def spreads(self, at: Placement) -> tuple[sp.csr_matrix, ...]:
        """`fields` as a matrix of each member, sparse (dofs, size)."""
        made = []
        for index, (member, jacobian) in enumerate(
            zip(self.linkage.members, self.face_jacobians(at), strict=True)
        ):
            inner, outer = self.inner[index], self.outer[index]
            ends = sp.coo_matrix(jacobian)
            rows = np.concatenate((inner, outer[ends.row]))
            columns = np.concatenate((self.numbers[index][inner], self.starts[-1] + ends.col))
            values = np.concatenate((np.ones(len(inner)), ends.data))
            made.append(sp.csr_matrix((values, (rows, columns)), shape=(member.space.dofs, self.size)))
        return tuple(made)

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

    def reduce(
        self, matrices: Sequence[sp.csr_matrix], at: Placement, curvature: Floats | float = 0.0
    ) -> sp.csr_matrix:
        """Σ Tᵀ A T over the members for symmetric A, with T = ∂(node displacements)/∂(unknowns); (size, size).

        `curvature` (generalised, generalised) is added to the generalised coordinates. Where the matrices have the
        same pattern, so have the results: entries that happen to be zero are kept.
        """
        corner = np.zeros((self.generalised, self.generalised)) + curvature
        rows, borders = [], []
        for index, (matrix, jacobian) in enumerate(zip(matrices, self.face_jacobians(at), strict=True)):
            inner, outer = self.inner[index], self.outer[index]
            # Few columns, so symmetry makes them from rows.
            ends = matrix[outer]
            border = self._border(index, ends[:, inner], jacobian)
            corner += jacobian.T @ (ends[:, outer] @ jacobian)
            rows.append(bordered(matrix[inner], self.numbers[index], border, self.size))
            borders.append(border.T)
        rows.append(sp.hstack((*borders, filled(0.5 * (corner + corner.T))), format="csr"))
        return sp.csr_matrix(sp.vstack(rows, format="csr"))

    def _border(self, index: int, ends: sp.csr_matrix, jacobian: Floats) -> sp.csr_matrix:
        """Inner unknowns against generalised coordinates, from the rows `ends` of the face nodes."""
        columns = np.unique(np.concatenate([face.columns for face in self.faces[index]]))
        coupled = np.unique(ends.indices)
        block = ends[:, coupled].T @ jacobian[:, columns]
        counts = np.zeros(ends.shape[1] + 1, dtype=np.int64)
        counts[coupled + 1] = len(columns)
        parts = (block.ravel(), np.tile(columns, len(coupled)), np.cumsum(counts))
        return sp.csr_matrix(parts, shape=(ends.shape[1], self.generalised))

    def curvature(self, forces: Sequence[Floats], at: Placement) -> Floats:
        """Σ f·∂²u over the rigid faces for nodal forces (dofs,) of each member, (generalised, generalised)."""
        total = np.zeros((self.generalised, self.generalised))
        for member, pair, placed, force in zip(
            self.linkage.members, self.faces, self.placed(at), forces, strict=True
        ):
            nodal = force.reshape(-1, 3)
            for face, place in zip(pair, placed, strict=True):
                total[np.ix_(face.columns, face.columns)] += place.curvature(
                    nodal[face.nodes] @ member.turn.T
                )
        return total

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


def bordered(rows: sp.csr_matrix, numbers: Numbers, border: sp.csr_matrix, size: int) -> sp.csr_matrix:
    """Rows (n, dofs) over the unknowns, (n, size): columns renumbered, negative ones left out, `border` at the end.

    Only rows near the faces change their pattern; the stretches of rows between them are copied whole, which on large
    meshes takes a quarter of the time of slicing and stacking the matrix.
    """
    columns = numbers[rows.indices]
    dropped = np.flatnonzero(columns < 0)
    ends = rows.indptr - np.searchsorted(dropped, rows.indptr)
    changed = (np.diff(border.indptr) > 0) | (np.diff(ends) != np.diff(rows.indptr))
    bounds = np.concatenate(([0], np.flatnonzero(np.diff(changed)) + 1, [len(changed)]))
    indices, data = [], []
    for first, last in pairwise(bounds):
        own = slice(rows.indptr[first], rows.indptr[last])
        if not changed[first]:
            indices.append(columns[own])
            data.append(rows.data[own])
            continue
        kept = columns[own] >= 0
        edge = slice(border.indptr[first], border.indptr[last])
        after = np.repeat(
            (ends[first + 1 : last + 1] - ends[first]), np.diff(border.indptr[first : last + 1])
        )
        outside = (border.indices[edge] + (size - border.shape[1])).astype(np.int32)
        indices.append(np.insert(columns[own][kept], after, outside))
        data.append(np.insert(rows.data[own][kept], after, border.data[edge]))
    parts = (np.concatenate(data), np.concatenate(indices), ends + border.indptr)
    return sp.csr_matrix(parts, shape=(rows.shape[0], size))


def filled(matrix: Floats) -> sp.csr_matrix:
    """A small matrix (m, n) as a sparse one with all of its entries, zeros included."""
    rows, columns = matrix.shape
    indices = np.tile(np.arange(columns), rows)
    return sp.csr_matrix((matrix.ravel(), indices, np.arange(rows + 1) * columns), shape=matrix.shape)


def node_dofs(nodes: Ints) -> Ints:
    """Displacement unknowns (3 n,) of nodes (n,), node by node."""
    return (3 * nodes[:, None] + np.arange(3)).ravel()
