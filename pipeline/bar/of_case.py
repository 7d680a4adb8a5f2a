"""The bar of a case that gives a section: the stages of `run` that are about the bar, and nothing else."""

from __future__ import annotations

import hashlib
import shutil
from pathlib import Path

from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.space import Space
from meshes.files import replacing
from pipeline.bar.record import BarRecord, MeshRecord
from pipeline.bar.stress import marked, stress_sentences, stresses
from pipeline.bar.stress_record import Stresses
from pipeline.provenance import made_with
from pipeline.validation.case import SHIPPED, Case
from pipeline.validation.detail import Detail
from pipeline.validation.result import Bar, Buckling
from pipeline.validation.run import Run, buckled_bar
from pipeline.validation.stages.bar import identify
from pipeline.validation.stages.specimen import Specimen, specimen
from pipeline.validation.workshop import Workshop

SECOND_ROUTE = "tip face free, loads distributed over it"


def bar_of_case(
    case: Case, source: str, detail: Detail, workshop: Workshop, out: Path, typed: str
) -> BarRecord:
    """Mesh, K_b, K_g and critical loads of the bar of a case, mode shapes to `out`/modes.

    source: as the case was named. InputError for dimensions that cannot be, SolveError or RuntimeError if the numerics
    fail. What `run` has computed already is taken from the workshop, and the other way round.
    """
    s, fit = specimen(case, detail, workshop)
    found = identify(case, s, fit)
    loads, shapes = buckled_bar(Run(case, detail, workshop), s, found)
    stress = workshop.reuse(
        "bar stress",
        [*s.inputs, case.material.yield_MPa],
        Stresses,
        lambda _: stresses(
            _models(s), {} if case.material.yield_MPa is None else {0: case.material.yield_MPa}, []
        ),
    )
    for path in shapes:
        with replacing(out / "modes" / path.name) as part:
            shutil.copyfile(path, part)
    return _record(case, source, found, loads, stress, dict(workshop.progress.seconds), typed)


def _models(s: Specimen) -> list[LinearModel]:
    """The bar on the mesh beside the working one and on the working one, coarse to fine."""
    levels = sorted((s.detail.companion, s.detail.working))
    return [
        s.model
        if level == s.detail.working
        else LinearModel(single_bar(Space.of(s.mesh(level)), s.bar.length), s.material)
        for level in levels
    ]


def _record(
    case: Case,
    source: str,
    found: Bar,
    loads: list[Buckling],
    stress: Stresses,
    seconds: dict[str, float],
    typed: str,
) -> BarRecord:
    if found.axial is None:
        raise AssertionError("a bar that was identified has its K_g")
    path = SHIPPED / f"{source}.toml" if (SHIPPED / f"{source}.toml").exists() else Path(source)
    return BarRecord(
        name=case.name,
        title=case.title,
        length_mm=found.length_mm,
        width_mm=case.linkage.width_mm,
        ends={"base": "end face at x = 0", "tip": f"end face at x = {found.length_mm:g} mm"},
        tie="rigid",
        material=found.material,
        stiffness=found.stiffness,
        extrapolated=found.convergence.extrapolated,
        numerical_band=found.convergence.band,
        modelling_band={e.entry: abs(e.deviation) for e in found.second_route.entries},
        modelling={SECOND_ROUTE: found.second_route.stiffness},
        geometric=found.axial.solid,
        geometric_numerical_band=found.axial.band,
        buckling=marked(loads, stress),
        stress=stress,
        mesh=MeshRecord(
            kind=found.cell_kind,
            cells=found.cells,
            dofs=found.dofs,
            study_dofs=found.convergence.dofs,
            quality=found.quality,
        ),
        said=[found.second_route.explanation, *stress_sentences(stress)],
        seconds=seconds,
        **made_with(),
        command=typed,
        data={path.name: hashlib.sha256(path.read_bytes()).hexdigest()},
    )
