"""Quality of a solid mesh: its volume and section moments against the exact ones, and its worst cell."""

from dataclasses import dataclass

import numpy as np

from meshes.bar import Bar
from meshes.discrete import discretise
from meshes.solid import SolidMesh


@dataclass(frozen=True)
class Quality:
    """Relative errors of volume, ∫z² dV and ∫y² dV; `worst_cell` smallest over largest Jacobian within a cell
    (1 is undistorted); `longest_aspect` longest over shortest edge of a cell's bounding box."""

    volume: float
    moment_y: float
    moment_z: float
    worst_cell: float
    longest_aspect: float


def quality(mesh: SolidMesh, bar: Bar) -> Quality:
    """Measure a mesh of a bar; ValueError if a cell is inside out."""
    basis = discretise(mesh).basis
    _, y, z = np.asarray(basis.global_coordinates())
    measured = (np.sum(basis.dx), np.sum(z * z * basis.dx), np.sum(y * y * basis.dx))
    errors = [float(m / exact - 1.0) for m, exact in zip(measured, bar.exact_moments(), strict=True)]
    jacobian = np.abs(basis.mapping.detDF(basis.X))
    extents = np.ptp(mesh.points[mesh.cells], axis=1)
    return Quality(
        errors[0],
        errors[1],
        errors[2],
        float(np.min(jacobian.min(axis=1) / jacobian.max(axis=1))),
        float(np.max(extents.max(axis=1) / extents.min(axis=1))),
    )
