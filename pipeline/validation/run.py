"""The validation run: the stages in their order, and the result put together."""

import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pydantic import BaseModel

from fem.pardiso import has_pardiso
from meshes.files import replacing
from pipeline.manipulator.table_record import Table1
from pipeline.progress import Progress, Stage
from pipeline.provenance import made_with
from pipeline.validation.agreement import agreement_sentences
from pipeline.validation.alarms import alarms
from pipeline.validation.case import Case
from pipeline.validation.comparison import stiffness_records
from pipeline.validation.critical import bar_mode, critical_records
from pipeline.validation.curves import curve_records, validity_records
from pipeline.validation.detail import Detail
from pipeline.validation.result import (
    Bar,
    Buckling,
    Critical,
    Curve,
    Erratum,
    Parallelogram,
    Refinement,
    Result,
    Validity,
)
from pipeline.validation.stages.bar import identify
from pipeline.validation.stages.buckling import buckle_bar, mode_files
from pipeline.validation.stages.followed import solid_paths, solid_study
from pipeline.validation.stages.linkage import (
    SolidBuckling,
    SolidPath,
    SolidStiffness,
    solid_buckling,
    solid_stiffness,
)
from pipeline.validation.stages.linkage_shapes import linkage_shapes, shape_name
from pipeline.validation.stages.orthoglide import table_sentences, whole_manipulator
from pipeline.validation.stages.refinement import refinements
from pipeline.validation.stages.specimen import Specimen, specimen
from pipeline.validation.stages.springs import spring_set
from pipeline.validation.story import tell, yield_sentences
from pipeline.validation.workshop import Workshop
from pipeline.validation.yielding import (
    Planes,
    Yielding,
    marked_buckling,
    marked_critical,
    marked_curves,
    marked_validity,
    yielding_of,
)
from vjm.paper_errata import errata

SOURCES = (
    "A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, Stiffness modelling of parallelogram-based parallel "
    "manipulators, New Trends in Mechanism Science (EUCOMES 2010), Springer",
    "A. Pashkevich, A. Klimchik, D. Chablat, Ph. Wenger, Accuracy improvement for stiffness modeling of parallel "
    "manipulators, 42nd CIRP Conference on Manufacturing Systems, 2009 (virtual experiments)",
    "S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., McGraw-Hill 1961 (critical loads)",
    "W. D. Pilkey, Analysis and Design of Elastic Beams, Wiley 2002 (section constants)",
    "I. B. Celik et al., J. Fluids Eng. 130 (2008) 078001 (discretisation error)",
    "J. W. Bandler et al., IEEE Trans. Microwave Theory Tech. 52 (2004) 337-361 (space mapping)",
    "scikit-fem, gmsh (OpenCASCADE), meshio, SciPy, pyvista: the libraries this run stands on",
)
# Nothing in the run is random but the start vector of the eigenvalue solver.
SEED = 0


class Springs(BaseModel):
    """What the virtual springs and the comparison give."""

    parallelogram: list[Parallelogram]
    critical: list[Critical]
    curves: list[Curve]
    validity: list[Validity]
    refinement: list[Refinement]
    agreement: list[str]
    errata: list[Erratum]


@dataclass(frozen=True)
class Solids:
    """What the solid linkage gives."""

    stiffness: list[SolidStiffness]
    loads: list[SolidBuckling]
    paths: list[SolidPath]
    steps: Refinement


@dataclass(frozen=True)
class Run:
    """A case at a level of detail, with the workshop it is done in."""

    case: Case
    detail: Detail
    workshop: Workshop

    @property
    def progress(self) -> Progress:
        return self.workshop.progress

    def inputs(self, s: Specimen) -> list[object]:
        """What the stages of the linkage depend on."""
        return [*s.inputs, self.case.model_dump(mode="json")]


def run(case: Case, detail: Detail, workshop: Workshop, out: Path, typed: str) -> Result:
    """Do all stages; the mode shapes are left in `out`/modes at the end. `typed` is the command line.

    Raises InputError for dimensions that cannot be, SolveError or RuntimeError if the numerics fail.
    """
    job = Run(case, detail, workshop)
    s, fit = specimen(case, detail, workshop)
    with job.progress.stage("mesh") as stage:
        mesh = s.mesh(detail.working)
        stage.note = f"{len(mesh.cells)} {mesh.kind}, {mesh.dofs} unknowns"
    bar = identify(case, s, fit)
    buckling, shapes = buckled_bar(job, s, bar)
    solids = solid_stage(job, s)
    springs = spring_stage(job, s, bar, buckling, solids)
    table = whole_manipulator(case, workshop)
    limit = yielding_of(s, case.material.yield_MPa)
    planes: Planes = {(p.q_deg, *p.held): p.plane for p in solids.paths}
    buckling = marked_buckling(buckling, limit)
    springs = marked(springs, planes, limit)
    for path in (*shapes, *bent_linkage(job, s, solids.loads)):
        # Late, so that an interrupted run leaves no new shapes beside an old result.
        with replacing(out / "modes" / path.name) as part:
            shutil.copyfile(path, part)
    return Result(
        schema_version=1,
        case=case.name,
        title=case.title,
        detail=detail.name,
        length_mm=case.linkage.length_mm,
        width_mm=case.linkage.width_mm,
        bar=bar,
        buckling=buckling,
        parallelogram=springs.parallelogram,
        critical=springs.critical,
        curves=springs.curves,
        validity=springs.validity,
        refinement=springs.refinement,
        agreement=springs.agreement,
        orthoglide=table,
        errata=springs.errata,
        warnings=alarms(
            bar, buckling, springs.parallelogram, springs.critical, springs.curves, springs.refinement, table
        ),
        yield_MPa=case.material.yield_MPa,
        story=story(bar, buckling, springs, table, limit),
        seconds=dict(job.progress.seconds),
        **made_with(),
        command=typed,
        seed=SEED,
        solver="pardiso" if has_pardiso() else "SuperLU",
        sources=list(SOURCES),
    )


