"""The solid parallelogram bent at its critical load, with the stress there, as files for pictures.

At the critical load the straight linkage and every slightly bent one are in balance (W. T. Koiter, thesis, Delft
1945): what is written is the unbent state at that load and the lowest mode at a stated size on top, and von Mises'
stress of both together, linear elastic.
"""

from __future__ import annotations

from itertools import groupby
from pathlib import Path

import numpy as np

from fem.buckling import buckling
from fem.elasticity import IDENTITY
from fem.linear import LinearModel
from fem.linkage import PLATFORM, Member
from fem.material import Isotropic
from fem.prestress import prestress
from fem.von_mises import blocks_of, von_mises
from meshes.files import replacing
from meshes.solid import Floats, Ints, SolidMesh
from pipeline.progress import Stage
from pipeline.validation.stages.linkage import SolidBuckling, solid_linkage
from pipeline.validation.stages.subject import Sized, SolidBar

LENGTH_TO_BEND = 100
"""Length of the bars over the largest displacement of the mode."""


def shape_name(q_deg: float, held: list[str]) -> str:
    """Name of the file for one angle and way of holding."""
    return f"linkage_q{q_deg:g}_{'-'.join(held)}.vtu"


def linkage_shapes(
    case: Sized, s: SolidBar, loads: list[SolidBuckling], folder: Path, stage: Stage
) -> list[str]:
    """Write the bent linkage for every critical load, on the mesh of load paths; returns the names."""
    names = []
    for q, same in groupby(loads, key=lambda it: it.q_deg):
        model = solid_linkage(case, s, s.path_space, q)
        for it in same:
            stage.say(f"q = {q:g}°, {' '.join(it.held)} held")
            fields = bent(model, it.held, it.loads[0], s.bar.length / LENGTH_TO_BEND)
            names.append(shape_name(q, it.held))
            write_shape(model, fields, folder / names[-1])
    return names


def bent(model: LinearModel, held: list[str], load: float, bend: float) -> tuple[Floats, ...]:
    """Node displacements (dofs,) of each member, mm: pushed along -x by `load`, N, and bent by `bend`, mm."""
    solve = model.factor(model.reduction.others(["x", *held]))
    (mode,) = buckling(model, held, 1, factor=solve)
    unit = prestress(model, "x", held, solve)
    factor = -load / float(unit.wrench[PLATFORM.index("x")])
    pairs = zip(unit.displacements, mode.displacements, strict=True)
    return tuple(factor * pushed + bend * shape for pushed, shape in pairs)


def write_shape(model: LinearModel, fields: tuple[Floats, ...], path: Path) -> None:
    """Both bars in the base frame, with point data displacement (mm) and stress (von Mises, MPa), as a VTU file.

    fields: (3 n,) displacements of the n nodes of each bar, mm, in its own frame.
    """
    import meshio

    points, moved, stressed, first = [], [], [], 0
    cells: list[tuple[str, Ints]] = []
    for member, field in zip(model.linkage.members, fields, strict=True):
        mesh, u = member.space.mesh, field.reshape(-1, 3)
        points.append(in_base_frame(member, mesh.points))
        cells += [(kind, own + first) for kind, own in blocks_of(mesh)]
        moved.append(u @ member.turn.T)
        stressed.append(von_mises(nodal_stress(mesh, model.isotropic, u)))
        first += len(mesh.points)
    data = {
        "displacement": np.concatenate(moved).astype(np.float32),
        "stress": np.concatenate(stressed).astype(np.float32),
    }
    whole = meshio.Mesh(np.concatenate(points), cells, point_data=data)
    with replacing(path) as part:
        meshio.write(part, whole, file_format="vtu")


def in_base_frame(member: Member, points: Floats) -> Floats:
    """(n, 3) of a bar's points."""
    return np.asarray(member.origin + points @ member.turn.T)


def nodal_stress(mesh: SolidMesh, material: Isotropic, u: Floats) -> Floats:
    """Cauchy stress (n, 3, 3) MPa of small displacements (n, 3) at the nodes, the mean of the cells around each."""
    import meshio
    import pyvista

    grid = pyvista.from_meshio(meshio.Mesh(mesh.points, list(blocks_of(mesh))))
    grid.point_data["u"] = u
    # Row by row: derivatives of one displacement by x, y, z.
    gradient = np.asarray(grid.compute_derivative(scalars="u", gradient="g")["g"]).reshape(-1, 3, 3)
    strain = 0.5 * (gradient + np.swapaxes(gradient, 1, 2))
    volumetric = np.einsum("naa->n", strain)[:, None, None]
    return 2.0 * material.shear_modulus * strain + material.lame * volumetric * IDENTITY
