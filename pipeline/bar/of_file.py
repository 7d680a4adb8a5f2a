"""A bar that comes as a file: read in a child process, K_b and K_g on nested meshes, critical loads, mode shapes."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from fem.anisotropic import Orthotropic, Regional, in_frame
from fem.material import Isotropic
from fem.mesh_limit import POWER, SWEPT_POWER, Limit, limit, swept_limit
from fem.part_bar import PartBar
from fem.part_space import shape_quality
from fem.section_torsion import TorsionLimit, torsion_limit
from meshes.brought.child import in_child
from meshes.brought.drawn import KIND as SWEPT
from meshes.brought.formats import module_of
from meshes.brought.found import Brought
from meshes.brought.frame import BarFrame
from meshes.solid import Floats
from pipeline.bar.brought_bar import asked_of, described, frame_of, relative_error, said_of
from pipeline.bar.modes import buckled
from pipeline.bar.record import BarRecord, MeshRecord, relative_spread
from pipeline.bar.stress import marked, stress_sentences, stresses
from pipeline.bar.stress_record import Stresses
from pipeline.bar.tables import FileCase, OrthotropicMaterial
from pipeline.progress import Progress
from pipeline.provenance import made_with
from pipeline.validation.entries import rows

ONE_MESH = (
    "The mesh came as it is and was not refined, so that the band by mesh is not known: bring a second, finer mesh of "
    "it and compare."
)


@dataclass(frozen=True, eq=False)
class Placed:
    """The part on its meshes, coarse to fine, in the bar's frame."""

    brought: Brought
    frame: BarFrame
    bars: tuple[PartBar, ...]

    @cached_property
    def torsion(self) -> TorsionLimit | None:
        """Of the sections of a prism of one isotropic material on these meshes; None for other parts."""
        drawn = self.brought.drawn
        if drawn is None or not isinstance(self.bars[-1].material, Isotropic):
            return None
        return torsion_limit(drawn.flats[-2:])


@dataclass(frozen=True, eq=False)
class Tied:
    """K_b and K_g (6, 6) by one way to tie the ends, without mesh error; K_g None where loads are distributed."""

    elastic: Limit
    geometric: Limit | None


def bar_of_file(case: FileCase, folder: Path, out: Path, progress: Progress, typed: str) -> BarRecord:
    """The record of the bar of a case in `folder`, mode shapes to `out`/modes.

    InputError for a file, ends or materials that cannot be used; SolveError, RuntimeError where the numerics fail.
    """
    path = case.path(folder)
    with progress.stage("read and mesh"):
        placed = said_of(path, lambda: place(case, path))
    return bar_of_placed(case, path, placed, out, progress, typed)


def bar_of_placed(
    case: FileCase, path: Path, placed: Placed, out: Path, progress: Progress, typed: str
) -> BarRecord:
    """The same of a part that has been read from `path`."""
    tie, bars = case.bar.tie, placed.bars
    quality = said_of(path, lambda: checked_quality(placed))
    with progress.stage("stiffness"):
        known = {own: tied(placed, own) for own in dict.fromkeys((tie, case.bar.rigid_tie))}
    with progress.stage("ties of the ends"):
        every = {own: known[own] if own in known else tied(placed, own) for own in bars[0].ties}
    found, geometric = every[tie].elastic, every[case.bar.rigid_tie].geometric
    assert geometric is not None
    others = {own: it.elastic.value for own, it in every.items() if own != tie}
    others_geometric = {
        own: it.geometric.value
        for own, it in every.items()
        if it.geometric is not None and own != case.bar.rigid_tie
    }
    with progress.stage("stress"):
        stress = stresses_of(case, bars)
    with progress.stage("buckling") as stage:
        loads = marked(buckled(bars, out / "modes", stage), stress)
    return BarRecord(
        name=case.name,
        title=case.title or case.name,
        length_mm=placed.frame.length,
        width_mm=None if case.linkage is None else case.linkage.width_mm,
        ends={"base": placed.brought.base.said, "tip": placed.brought.tip.said},
        tie=tie,
        material=described(case),
        stiffness=rows(found.value),
        extrapolated=rows(found.value),
        numerical_band=relative_error(found.value, found.error),
        modelling_band=relative_spread(found.value, others),
        modelling={name: rows(matrix) for name, matrix in others.items()},
        geometric=rows(geometric.value),
        geometric_numerical_band=relative_error(geometric.value, geometric.error),
        geometric_modelling_band=relative_spread(geometric.value, others_geometric),
        buckling=loads,
        stress=stress,
        mesh=MeshRecord(
            kind=bars[-1].mesh.kind,
            cells=bars[-1].mesh.count,
            dofs=bars[-1].mesh.dofs,
            study_dofs=[bar.mesh.dofs for bar in bars],
            quality=quality,
        ),
        said=[*sentences(placed, tie), *stress_sentences(stress)],
        seconds=dict(progress.seconds),
        **made_with(),
        command=typed,
        data={path.name: hashlib.sha256(path.read_bytes()).hexdigest()},
    )


