"""The bar: its geometry found or given, its K_b identified and checked every way there is."""

from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np
from pydantic import BaseModel

from fem.beam import Segment, one_end_warping_factor, stepped_stiffness
from fem.convergence import extrapolate
from fem.linear import LinearModel
from fem.linkage import PLATFORM, single_bar
from fem.material import Isotropic
from fem.section_constants import SectionConstants, section_constants
from fem.space import Space
from fem.stiffness import bar_stiffness
from fem.virtual_experiments import virtual_experiments
from meshes.bar import Bar, Lug
from meshes.quality import quality
from meshes.resolution import Resolution
from meshes.section import ISection, Rectangle
from meshes.solid import Floats, SolidMesh
from meshes.store import cached_mesh, require_workable
from pipeline.errors import InputError
from pipeline.progress import Stage
from pipeline.validation.case import Case
from pipeline.validation.detail import Detail
from pipeline.validation.entries import ENTRIES, compared, rows
from pipeline.validation.geometry import bar_of, described
from pipeline.validation.reference_bar import Family, find_bar
from pipeline.validation.result import Bar as BarResult
from pipeline.validation.result import Convergence, Fit, SecondRoute
from pipeline.validation.workshop import Workshop

WRENCH = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")


@dataclass(frozen=True)
class Specimen:
    """The bar as geometry with everything that makes its meshes."""

    bar: Bar
    material: Isotropic
    size: float
    detail: Detail
    workshop: Workshop

    def mesh(self, level: int) -> SolidMesh:
        """The mesh of one level, from the cache if it is there; InputError for a mesh size that cannot work."""
        try:
            return cached_mesh(self.bar, Resolution(self.size, level), self.workshop.meshes)
        except ValueError as error:
            raise InputError(f"mesh: {error}") from error

    @cached_property
    def space(self) -> Space:
        """Displacement space of the working mesh."""
        return Space.of(self.mesh(self.detail.working))

    @cached_property
    def path_space(self) -> Space:
        """Displacement space of the mesh for load paths."""
        return Space.of(self.mesh(self.detail.path))

    @cached_property
    def constants(self) -> SectionConstants:
        """Of the section between the lugs."""
        return section_constants(self.bar.section, self.material.nu)

    @cached_property
    def segments(self) -> list[Segment]:
        """The bar as a stepped beam."""
        body_length = self.bar.length - (2 * self.bar.lug.length if self.bar.lug else 0.0)
        body = Segment.of(self.constants, self.material, body_length)
        if self.bar.lug is None:
            return [body]
        block = section_constants(Rectangle(self.bar.lug.width, self.bar.lug.height), self.material.nu)
        lug = Segment.of(block, self.material, self.bar.lug.length)
        return [lug, body, lug]

    @property
    def inputs(self) -> list[object]:
        """What every result of this bar depends on."""
        return [repr(self.bar), repr(self.material), self.size, self.detail.name]


class FoundBar(BaseModel):
    """Dimensions of a bar that was searched for, and how the search went."""

    flange_width: float
    flange_thickness: float
    height: float
    web: float
    lug: tuple[float, float, float]
    fit: Fit


def checked_sizes(s: Specimen, width: float) -> Specimen:
    """The specimen; InputError if its finest mesh cannot be or its bars overlap, before anything is solved."""
    try:
        require_workable(s.bar, Resolution(s.size, max(s.detail.study)))
    except ValueError as error:
        raise InputError(f"mesh: {error}") from error
    tall = max(s.bar.section.size[1], s.bar.lug.height if s.bar.lug else 0.0)
    if width <= tall:
        raise InputError(f"linkage.width_mm is {width:g}, allowed is above the bars' height, {tall:g} mm")
    return s


def specimen(case: Case, detail: Detail, workshop: Workshop) -> tuple[Specimen, Fit | None]:
    """The bar of a case: as dimensioned, or searched for; InputError if the dimensions cannot be."""
    material = Isotropic(case.material.E_MPa, case.material.nu, case.material.source)
    length = case.linkage.length_mm
    if case.bar.family is None:
        given = Specimen(bar_of(case.bar, length), material, case.mesh.size_mm, detail, workshop)
        return checked_sizes(given, case.linkage.width_mm), None
    inputs = [case.model_dump(mode="json"), detail.name]
    found = workshop.reuse(
        "reference bar", inputs, FoundBar, lambda stage: search(case, material, detail, workshop, stage)
    )
    section = ISection(found.flange_width, found.flange_thickness, found.height, found.web)
    bar = Bar(section, length, Lug(*found.lug))
    s = Specimen(bar, material, case.mesh.size_mm, detail, workshop)
    return checked_sizes(s, case.linkage.width_mm), found.fit


