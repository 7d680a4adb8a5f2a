"""Linear buckling: the lowest load factors of K + λ K_g and their modes, with every member of a multiple one."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem.axis_shape import axis_shape, section_sizes
from fem.eigenpairs import largest_eigenpairs
from fem.factor import Factor
from fem.linear import LinearModel
from fem.linkage import PLATFORM, Linkage
from fem.prestress import prestress
from meshes.solid import Floats

# Below this share of sideways motion of the axis, a mode is a twist of the section.
TORSION_SHARE = 0.1
# Loads closer than this, relative, count as one: any mixture of their modes is one too, within the error of a mesh.
SAME_LOAD = 1e-3
# Share of the work of the axial force in one plane from which a mixture of modes counts as one of that plane.
PURE = 0.5


@dataclass(frozen=True)
class Mode:
    """One buckling mode.

    load    : compression along the driven coordinate at which it appears, N, positive
    plane   : "xy" (out of the linkage's plane), "xz" (in it) or "torsion"
    motion  : (size,) unknowns of the linkage, largest nodal displacement 1 mm
    displacements : node displacements (dofs,) of each member in its own frame
    """

    load: float
    plane: str
    motion: Floats
    displacements: tuple[Floats, ...]


def buckling(
    model: LinearModel,
    held: Sequence[str],
    count: int = 6,
    driven: str = "x",
    factor: Factor | None = None,
) -> tuple[Mode, ...]:
    """The `count` lowest modes of a linkage pushed along -`driven`, the `held` platform coordinates held.

    Every member of a multiple load is among them, and modes of one load are turned into the planes xy and xz: a round
    or square bar has any direction between as well. `factor` as in `LinearModel.motions`.
    Raises SolveError if the unloaded linkage is not held, RuntimeError if fewer modes come out than asked for.
    """
    r = model.reduction
    free = r.others([driven, *held])
    factor = factor or model.factor(free)
    state = prestress(model, driven, held, factor)
    # Pushing reverses the sign of the unit state. Shift-invert about the unloaded state: the largest 1/λ
    # belong to the lowest loads.
    inverse_factors, vectors = largest_eigenpairs(state.geometric.within(free), factor, count)
    if np.any(inverse_factors[:count] <= 0.0):
        raise RuntimeError(f"fewer than {count} buckling modes were found in compression")
    motions = np.zeros((r.size, len(inverse_factors)))
    motions[free] = vectors
    inverse_factors, motions = into_planes(model, inverse_factors, motions)
    unit = float(state.wrench[PLATFORM.index(driven)])
    return tuple(
        scaled_mode(model, unit / float(inverse), motions[:, index])
        for index, inverse in enumerate(inverse_factors[:count])
    )


def into_planes(model: LinearModel, inverse_factors: Floats, motions: Floats) -> tuple[Floats, Floats]:
    """Pairs (m,), (size, m), in falling order, with the members of each multiple load turned into the planes.

    Vectors are orthonormal in K, so that turning them keeps them so; each gets the inverse load factor of its mixture.
    Modes that lie in one plane already are left as they are.
    """
    values, turned, first = inverse_factors.copy(), motions.copy(), 0
    while first < len(values):
        last = first + 1
        while last < len(values) and inverse_factors[last] >= inverse_factors[first] * (1.0 - SAME_LOAD):
            last += 1
        if last - first > 1:
            turn = plane_turn(model, motions[:, first:last])
            mixed = (turn**2).T @ inverse_factors[first:last]
            # Of equal loads, to rounding, xy comes first.
            order = np.argsort(-np.round(mixed / mixed[0], 9), kind="stable")
            values[first:last] = mixed[order]
            turned[:, first:last] = (motions[:, first:last] @ turn)[:, order]
        first = last
    return values, turned


def plane_turn(model: LinearModel, motions: Floats) -> Floats:
    """Orthogonal (m, m) that turns modes of one load, (size, m), into modes in xy, in xz and torsion, in this order."""
    r = model.reduction
    in_y, in_z, twist = slope_products(model.linkage, r.fields(motions, r.rest))
    scale = float(np.trace(in_y + in_z + twist)) / len(in_y)
    # All of them take the same work of the axial force: bending in xy has +1, in xz -1, torsion 0 of it.
    shares, directions = np.linalg.eigh((in_y - in_z) / scale)
    groups = [shares > PURE, shares < -PURE, np.abs(shares) <= PURE]
    return np.hstack([nearest_basis(directions[:, group]) for group in groups if group.any()])


def nearest_basis(span: Floats) -> Floats:
    """Orthonormal basis (m, g) of a span (m, g) that keeps to the axes of its space, first ones first.

    Two modes in the same plane, such as those of two equal bars, so stay what the eigensolver made of them.
    """
    projector = span @ span.T
    chosen: list[int] = []
    basis = np.zeros((len(span), 0))
    for _ in range(span.shape[1]):
        left = projector - basis @ basis.T
        sizes = np.diag(left)
        sizes = np.where(np.isin(np.arange(len(sizes)), chosen), -1.0, sizes)
        # The first of those that are about as large as the largest.
        index = int(np.flatnonzero(sizes >= 0.9 * sizes.max())[0])
        chosen.append(index)
        basis = np.column_stack((basis, left[:, index] / np.linalg.norm(left[:, index])))
    return basis


def slope_products(linkage: Linkage, fields: Sequence[Floats]) -> Floats:
    """(3, m, m) ∫ a' b' dx over all members for shift along y, along z and twist times r₀, of fields (dofs, m)."""
    total = 0.0
    for member, field in zip(linkage.members, fields, strict=True):
        mesh = member.space.mesh
        # Of the nodes, near enough for a weight.
        radius = float(np.sqrt(np.mean(np.sum(mesh.points[:, 1:] ** 2, axis=1))))
        shapes = [axis_shape(mesh, u, radius) for u in field.T]
        slopes = np.array([np.diff(s.motion, axis=0) / np.sqrt(np.diff(s.x))[:, None] for s in shapes])
        total = total + np.einsum("asc,bsc->cab", slopes, slopes)
    return np.asarray(total)


def scaled_mode(model: LinearModel, load: float, motion: Floats) -> Mode:
    """The mode of unknowns (size,) with its largest nodal displacement made +1 mm, and the plane it moves in."""
    r = model.reduction
    fields = r.fields(motion, r.rest)
    norms = [np.linalg.norm(f.reshape(-1, 3), axis=1) for f in fields]
    member = int(np.argmax([n.max() for n in norms]))
    # Of nodes that move equally far the first one sets the sign, so that rounding does not.
    node = int(np.argmax(norms[member] > norms[member].max() * (1.0 - 1e-6)))
    vector = fields[member].reshape(-1, 3)[node]
    scale = float(np.linalg.norm(vector)) * float(np.sign(vector[np.argmax(np.abs(vector))]))
    motion = motion / scale
    return Mode(load, plane_of(model.linkage, fields), motion, tuple(f / scale for f in fields))


def plane_of(linkage: Linkage, fields: Sequence[Floats]) -> str:
    """The plane in which the bars' axes move most, or "torsion" if they hardly move; of each bar (3 n,)
    displacements of its nodes."""
    sideways, total = np.zeros(2), 0.0
    for member, field in zip(linkage.members, fields, strict=True):
        mesh, u = member.space.mesh, field.reshape(-1, 3)
        shape, counts = axis_shape(mesh, field, 1.0), section_sizes(mesh)
        sideways += np.sum(counts[:, None] * shape.motion[:, :2] ** 2, axis=0)
        total += float(np.sum(u[:, 1:] ** 2))
    if sideways.sum() < TORSION_SHARE * total:
        return "torsion"
    return "xy" if sideways[0] > sideways[1] else "xz"
