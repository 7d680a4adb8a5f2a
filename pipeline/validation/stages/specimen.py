"""The bar of a case as geometry with everything that makes its meshes: as dimensioned, or searched for."""

from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np
from pydantic import BaseModel

from fem.beam import Segment
from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.material import Isotropic
from fem.section_constants import SectionConstants, section_constants
from fem.slices.solver import SolverOf, by_chain
from fem.space import Space
from fem.stiffness import bar_stiffness
from meshes.bar import Bar, Lug
from meshes.resolution import Resolution
from meshes.section import ISection, Rectangle
from meshes.solid import Floats, SolidMesh
from meshes.store import cached_mesh
from meshes.workable import require_workable
from pipeline.errors import InputError
from pipeline.progress import Stage
from pipeline.validation.case import Case
from pipeline.validation.detail import Detail
from pipeline.validation.entries import compared
from pipeline.validation.geometry import bar_of, overlapping
from pipeline.validation.reference_bar import Family, find_bar
from pipeline.validation.result import Fit
from pipeline.validation.workshop import Workshop


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
    def model(self) -> LinearModel:
        """The clamped bar on the working mesh; its matrix is kept."""
        clamped = single_bar(self.space, self.bar.length)
        return LinearModel(clamped, self.material, self.solver_of(clamped))

    @cached_property
    def solver_of(self) -> SolverOf:
        """Of linkages of bars on the working mesh."""
        return by_chain(self.space.mesh, self.material)

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


def checked_sizes(s: Specimen, case: Case) -> Specimen:
    """The specimen; InputError if its finest mesh cannot be or its bars overlap, before anything is solved."""
    try:
        require_workable(s.bar, Resolution(s.size, max(s.detail.study)))
    except ValueError as error:
        raise InputError(f"mesh: {error}") from error
    tall = max(s.bar.section.size[1], s.bar.lug.height if s.bar.lug else 0.0)
    if said := overlapping(case.linkage.width_mm, case.linkage.angles_deg, tall):
        raise InputError(said)
    return s


def specimen(case: Case, detail: Detail, workshop: Workshop) -> tuple[Specimen, Fit | None]:
    """The bar of a case: as dimensioned, or searched for; InputError if the dimensions cannot be."""
    material = Isotropic(case.material.E_MPa, case.material.nu, case.material.source)
    length = case.linkage.length_mm
    if case.bar.family is None:
        given = Specimen(bar_of(case.bar, length), material, case.mesh.size_mm, detail, workshop)
        return checked_sizes(given, case), None
    inputs = [case.model_dump(mode="json"), detail.name]
    found = workshop.reuse(
        "reference bar", inputs, FoundBar, lambda stage: search(case, material, detail, workshop, stage)
    )
    section = ISection(found.flange_width, found.flange_thickness, found.height, found.web)
    bar = Bar(section, length, Lug(*found.lug))
    s = Specimen(bar, material, case.mesh.size_mm, detail, workshop)
    return checked_sizes(s, case), found.fit


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