def search(case: Case, material: Isotropic, detail: Detail, workshop: Workshop, stage: Stage) -> FoundBar:
    """Search the family for the bar that meets the paper's matrix on the working mesh."""
    assert case.paper is not None
    target, length = np.array(case.paper.bar_stiffness), case.linkage.length_mm

    def solid(bar: Bar) -> Floats:
        trial = Specimen(bar, material, case.mesh.size_mm, detail, workshop)
        return bar_stiffness(trial.mesh(detail.working), length, material)

    def on_round(number: int, rms: float) -> None:
        stage.say(f"round {number}, {100 * rms:.2f} % root mean square")

    assert case.bar.lug_length_mm is not None
    found = find_bar(target, Family(length, case.bar.lug_length_mm), material, solid, on_round)
    s, lug = found.bar.section, found.bar.lug
    assert isinstance(s, ISection) and lug is not None
    fit = Fit(
        start=flat(found.start),
        found=flat(found.bar),
        entries=compared(found.stiffness, target),
        rms=float(np.sqrt(np.mean(found.misfits**2))),
        solves=found.solves,
    )
    return FoundBar(
        flange_width=s.flange_width,
        flange_thickness=s.flange_thickness,
        height=s.height,
        web=s.web,
        lug=(lug.length, lug.width, lug.height),
        fit=fit,
    )


def flat(bar: Bar) -> dict[str, float]:
    """Dimensions of a bar by name, mm."""
    section = {k: float(v) for k, v in asdict(bar.section).items()}  # type: ignore[call-overload]
    lug = {} if bar.lug is None else {f"lug_{k}": float(v) for k, v in asdict(bar.lug).items()}
    return {f"{k}_mm": v for k, v in (section | lug).items()}


def identify(case: Case, s: Specimen, fit: Fit | None) -> BarResult:
    """K_b of the bar with its checks: laws, closed form, second route, convergence."""
    inputs = [*s.inputs, case.model_dump(mode="json")]
    study = s.workshop.reuse("mesh study", inputs, Convergence, lambda stage: mesh_study(s, stage))
    return s.workshop.reuse("bar stiffness", inputs, BarResult, lambda _: identified(case, s, fit, study))


def identified(case: Case, s: Specimen, fit: Fit | None, study: Convergence) -> BarResult:
    """The bar's record."""
    mesh, bar = s.space.mesh, s.bar
    stiffness = working_stiffness(s)
    paper = None if case.paper is None else np.array(case.paper.bar_stiffness)
    against_paper = [] if paper is None else compared(stiffness, paper)
    oracle = stepped_stiffness(s.segments)
    q = quality(mesh, bar)
    return BarResult(
        section=described(bar.section),
        length_mm=bar.length,
        lug=None if bar.lug is None else {f"{k}_mm": v for k, v in asdict(bar.lug).items()},
        material={"E_MPa": s.material.E, "nu": s.material.nu, "source": s.material.source},
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
        laws=laws(s, stiffness),
        convergence=study,
    )


def working_stiffness(s: Specimen) -> Floats:
    """K_b on the working mesh."""
    return LinearModel(single_bar(s.space, s.bar.length), s.material).stiffness


def laws(s: Specimen, stiffness: Floats) -> dict[str, float]:
    """How well K_b keeps the laws that any elastic body keeps."""
    model = LinearModel(single_bar(s.space, s.bar.length), s.material)
    points, matrix = s.space.mesh.points, model.matrices[0]
    worst = 0.0
    for motion in (*np.eye(3), *(np.cross(e, points / s.bar.length) for e in np.eye(3))):
        u = np.broadcast_to(motion, points.shape).ravel()
        worst = max(worst, float(np.abs(matrix @ u).max()))
    raw = model.energy_products(model.motions(PLATFORM, ()))
    scale = np.sqrt(np.outer(np.diag(raw), np.diag(raw)))
    eigenvalues = np.linalg.eigvalsh(stiffness / scale)
    return {
        "asymmetry": float(np.max(np.abs(raw - raw.T) / scale)),
        "rigid_motion_force_share": worst / float(abs(matrix).max()),
        "smallest_scaled_eigenvalue": float(eigenvalues[0]),
    }


def second_route(s: Specimen, tied: Floats) -> SecondRoute:
    """K_b by virtual experiments beside the rigid tie, with the reason for the difference."""
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


def mesh_study(s: Specimen, stage: Stage) -> Convergence:
    """K_b over nested meshes, extrapolated entry by entry."""
    matrices, dofs = [], []
    for level in s.detail.study:
        mesh = s.mesh(level)
        stage.say(f"{mesh.dofs} unknowns")
        matrices.append(bar_stiffness(mesh, s.bar.length, s.material))
        dofs.append(mesh.dofs)
    sizes = [s.size / level for level in s.detail.study]
    working = s.detail.study.index(s.detail.working)
    limit = np.zeros((6, 6))
    entries, orders, band = {}, {}, {}
    for name, (i, j) in ENTRIES.items():
        values = [float(k[i, j]) for k in matrices]
        found = extrapolate(sizes, values)
        limit[i, j] = limit[j, i] = found.limit
        entries[name], orders[name] = values, found.order if found.order == found.order else 0.0
        band[name] = found.band(values[working])
    return Convergence(
        dofs=dofs,
        sizes_mm=sizes,
        entries=entries,
        K22=entries["K22"],
        observed_order=orders["K22"],
        orders=orders,
        extrapolated=rows(limit),
        band=band,
    )