def marked(springs: Springs, planes: Planes, limit: Yielding | None) -> Springs:
    """Critical loads, curves and limits of the linear model with their stress, where a yield stress is known."""
    return springs.model_copy(
        update={
            "critical": marked_critical(springs.critical, limit),
            "curves": marked_curves(springs.curves, planes, limit),
            "validity": marked_validity(springs.validity, springs.curves, planes, limit),
        }
    )


def story(
    bar: Bar, buckling: list[Buckling], springs: Springs, table: list[Table1], limit: Yielding | None
) -> list[str]:
    """The findings in sentences."""
    told = tell(bar, buckling, springs.parallelogram, springs.critical, springs.validity)
    if limit is not None:
        both = 2.0 * limit.limit * limit.area
        told += yield_sentences(limit.limit, both, buckling, springs.critical, springs.curves)
    return [*told, *table_sentences(table)]


def buckled_bar(job: Run, s: Specimen, bar: Bar) -> tuple[list[Buckling], list[Path]]:
    """Buckling of the bar, and the files with its mode shapes."""
    folder = job.workshop.files("bar buckling", s.inputs)
    records = job.workshop.reuse(
        "bar buckling",
        s.inputs,
        list[Buckling],
        lambda stage: buckle_bar(s, bar.convergence, folder, stage),
        mode_files(),
    )
    return records, [folder / name for name in mode_files()]


def solid_stage(job: Run, s: Specimen) -> Solids:
    """The parallelogram as solid finite elements."""
    inputs, keep = job.inputs(s), job.workshop.reuse
    stiffness = keep(
        "linkage stiffness", inputs, list[SolidStiffness], lambda _: solid_stiffness(job.case, s)
    )
    loads = keep(
        "linkage buckling", inputs, list[SolidBuckling], lambda stage: solid_buckling(job.case, s, stage)
    )

    followed = keep(
        "linkage load paths", inputs, list[SolidPath], lambda stage: solid_paths(job.case, s, stage)
    )
    steps = keep("step study", inputs, Refinement, lambda stage: solid_study(job.case, s, stage))
    return Solids(stiffness, loads, followed, steps)


def bent_linkage(job: Run, s: Specimen, loads: list[SolidBuckling]) -> list[Path]:
    """Files of the linkage bent at each critical load."""
    inputs, name = job.inputs(s), "linkage shapes"
    folder = job.workshop.files(name, inputs)
    names = job.workshop.reuse(
        name,
        inputs,
        list[str],
        lambda stage: linkage_shapes(job.case, s, loads, folder, stage),
        tuple(shape_name(it.q_deg, it.held) for it in loads),
    )
    return [folder / file for file in names]


def spring_stage(job: Run, s: Specimen, bar: Bar, buckled: list[Buckling], solids: Solids) -> Springs:
    """Virtual springs and frame beside the solid, and the paper's errata."""
    k_b, case = np.array(bar.stiffness), job.case

    def compare(_: Stage) -> Springs:
        springs, body = spring_set(case, k_b), s.segments[len(s.segments) // 2]
        curves = curve_records(case, s, k_b, springs, solids.paths, solids.loads, buckled)
        first = {(b.q_deg, *b.held): b.planes[0] for b in solids.loads}
        pairs = [(p, bar_mode(buckled, p.held, first[p.q_deg, *p.held])) for p in solids.paths]
        studies = refinements(case, s, k_b, solids.loads, pairs, solids.steps)
        return Springs(
            parallelogram=stiffness_records(case, bar, solids.stiffness),
            critical=critical_records(s, k_b, springs, solids.loads, buckled),
            curves=curves,
            validity=validity_records(curves, solids.paths),
            refinement=studies,
            agreement=agreement_sentences(
                curves, solids.paths, solids.loads, studies, body, case.linkage.length_mm
            ),
            errata=printed_errata(),
        )

    return job.workshop.reuse("virtual springs", job.inputs(s), Springs, compare)


def printed_errata() -> list[Erratum]:
    """The slips of the paper with their evidence in words."""
    return [
        Erratum(
            number=e.number,
            place=e.place,
            printed=e.printed,
            correct=e.correct,
            evidence="; ".join(f"{name}: {value:.5g}" for name, value in e.evidence.items()),
            numbers=dict(e.evidence),
        )
        for e in errata()
    ]
