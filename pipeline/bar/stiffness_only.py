"""K_b of a bar that comes as a file, and nothing else: of a prism without a mesh of the whole, in about a second.

The file is read in a process of its own; what solves is imported meanwhile.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from meshes.brought.child import Child
from meshes.brought.drawn import KIND
from meshes.brought.formats import module_of
from meshes.brought.found import Brought
from meshes.solid import Floats
from pipeline.bar.brought_bar import asked_of, described, frame_of, relative_error, said_of
from pipeline.bar.record import BarRecord, MeshRecord
from pipeline.bar.tables import FileCase, OrthotropicMaterial
from pipeline.progress import Progress
from pipeline.provenance import commit, made_with, versions
from pipeline.validation.entries import rows

NOT_COMPUTED = (
    "K_b and its band by mesh alone were asked for: K_g, critical loads, stress, other ties of the ends, the bands by "
    "tie and the page are not computed."
)


@dataclass(frozen=True, eq=False)
class Found:
    """`value` (6, 6) without mesh error, `error` (6, 6) of it, the finest mesh, and what a reader has to know."""

    value: Floats
    error: Floats
    mesh: MeshRecord
    said: list[str]


def stiffness_of_file(case: FileCase, folder: Path, progress: Progress, typed: str) -> BarRecord:
    """The record of the bar of a case in `folder` with K_b alone.

    InputError for a file, ends or materials that cannot be used; SolveError where the numerics fail.
    """
    path = case.path(folder)
    with progress.stage("read and mesh"):
        brought = said_of(path, lambda: _read(case, path))
        frame = said_of(path, lambda: frame_of(case, brought))
    with progress.stage("stiffness"):
        found = said_of(path, lambda: (_of_prism if _is_prism(case, brought) else _of_meshes)(case, brought))
    return BarRecord(
        name=case.name,
        title=case.title or case.name,
        length_mm=frame.length,
        width_mm=None if case.linkage is None else case.linkage.width_mm,
        ends={"base": brought.base.said, "tip": brought.tip.said},
        tie=case.bar.tie,
        material=described(case),
        stiffness=rows(found.value),
        extrapolated=rows(found.value),
        numerical_band=relative_error(found.value, found.error),
        mesh=found.mesh,
        said=[
            f"Meshed: {brought.told['meshed']}.",
            *found.said,
            f"Length {frame.length:.6g} mm from base point to tip point, {frame.said}.",
            *brought.told["remarks"],
            NOT_COMPUTED,
        ],
        seconds=dict(progress.seconds),
        **made_with(),
        command=typed,
        data={path.name: hashlib.sha256(path.read_bytes()).hexdigest()},
    )


def _read(case: FileCase, path: Path) -> Brought:
    with Child(module_of(path), asked_of(case, path)) as child:
        # What solves is loaded while the child reads.
        from fem import mesh_limit  # noqa: F401
        from fem.slices import stiffness  # noqa: F401

        commit()
        versions()
        return Brought(*child.found(case.mesh.seconds))


def _is_prism(case: FileCase, brought: Brought) -> bool:
    """Whether a chain of slices has its K_b: a prism of one isotropic material with rigid ends.

    Its ends are planes, which have no half that is pressed.
    """
    return brought.drawn is not None and not (
        case.bar.tie == "distributed" or isinstance(case.material, OrthotropicMaterial) or case.materials
    )


def _of_prism(case: FileCase, brought: Brought) -> Found:
    """By the section alone."""
    from fem.material import Isotropic
    from fem.mesh_limit import swept_limit
    from fem.section_torsion import torsion_limit
    from fem.slices.classes import mirrors, said
    from fem.slices.stiffness import chain_stiffness

    drawn, table = brought.drawn, case.material
    assert drawn is not None and table is not None and not isinstance(table, OrthotropicMaterial)
    material, sweeps = Isotropic(table.E_MPa, table.nu, table.source), drawn.sweeps
    matrices = [chain_stiffness(sweep, material) for sweep in sweeps]
    limit = swept_limit(matrices[-2], matrices[-1], torsion_limit(drawn.flats[-2:]))
    dofs = [sweep.dofs for sweep in sweeps]
    mesh = MeshRecord(
        kind=KIND,
        cells=len(drawn.flats[-1].cells) * len(drawn.thickness[-1]),
        dofs=dofs[-1],
        study_dofs=dofs,
        quality={},
    )
    name = f"slice chain, {said(mirrors(sweeps[-1]))}"
    return Found(
        limit.value, limit.error, mesh, [f"Solved by: {name}, {dofs[-1]} unknowns on the finest mesh."]
    )


def _of_meshes(case: FileCase, brought: Brought) -> Found:
    """By meshes of the whole, as a full look at the bar has it."""
    from pipeline.bar.of_file import ONE_MESH, checked_quality, elastic_limit, placed

    part = placed(case, brought)
    quality = checked_quality(part)
    limit = elastic_limit([bar.stiffness(case.bar.tie) for bar in part.bars], part)
    finest = part.bars[-1]
    mesh = MeshRecord(
        kind=finest.mesh.kind,
        cells=finest.mesh.count,
        dofs=finest.mesh.dofs,
        study_dofs=[bar.mesh.dofs for bar in part.bars],
        quality=quality,
    )
    said = [f"Solved by: {finest.model('rigid').solved_by}, {finest.mesh.dofs} unknowns on the finest mesh."]
    return Found(limit.value, limit.error, mesh, [*said, *([ONE_MESH] if len(part.bars) == 1 else [])])
