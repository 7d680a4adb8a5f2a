"""Saint-Venant's torsion constant of a section on a mesh of it, and its limit on ever finer ones.

∇²ω = 0 with n·∇ω = z n_y - y n_z gives J = ∫ (ω_y - z)² + (ω_z + y)² dA, from above on every mesh. Beside a re-entrant
corner of angle α the stress grows as r^(π/α - 1), so that J falls as h^(2π/α) only, h^(4/3) at 270 degrees, whatever
the cells: most of the error that a coarse mesh of a section leaves in the torsion of a bar. Two dimensions are cheap.
Sources: W. D. Pilkey, Analysis and Design of Elastic Beams, Wiley 2002, chapter 5; G. Strang, G. J. Fix, An Analysis of
the Finite Element Method, Prentice-Hall 1973, chapter 8.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from meshes.plane import GRID, PlaneMesh, halved
from meshes.solid import Floats

# Meshes beyond the finest that is given: the third has 64 times its cells.
BEYOND = 2
# Of h, by which J falls beside a corner of 270 degrees.
RIGHT_CORNER = 4.0 / 3.0
# Of h: a smooth field of nine-node cells, and the tip of a crack.
FASTEST, SLOWEST = 4.0, 1.0


@dataclass(frozen=True)
class TorsionLimit:
    """`levels`: J of each mesh, mm⁴, coarse to fine; `value` of no mesh; `error`: how far that may be off."""

    levels: tuple[float, ...]
    value: float
    error: float


def torsion_limit(flats: tuple[PlaneMesh, ...]) -> TorsionLimit:
    """Of nested meshes, coarse to fine, each with the cells of the one before halved."""
    found = [torsion_constant(flat) for flat in flats]
    flat = flats[-1]
    for _ in range(BEYOND):
        flat = halved(flat)
        found.append(torsion_constant(flat))
    before, step = found[-3] - found[-2], found[-2] - found[-1]
    # The law that the last three follow, which other corners have too; and that of the commonest one.
    ratio = np.clip(before / step if step > 0.0 else np.inf, 2.0**SLOWEST, 2.0**FASTEST)
    value = found[-1] - step / (ratio - 1.0)
    error = abs(value - (found[-1] - step / (2.0**RIGHT_CORNER - 1.0)))
    return TorsionLimit(tuple(found[: len(flats)]), float(value), float(error))


def torsion_constant(flat: PlaneMesh) -> float:
    """J, mm⁴, of a section in nine-node quadrilaterals, y and z about any point."""
    gradients, weights, places = _at_points(flat)
    y, z = places[..., 0], places[..., 1]
    twist = np.stack((z, -y), axis=-1)
    blocks = np.einsum("mqia,mqja,mq->mij", gradients, gradients, weights)
    loads = np.einsum("mqia,mqa,mq->mi", gradients, twist, weights)
    rows, columns = np.repeat(flat.cells, 9, axis=1).ravel(), np.tile(flat.cells, 9).ravel()
    count = len(flat.points)
    matrix = sp.csc_matrix((blocks.ravel(), (rows, columns)), shape=(count, count))
    load = np.bincount(flat.cells.ravel(), loads.ravel(), count)
    warping = np.zeros(count)
    # One node at rest, for only differences count.
    warping[1:] = splu(matrix[1:, 1:], permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve(
        load[1:]
    )
    # ∫|∇ω - t|² with ω that makes it least: what t has less the work of ω.
    return float(np.einsum("mqa,mqa,mq->", twist, twist, weights) - load @ warping)


def torsion_mended(stiffness: Floats, factor: float) -> Floats:
    """(6, 6) K_b of a bar whose torsion constant is `factor` times as large, at the tip point.

    The compliance of a torque about the shear axis alone changes, by 1 / factor: in K that is K44 alone, whatever
    couples, by (factor - 1) over the compliance's own entry.
    """
    out = stiffness.copy()
    out[3, 3] += (factor - 1.0) / np.linalg.inv(stiffness)[3, 3]
    return out


def _at_points(flat: PlaneMesh) -> tuple[Floats, Floats, Floats]:
    """Gradients (m, 9, 9, 2) of the functions at nine points, weights (m, 9), places (m, 9, 2)."""
    points, line_weights = np.polynomial.legendre.leggauss(3)
    one = np.stack((0.5 * points * (points - 1.0), 1.0 - points**2, 0.5 * points * (points + 1.0)))
    slope = np.stack((points - 0.5, -2.0 * points, points + 0.5))
    values = np.einsum("ac,bd->cdab", one, one).reshape(9, 9)
    along = np.stack(
        [np.einsum("ac,bd->cdab", *pair).reshape(9, 9) for pair in ((slope, one), (one, slope))], axis=-1
    )
    nodes = flat.points[flat.cells[:, GRID]]
    jacobian = np.einsum("max,qab->mqxb", nodes, along)
    found = np.einsum("qab,mqbx->mqax", along, np.linalg.inv(jacobian))
    gradients = np.empty_like(found)
    gradients[:, :, GRID] = found
    weights = np.outer(line_weights, line_weights).ravel() * np.abs(np.linalg.det(jacobian))
    return gradients, weights, np.einsum("qa,max->mqx", values, nodes)
