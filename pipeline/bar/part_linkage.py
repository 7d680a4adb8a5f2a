"""The parallelogram of two brought bars: K_p, critical loads and load paths, solid beside virtual springs and frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fem.anisotropic import Regional
from fem.beam import Segment
from fem.material import Isotropic
from fem.part_bar import PartBar
from fem.slices.solver import SolverOf
from fem.space import Space
from meshes.solid import Floats
from pipeline.progress import Progress
from pipeline.validation.agreement import agreement_sentences
from pipeline.validation.case_tables import LinkageSize
from pipeline.validation.comparison import stiffness_record
from pipeline.validation.critical import bar_mode, critical_records, solid_records, spring_records
from pipeline.validation.curves import curve, curve_records, path_error, solid_curves, validity_records
from pipeline.validation.detail import Detail
from pipeline.validation.entries import ENTRIES
from pipeline.validation.result import Buckling, Critical, Curve, Parallelogram, Refinement, Validity
from pipeline.validation.stages.followed import each_path
from pipeline.validation.stages.linkage import SolidBuckling, SolidPath, solid_buckling, solid_stiffness
from pipeline.validation.stages.refinement import solid_meshes, spring_segments
from pipeline.validation.stages.springs import SpringLinkage, SpringSet, linear_slope, spring_set
from reports.formats import NEGLIGIBLE

COUPLED = (
    "The bar's K_b couples what a bar with two planes of symmetry keeps apart ({entries}): Eq. 11, the beam formulas, "
    "the frame and the curves and critical loads of virtual springs are made for such a bar and are not that of this "
    "linkage. K_p by VJM (Eq. 10) and by solid FE hold; where Eq. 11 is shown it has the eight entries alone."
)
NO_PATHS = (
    "Load paths of the solid are made of one isotropic material; this bar has regions or axes, so that there are no "
    "curves of force and deflection."
)
NO_FORMULA = (
    "Beam formulas of critical loads are left out: they are those of a uniform beam between two equal soft ends, and "
    "no such beam has this K_b (a bar that is short, or whose ends differ)."
)


@dataclass(frozen=True, eq=False)
class Sizes:
    """The dimensions of the linkage."""

    linkage: LinkageSize


@dataclass(frozen=True, eq=False)
class PartSpecimen:
    """One bar on two meshes, as the stages of a linkage take it: `bar` has the working mesh, `coarse` that of paths."""

    bar: PartBar
    coarse: PartBar
    tie: str
    detail: Detail

    @property
    def material(self) -> Isotropic | Regional:
        return self.bar.material

    @cached_property
    def space(self) -> Space:
        """Of the working mesh, its ends as they are tied."""
        return self.bar.model(self.tie).linkage.members[0].space

    @property
    def solver_of(self) -> SolverOf:
        """Of linkages of bars on the working mesh."""
        return self.bar.solver_of

    @cached_property
    def path_space(self) -> Space:
        """Of the mesh of load paths."""
        return self.coarse.model(self.tie).linkage.members[0].space

    @cached_property
    def stiffness(self) -> Floats:
        """(6, 6) K_b of the working mesh, ends rigid."""
        return self.bar.model(self.tie).stiffness

    @property
    def segments(self) -> Sequence[Segment]:
        """A uniform beam with the bar's own EA, EI, GJ; its shear is not known apart from its ends."""
        k, length = self.stiffness, self.bar.length
        return [Segment(length, k[0, 0] * length, self.bending("xz"), self.bending("xy"), k[3, 3] * length)]

    def bending(self, plane: str) -> float:
        """EI, N·mm², of the uniform bar that turns its tip as much under a moment in this plane."""
        turn = {"xz": 4, "xy": 5}[plane]
        return self.bar.length / float(np.linalg.inv(self.stiffness)[turn, turn])

    @property
    def plain(self) -> PartSpecimen:
        """The same without what was worked out, to be sent to another process."""
        bars = {id(b): PartBar(b.mesh, b.length, b.material, b.bores) for b in (self.bar, self.coarse)}
        return PartSpecimen(bars[id(self.bar)], bars[id(self.coarse)], self.tie, self.detail)


@dataclass(frozen=True, eq=False)
class PartLinkage:
    """What was found; `planes`: of the lowest mode by (q_deg, *held), in which the bars of a path bend."""

    parallelogram: list[Parallelogram]
    critical: list[Critical]
    curves: list[Curve]
    validity: list[Validity]
    refinement: list[Refinement]
    agreement: list[str]
    left_out: list[str]
    planes: dict[tuple[object, ...], str]
    loads: list[SolidBuckling]

    @property
    def coupled(self) -> bool:
        """Whether the bar couples what Eq. 11 keeps apart."""
        return any(said.startswith(COUPLED.partition("{")[0]) for said in self.left_out)


def couplings(stiffness: Floats) -> list[str]:
    """Entries of a 6x6 beside the eight that are not negligible, largest first, by name with their share."""
    root = np.sqrt(np.diag(stiffness))
    share = np.abs(stiffness) / np.outer(root, root)
    found = {
        f"K{i + 1}{j + 1}": float(share[i, j])
        for i in range(6)
        for j in range(i + 1, 6)
        if (i, j) not in ENTRIES.values() and share[i, j] > NEGLIGIBLE
    }
    return [
        f"{name}, {100 * value:.2g} % of the root of its diagonal entries"
        for name, value in sorted(found.items(), key=lambda each: -each[1])
    ]