def place(case: FileCase, path: Path) -> Placed:
    """Read, mesh and turn into the bar's frame; ValueError says what is wrong with the file or its ends."""
    return placed(case, Brought(*in_child(module_of(path), asked_of(case, path), case.mesh.seconds)))


def placed(case: FileCase, brought: Brought) -> Placed:
    """The same of what was read; ValueError for ends that make no bar, or materials that are not those of the part."""
    frame = frame_of(case, brought)
    bores = (brought.base.axis is not None, brought.tip.axis is not None)
    bars = []
    for mesh in brought.meshes:
        material = material_of(case, mesh.regions, mesh.region_of, frame.turn)
        bars.append(PartBar(mesh.placed(frame.to_bar(mesh.points)), frame.length, material, bores))
    return Placed(brought, frame, tuple(bars))


def material_of(
    case: FileCase, regions: tuple[str, ...], region_of: Any, turn: Floats
) -> Isotropic | Regional:
    """The material of a mesh that has been turned by (3, 3); ValueError for a region without one, or one without a
    region."""
    if isinstance(case.material, OrthotropicMaterial):
        return Regional((in_frame(law_of(case.material), turn),), np.zeros_like(region_of))
    if case.material is not None:
        return Isotropic(case.material.E_MPa, case.material.nu, case.material.source)
    if set(case.materials) != set(regions):
        raise ValueError(
            f"its regions are {', '.join(regions)}, but materials are given for {', '.join(case.materials)}; allowed "
            "is one for each"
        )
    return Regional(tuple(in_frame(law_of(case.materials[name]), turn) for name in regions), region_of)


def law_of(table: Any) -> Isotropic | Orthotropic:
    """The material of a table, axes in the file's frame; ValueError where no solid has such constants."""
    if not isinstance(table, OrthotropicMaterial):
        return Isotropic(table.E_MPa, table.nu, table.source)
    t = table
    return Orthotropic(
        t.E1_MPa, t.E2_MPa, t.E3_MPa, t.nu12, t.nu13, t.nu23, t.G12_MPa, t.G13_MPa, t.G23_MPa, t.axes, t.source
    )  # fmt: skip


def stresses_of(case: FileCase, bars: tuple[PartBar, ...]) -> Stresses | None:
    """Stress under unit loads with rigid ends; None where every material is orthotropic, for which von Mises' criterion
    does not hold."""
    regions = bars[0].mesh.regions
    tables = {
        number: case.material if case.material is not None else case.materials[name]
        for number, name in enumerate(regions)
    }
    other = [number for number, table in tables.items() if isinstance(table, OrthotropicMaterial)]
    if len(other) == len(tables):
        return None
    limits = {number: getattr(table, "yield_MPa", None) for number, table in tables.items()}
    known = {number: limit for number, limit in limits.items() if limit is not None}
    return stresses([bar.model(case.bar.rigid_tie) for bar in bars], known, other)


def checked_quality(placed: Placed) -> dict[str, float]:
    """Of the finest mesh; ValueError where a cell is inside out."""
    worst = [shape_quality(bar.mesh) for bar in placed.bars]
    for found in worst:
        if found["worst_cell"] <= 0.0:
            raise ValueError(
                "its mesh has cells that are inside out or fold over, allowed are cells right side out; another "
                "size_mm, or a repaired mesh"
            )
    return worst[-1]


def tied(placed: Placed, tie: str) -> Tied:
    """Each tie is extrapolated by itself, for at the ends, and in torsion, meshes err by each in their own way."""
    if tie == "distributed":
        return Tied(elastic_limit([bar.stiffness(tie) for bar in placed.bars], placed), None)
    axial = [bar.axial(tie) for bar in placed.bars]
    return Tied(
        elastic_limit([a.elastic for a in axial], placed),
        limited([a.geometric for a in axial], placed.bars[-1].mesh.kind),
    )


def elastic_limit(matrices: list[Floats], placed: Placed) -> Limit:
    """K_b (6, 6) of two nested meshes without their error; of one mesh itself, its error none that is known."""
    if placed.torsion is not None:
        return swept_limit(matrices[-2], matrices[-1], placed.torsion)
    return limited(matrices, placed.bars[-1].mesh.kind)


def limited(matrices: list[Floats], kind: str) -> Limit:
    """The same of K_b (6, 6) by the power of h alone, which the kind of cells says."""
    if len(matrices) == 1:
        return Limit(matrices[0], np.full((6, 6), np.nan))
    return limit(matrices[-2], matrices[-1], SWEPT_POWER if kind == SWEPT else POWER)


def sentences(placed: Placed, tie: str) -> list[str]:
    """What a reader has to know."""
    brought = placed.brought
    finest = placed.bars[-1]
    said = [
        f"Meshed: {brought.told['meshed']}.",
        f"Solved by: {finest.model('rigid').solved_by}, {finest.mesh.dofs} unknowns on the finest mesh.",
    ]
    said += [
        f"Length {placed.frame.length:.6g} mm from base point to tip point, {placed.frame.said}.",
        *brought.told["remarks"],
    ]
    if len(brought.meshes) == 1:
        said.append(ONE_MESH)
    if tie == "distributed":
        said.append("K_g and critical loads are those of rigid ends; K_b is that of distributed loads.")
    return said
