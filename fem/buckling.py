"""Linear buckling: the lowest load factors of K + λ K_g and their modes."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import LinearOperator, eigsh

from fem.linear import LinearModel, submatrix
from fem.linkage import PLATFORM, Linkage
from fem.prestress import prestress
from meshes.solid import Floats

# Of the vectors, relative; the loads are then good to its square.
VECTOR_TOLERANCE = 1e-6
# Below this share of sideways motion of the axis, a mode is a twist of the section.
TORSION_SHARE = 0.1


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


def buckling(model: LinearModel, held: Sequence[str], count: int = 6, driven: str = "x") -> tuple[Mode, ...]:
    """The `count` lowest modes of a linkage pushed along -`driven`, the `held` platform coordinates held.

    Raises SolveError if the unloaded linkage is not held, RuntimeError if fewer modes come out than asked for.
    """
    r = model.reduction
    free = r.others([driven, *held])
    factor = model.factor(free)
    state = prestress(model, driven, held, factor)
    k = submatrix(model.reduced, free)
    kg = submatrix(state.geometric, free)
    inverse = LinearOperator(k.shape, matvec=factor, dtype=float)
    # Pushing reverses the sign of the unit state. Shift-invert about the unloaded state: the largest 1/λ
    # belong to the lowest loads; a random start could miss a symmetric mode only with probability zero.
    start = np.random.default_rng(0).standard_normal(k.shape[0])
    inverse_factors, vectors = eigsh(kg, count, k, which="LA", Minv=inverse, v0=start, tol=VECTOR_TOLERANCE)
    if np.any(inverse_factors <= 0.0):
        raise RuntimeError(f"fewer than {count} buckling modes were found in compression")
    unit = float(state.wrench[PLATFORM.index(driven)])
    modes = []
    for index in np.argsort(-inverse_factors):
        motion = np.zeros(r.size)
        motion[free] = vectors[:, index]
        modes.append(scaled_mode(model, unit / float(inverse_factors[index]), motion))
    return tuple(modes)


def scaled_mode(model: LinearModel, load: float, motion: Floats) -> Mode:
    """The mode with its largest nodal displacement made +1 mm, and the plane it moves in."""
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
    """The plane in which the bars' axes move most, or "torsion" if they hardly move."""
    sideways, total = np.zeros(2), 0.0
    for member, field in zip(linkage.members, fields, strict=True):
        u = field.reshape(-1, 3)
        station = np.round(member.space.mesh.points[:, 0] / member.tip_middle[0], 6)
        _, index, counts = np.unique(station, return_inverse=True, return_counts=True)
        for axis in (1, 2):
            mean = np.bincount(index, u[:, axis]) / counts
            sideways[axis - 1] += np.sum(counts * mean**2)
        total += float(np.sum(u[:, 1:] ** 2))
    if sideways.sum() < TORSION_SHARE * total:
        return "torsion"
    return "xy" if sideways[0] > sideways[1] else "xz"
