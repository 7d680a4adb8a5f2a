"""The bar's K_b identified and checked every way there is."""

from dataclasses import asdict

import numpy as np

from fem.beam import one_end_warping_factor, stepped_stiffness
from fem.linkage import PLATFORM
from fem.virtual_experiments import virtual_experiments
from meshes.quality import quality
from meshes.solid import Floats
from pipeline.validation.case import Case
from pipeline.validation.entries import compared, rows
from pipeline.validation.geometry import described
from pipeline.validation.result import Bar as BarResult
from pipeline.validation.result import Fit, SecondRoute, Solve
from pipeline.validation.stages.axial import axial_record
from pipeline.validation.stages.mesh_study import MeshStudy, mesh_study
from pipeline.validation.stages.specimen import Specimen

WRENCH = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")


def identify(case: Case, s: Specimen, fit: Fit | None) -> BarResult:
    """K_b of the bar with its checks: laws, closed form, second route, convergence."""
    inputs = [*s.inputs, case.model_dump(mode="json")]
    study = s.workshop.reuse("mesh study", inputs, MeshStudy, lambda stage: mesh_study(s, stage))
    return s.workshop.reuse("bar stiffness", inputs, BarResult, lambda _: identified(case, s, fit, study))


def identified(case: Case, s: Specimen, fit: Fit | None, study: MeshStudy) -> BarResult:
    """The bar's record."""
    mesh, bar = s.space.mesh, s.bar
    r = s.model.reduction
    factor = s.model.factor(r.others(PLATFORM), few=True)
    raw = s.model.energy_products(s.model.motions(PLATFORM, (), factor))
    stiffness = 0.5 * (raw + raw.T)
    paper = None if case.paper is None else np.array(case.paper.bar_stiffness)
    against_paper = [] if paper is None else compared(stiffness, paper)
    oracle = stepped_stiffness(s.segments)
    q = quality(mesh, bar)
    return BarResult(
        section=described(bar.section),
        length_mm=bar.length,
        lug=None if bar.lug is None else {f"{k}_mm": v for k, v in asdict(bar.lug).items()},
        material=material_of(case),
        constants={k: float(v) for k, v in asdict(s.constants).items()},
        stiffness=rows(stiffness),
        paper=None if paper is None else rows(paper),
        worst_entry_error=max((abs(e.deviation) for e in against_paper), default=None),
        entries=against_paper,
        oracle=rows(oracle),
        oracle_entries=compared(stiffness, oracle),
        second_route=second_route(s, stiffness),
        fit=fit,
        dofs=mesh.dofs,
        cells=len(mesh.cells),
        cell_kind=mesh.kind,
        quality=asdict(q),
        laws=laws(s, raw),
        convergence=study.convergence,
        axial=axial_record(s, stiffness, study),
        solve=Solve(**asdict(factor.record)),
    )


def material_of(case: Case) -> dict[str, float | str]:
    """The material of a case, with its yield stress where it has one."""
    m = case.material
    limit = {} if m.yield_MPa is None else {"yield_MPa": m.yield_MPa}
    return {"E_MPa": m.E_MPa, "nu": m.nu, **limit, "source": m.source}


def laws(s: Specimen, raw: Floats) -> dict[str, float]:
    """How well K_b (6, 6), not yet made symmetric, keeps the laws that any elastic body keeps."""
    points, matrix = s.space.mesh.points, s.model.matrices[0]
    worst = 0.0
    for motion in (*np.eye(3), *(np.cross(e, points / s.bar.length) for e in np.eye(3))):
        u = np.broadcast_to(motion, points.shape).ravel()
        worst = max(worst, float(np.abs(matrix @ u).max()))
    scale = np.sqrt(np.outer(np.diag(raw), np.diag(raw)))
    eigenvalues = np.linalg.eigvalsh(0.5 * (raw + raw.T) / scale)
    return {
        "asymmetry": float(np.max(np.abs(raw - raw.T) / scale)),
        "rigid_motion_force_share": worst / float(abs(matrix).max()),
        "smallest_scaled_eigenvalue": float(eigenvalues[0]),
    }


def second_route(s: Specimen, tied: Floats) -> SecondRoute:
    """K_b by virtual experiments beside that of the rigid tie (6, 6), with the reason for the difference."""
    found = virtual_experiments(s.space.mesh, s.bar.length, s.material)
    entries = compared(found.stiffness, tied)
    worst = max(entries, key=lambda e: abs(e.deviation))
    body = s.segments[len(s.segments) // 2]
    bare = 1.0 - 1.0 / one_end_warping_factor(body)
    lower = sum(e.deviation < 0.0 for e in entries)
    explanation = (
        f"The rigid tie holds the tip face plane, the virtual experiments let it warp and bulge: {lower} of the eight "
        f"entries come out lower, {worst.entry} differs most ({100 * worst.deviation:.2f} %)."
    )
    if bare > 0.001:
        explanation += (
            f" A section that runs to the tip would lose {100 * bare:.1f} % of K44 by warping freely there"
            + ("; the solid lugs hold most of it." if s.bar.lug else ".")
        )
    return SecondRoute(
        stiffness=rows(found.stiffness),
        entries=entries,
        leftover={name: float(x) for name, x in zip(WRENCH, found.leftover, strict=True)},
        explanation=explanation,
    )
