"""K_b and its derivative by axial force over nested meshes, extrapolated entry by entry."""

from collections.abc import Sequence

import numpy as np
from pydantic import BaseModel

from fem.axial import axial_stiffness
from fem.convergence import Extrapolation, extrapolate
from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.slices.stiffness import chain_stiffness
from fem.space import Space
from meshes.layers import as_sweep
from meshes.solid import Floats
from pipeline.progress import Stage
from pipeline.validation.entries import ENTRIES, rows
from pipeline.validation.result import Convergence, Matrix
from pipeline.validation.stages.specimen import Specimen

# K_g is as slow to make as K_b and converges as fast: the finest mesh would only confirm it.
GEOMETRIC_LEVELS = 3


class MeshStudy(BaseModel):
    """The study of K_b, and K_g per N of the working mesh with its error bands."""

    convergence: Convergence
    geometric: Matrix
    geometric_band: dict[str, float]


def mesh_study(s: Specimen, stage: Stage) -> MeshStudy:
    """K_b on every mesh of the study, K_g on the first three."""
    elastic, geometric, dofs = [], [], []
    for number, level in enumerate(s.detail.study):
        mesh = s.mesh(level)
        stage.say(f"{mesh.dofs} unknowns")
        if number < GEOMETRIC_LEVELS:
            both = axial_stiffness(LinearModel(single_bar(Space.of(mesh), s.bar.length), s.material))
            elastic.append(both.elastic)
            geometric.append(both.geometric)
        else:
            elastic.append(chain_stiffness(as_sweep(mesh).sweep, s.material))
        dofs.append(mesh.dofs)
    sizes = [s.size / level for level in s.detail.study]
    working = s.detail.study.index(s.detail.working)
    found = {name: series(sizes, elastic, ij) for name, ij in ENTRIES.items()}
    bent = {name: series(sizes, geometric, ij) for name, ij in ENTRIES.items()}
    return MeshStudy(
        convergence=convergence(sizes, dofs, elastic, found, working),
        geometric=rows(geometric[working]),
        geometric_band={name: bent[name].band(geometric[working][ij]) for name, ij in ENTRIES.items()},
    )


def series(sizes: Sequence[float], matrices: Sequence[Floats], ij: tuple[int, int]) -> Extrapolation:
    """One entry of as many matrices (6, 6) as there are, to its limit."""
    return extrapolate(sizes[: len(matrices)], [float(k[ij]) for k in matrices])


def convergence(
    sizes: list[float],
    dofs: list[int],
    matrices: Sequence[Floats],
    found: dict[str, Extrapolation],
    working: int,
) -> Convergence:
    """The record of the study of K_b (6, 6)."""
    limit = np.zeros((6, 6))
    for name, (i, j) in ENTRIES.items():
        limit[i, j] = limit[j, i] = found[name].limit
    orders = {name: f.order if f.order == f.order else 0.0 for name, f in found.items()}
    entries = {name: [float(k[ij]) for k in matrices] for name, ij in ENTRIES.items()}
    return Convergence(
        dofs=dofs,
        sizes_mm=sizes,
        entries=entries,
        K22=entries["K22"],
        observed_order=orders["K22"],
        orders=orders,
        extrapolated=rows(limit),
        band={name: f.band(entries[name][working]) for name, f in found.items()},
    )