def eight_alone(stiffness: Floats) -> Floats:
    """(6, 6) with the eight entries of a bar with two planes of symmetry and zero beside them."""
    out = np.zeros((6, 6))
    for i, j in ENTRIES.values():
        out[i, j] = out[j, i] = stiffness[i, j]
    return out


def part_linkage(
    sizes: Sizes, s: PartSpecimen, limit: Floats, bars: Sequence[Buckling], progress: Progress
) -> PartLinkage:
    """All of it. limit: (6, 6) K_b without mesh error; bars: critical loads of one bar.

    SolveError, RuntimeError if the numerics fail.
    """
    coupled = couplings(s.stiffness)
    stiffness = s.stiffness if coupled else eight_alone(s.stiffness)
    with progress.stage("linkage stiffness"):
        solids = solid_stiffness(sizes, s)
        matrices = [stiffness_record(sizes, stiffness, limit, each) for each in solids]
    with progress.stage("linkage buckling") as stage:
        loads = solid_buckling(sizes, s, stage)
    left_out = [COUPLED.format(entries="; ".join(coupled))] if coupled else []
    paths: list[SolidPath] = []
    if isinstance(s.material, Isotropic):
        with progress.stage("linkage load paths") as stage:
            paths = each_path(sizes, s.plain, stage)
    else:
        left_out.append(NO_PATHS)
    with progress.stage("virtual springs"):
        return _compared(sizes, s, stiffness, bool(coupled), matrices, loads, paths, bars, left_out)


def _compared(
    sizes: Sizes,
    s: PartSpecimen,
    stiffness: Floats,
    coupled: bool,
    matrices: list[Parallelogram],
    loads: list[SolidBuckling],
    paths: list[SolidPath],
    bars: Sequence[Buckling],
    left_out: list[str],
) -> PartLinkage:
    """Springs, frame and formulas beside the solid; of a bar that couples the linear model alone."""
    planes: dict[tuple[object, ...], str] = {(p.q_deg, *p.held): p.plane for p in paths}
    if coupled:
        critical = [record for each in loads for record in solid_records(each, bars)]
        curves = [each for path in paths for each in _linear_and_solid(sizes, stiffness, path, loads, bars)]
        return PartLinkage(matrices, critical, curves, [], [], [], left_out, planes, loads)
    springs = spring_set(sizes, stiffness)
    curves = curve_records(sizes, s, stiffness, springs, paths, loads, bars)
    studies = _studies(sizes, s, stiffness, loads, paths, bars)
    length = sizes.linkage.length_mm
    critical, said = _critical(s, stiffness, springs, loads, bars)
    left_out = [*left_out, *said]
    return PartLinkage(
        matrices,
        critical,
        curves,
        validity_records(curves, paths),
        studies,
        agreement_sentences(curves, paths, loads, studies, s.segments[0], length) if paths else [],
        left_out,
        planes,
        loads,
    )


def _critical(
    s: PartSpecimen,
    stiffness: Floats,
    springs: SpringSet,
    loads: Sequence[SolidBuckling],
    bars: Sequence[Buckling],
) -> tuple[list[Critical], list[str]]:
    """Critical loads by every model; without the formulas where K_b is that of no beam between two equal ends."""
    try:
        return critical_records(s, stiffness, springs, loads, bars), []
    except ValueError:
        records = []
        for each in loads:
            records += [*solid_records(each, bars), *spring_records(springs, each)]
        return records, [NO_FORMULA]


def _linear_and_solid(
    sizes: Sizes, stiffness: Floats, path: SolidPath, loads: Sequence[SolidBuckling], bars: Sequence[Buckling]
) -> list[Curve]:
    """LIN of Eq. 10, which reads all entries, and the solid."""
    slope = linear_slope(SpringLinkage(sizes, stiffness, path.q_deg).eliminated, path.q_deg, path.held)
    ends = np.array([path.tension_x[-1], 0.0, path.x[-1]])
    line = curve(path, "lin", "tip", ends, slope * ends, "LIN: the straight line of Eq. 10 with all of K_b")
    return [line, *solid_curves(path, path_error(path, loads, bars))]


def _studies(
    sizes: Sizes,
    s: PartSpecimen,
    stiffness: Floats,
    loads: Sequence[SolidBuckling],
    paths: Sequence[SolidPath],
    bars: Sequence[Buckling],
) -> list[Refinement]:
    """The solid's critical load on both meshes, and the springs' by their segments, at the first angle."""
    first = sizes.linkage.angles_deg[0]
    solids = {tuple(b.held): b for b in loads if b.q_deg == first}
    here = [path for path in paths if path.q_deg == first]
    found = [
        solid_meshes(s, path, solids[tuple(path.held)], bar_mode(bars, path.held, path.plane))
        for path in here
    ]
    found += [spring_segments(sizes, stiffness, solids[tuple(path.held)]) for path in here]
    return [each for each in found if each is not None]
