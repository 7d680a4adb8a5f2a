"""Von Mises' stress of a bar under unit wrenches at its tip, at the nodes of its mesh.

The stress of a cell is taken at its nodes and averaged over the cells around each, region by region: where materials
meet, a node has a stress in each.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from fem.anisotropic import Regional, tensor_of
from fem.cells import nodal_slopes
from fem.linear import LinearModel
from meshes.part import PartMesh
from meshes.solid import Floats, Ints, SolidMesh

IDENTITY = np.eye(3)
CELLS_AT_ONCE = 1000


def von_mises(stress: Floats) -> Floats:
    """Equivalent stress (n,) of stresses (n, 3, 3)."""
    deviator = stress - np.einsum("naa->n", stress)[:, None, None] / 3.0 * IDENTITY
    return np.sqrt(1.5 * np.einsum("nab,nab->n", deviator, deviator))


@dataclass(frozen=True, eq=False)
class UnitStress:
    """A bar held at its base under the six unit wrenches Fx .. Mz at its tip point, in N and N·mm.

    at     : (n, 3) mm, bar frame; a node stands once for each region that it is in
    region : (n,) number of the region
    values : (6, n) von Mises, MPa per N, MPa per N·mm
    """

    at: Floats
    region: Ints
    values: Floats


def unit_stress(model: LinearModel) -> UnitStress:
    """Of a single clamped bar. ValueError for a linkage of several; SolveError if it cannot be solved."""
    (member,) = model.linkage.members
    mesh, r = member.space.mesh, model.reduction
    motions = model.unit_motions @ np.linalg.inv(model.stiffness)
    (fields,) = r.fields(motions, r.rest)
    regions = region_of(mesh)
    count = int(regions.max()) + 1
    sums, around = np.zeros((count * len(mesh.points), 6, 6)), np.zeros(count * len(mesh.points))
    for cells, stress in _at_nodes(model, mesh, fields.reshape(len(mesh.points), 3, 6)):
        keys = (regions[cells[0]][:, None] * len(mesh.points) + cells[1]).ravel()
        np.add.at(sums, keys, stress.reshape(len(keys), 6, 6))
        np.add.at(around, keys, 1.0)
    used = np.flatnonzero(around)
    mean = sums[used] / around[used][:, None, None]
    values = np.stack([von_mises(_full(mean[:, load])) for load in range(6)])
    return UnitStress(mesh.points[used % len(mesh.points)], used // len(mesh.points), values)


def region_of(mesh: SolidMesh) -> Ints:
    """(cells,) number of each cell's region, of all kinds of cells one after the other."""
    if isinstance(mesh, PartMesh):
        return mesh.region_of
    return np.zeros(len(mesh.cells), dtype=np.int64)


def blocks_of(mesh: SolidMesh) -> tuple[tuple[str, Ints], ...]:
    """Cells (m, k) of each kind."""
    return mesh.blocks if isinstance(mesh, PartMesh) else ((mesh.kind, mesh.cells),)


def near_ends(mesh: SolidMesh, at: Floats) -> tuple[np.ndarray, dict[str, float]]:
    """Whether points (n, 3) mm are nearer to a tied end than half its largest extent, and that distance of each, mm.

    By Saint-Venant's principle how an end is tied is felt about that far.
    """
    near, reach = np.zeros(len(at), dtype=bool), {}
    for name in ("base", "tip"):
        tied = mesh.points[mesh.face_nodes(name)]
        reach[name] = float(0.5 * np.ptp(tied, axis=0).max())
        near |= cKDTree(tied).query(at)[0] <= reach[name]
    return near, reach


def _at_nodes(
    model: LinearModel, mesh: SolidMesh, moved: Floats
) -> Iterator[tuple[tuple[slice, Ints], Floats]]:
    """Numbers and nodes of some cells, and their stress (m, k, 6 loads, 6 places) of displacements (n, 3, 6)."""
    first = 0
    for kind, cells in blocks_of(mesh):
        slopes = nodal_slopes(kind)
        for start in range(0, len(cells), CELLS_AT_ONCE):
            own = cells[start : start + CELLS_AT_ONCE]
            numbers = slice(first + start, first + start + len(own))
            jacobian = np.einsum("mka,qkb->mqab", mesh.points[own], slopes)
            slope = np.einsum("qkb,mqba->mqka", slopes, np.linalg.inv(jacobian))
            gradient = np.einsum("mkal,mqkb->mqlab", moved[own], slope, optimize=True)
            law = _laws(model, numbers)
            yield (numbers, own), np.einsum("mpab,mqlab->mqlp", law, gradient, optimize=True)
        first += len(cells)


PLACES = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


def _laws(model: LinearModel, numbers: slice) -> Floats:
    """(m, 6, 3, 3) from displacement gradients to the stresses at `PLACES`; m is 1 where all cells have one law."""
    material = model.material
    if isinstance(material, Regional):
        tensors = material.tensors[material.of_cell[numbers]]
    else:
        tensors = tensor_of(material)[None]
    return np.stack([tensors[:, a, b] for a, b in PLACES], axis=1)


def _full(stress: Floats) -> Floats:
    """(n, 3, 3) of stresses (n, 6) at `PLACES`."""
    full = np.empty((len(stress), 3, 3))
    for place, (a, b) in enumerate(PLACES):
        full[:, a, b] = full[:, b, a] = stress[:, place]
    return full
