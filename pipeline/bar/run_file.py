"""`run` of a bar that comes as a file: the bar, the parallelogram of two of them, the result put together."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from fem.material import Isotropic
from pipeline.bar.brought_bar import said_of
from pipeline.bar.of_file import bar_of_placed, place
from pipeline.bar.part_linkage import PartLinkage, PartSpecimen, Sizes, part_linkage
from pipeline.bar.part_result import PartResult
from pipeline.bar.record import BarRecord
from pipeline.bar.stress import stress_sentences
from pipeline.bar.tables import FileCase
from pipeline.errors import InputError
from pipeline.progress import Progress
from pipeline.validation.alarms import critical_alarms, linkage_alarms, path_alarms
from pipeline.validation.case_tables import LinkageSize
from pipeline.validation.detail import COARSE, DEFAULT, Detail
from pipeline.validation.quantities import force
from pipeline.validation.result import Buckling, Critical, Curve
from pipeline.validation.run import SOURCES
from pipeline.validation.stages.linkage_shapes import linkage_shapes
from pipeline.validation.story import (
    critical_sentences,
    linkage_sentences,
    marked,
    validity_sentences,
    yield_sentences,
)
from pipeline.validation.yielding import Yielding, marked_critical, marked_curves, marked_validity


def run_file(
    case: FileCase, path: Path, detail: Detail, out: Path, progress: Progress, typed: str
) -> PartResult:
    """All stages; mode shapes to `out`/modes. path: of the case, or where it was named.

    detail: COARSE or DEFAULT. InputError for a case or file that cannot be used, SolveError or RuntimeError if the
    numerics fail.
    """
    if case.linkage is None:
        raise InputError(
            f"{path}: linkage is missing, allowed is [linkage] with width_mm; the command bar needs none"
        )
    file = case.path(path.parent)
    with progress.stage("read and mesh"):
        placed = said_of(file, lambda: place(case, file))
    sizes = Sizes(
        LinkageSize(
            length_mm=placed.frame.length,
            width_mm=case.linkage.width_mm,
            angles_deg=case.linkage.angles_deg,
        )
    )
    bar = bar_of_placed(case, file, placed, out, progress, typed)
    fine, coarse = placed.bars[-1 if detail is DEFAULT else 0], placed.bars[0]
    s = PartSpecimen(fine, coarse, case.bar.rigid_tie, detail)
    found = part_linkage(sizes, s, np.array(bar.stiffness), bar.buckling, progress)
    if isinstance(s.material, Isotropic):
        with progress.stage("linkage shapes") as stage:
            linkage_shapes(sizes, s, found.loads, out / "modes", stage)
    return put_together(case, detail, bar, s, found, progress, typed)


def put_together(
    case: FileCase,
    detail: Detail,
    bar: BarRecord,
    s: PartSpecimen,
    found: PartLinkage,
    progress: Progress,
    typed: str,
) -> PartResult:
    """The result, with stresses where the material has a yield stress."""
    limit = yielding(bar, s)
    critical = marked_critical(found.critical, limit)
    curves = marked_curves(found.curves, found.planes, limit)
    validity = marked_validity(found.validity, curves, found.planes, limit)
    assert bar.width_mm is not None
    return PartResult(
        case=case.name,
        title=bar.title,
        detail=detail.name,
        length_mm=bar.length_mm,
        width_mm=bar.width_mm,
        bar=bar,
        parallelogram=found.parallelogram,
        critical=critical,
        curves=curves,
        validity=validity,
        refinement=found.refinement,
        agreement=found.agreement,
        left_out=found.left_out,
        # Of a bar that couples Eq. 11 is no reference.
        warnings=[
            *([] if found.coupled else linkage_alarms(found.parallelogram)),
            *critical_alarms(critical),
            *path_alarms(curves, found.refinement),
        ],
        yield_MPa=None if limit is None else limit.limit,
        story=[
            *bar_sentences(bar),
            *([] if found.coupled else linkage_sentences(found.parallelogram)),
            *([each for each in critical_sentences(critical) if each] if found.agreement else []),
            *validity_sentences(validity),
            *([] if limit is None else yield_told(limit, bar, critical, curves)),
            *found.left_out,
            *(each for each in bar.said if each not in stress_sentences(bar.stress)),
        ],
        seconds=dict(progress.seconds),
        versions=bar.versions,
        commit=bar.commit,
        command=typed,
        sources=list(SOURCES),
    )


def yielding(bar: BarRecord, s: PartSpecimen) -> Yielding | None:
    """The bar as `pipeline.validation.yielding` takes one, from its stress under unit loads away from its ends.

    In place of N/A and M/W stand the peaks of the solid under a unit force along it and a unit moment about y or z.
    They may lie at different points: their sum is not below the largest stress of both. None without a yield stress.
    """
    if bar.stress is None or bar.stress.of("Fx").body.first_yield is None:
        return None
    axial = bar.stress.of("Fx").body
    assert axial.first_yield is not None
    moment = {plane: s.bending(plane) for plane in ("xy", "xz")}
    peaks = {"xy": bar.stress.of("Mz").body.stress, "xz": bar.stress.of("My").body.stress}
    return Yielding(
        limit=axial.first_yield * axial.stress,
        area=1.0 / axial.stress,
        length=bar.length_mm,
        modulus=1.0,
        moment=moment,
        fibre={plane: peaks[plane] * moment[plane] for plane in moment},
    )


def bar_sentences(bar: BarRecord) -> list[str]:
    """How well K_b is known, what limits it, and where the bar alone buckles and yields."""
    said = []
    for name, band in (("its mesh", bar.numerical_band), ("the tie of its ends", bar.modelling_band)):
        if any(band.values()):
            worst = max(band, key=lambda entry: band[entry])
            said.append(
                f"K_b is known to {100 * band[worst]:.2g} % by {name} in its worst entry ({worst}), to "
                f"{100 * float(np.median(list(band.values()))):.2g} % in the middle one."
            )
    firsts = ", ".join(f"{b.supports} {marked(b)} in {b.plane}" for b in first_modes(bar.buckling))
    by_tip = f"One bar alone buckles, by how its tip is held: {firsts}."
    return [*stress_sentences(bar.stress), *said, by_tip]


def first_modes(records: Sequence[Buckling]) -> list[Buckling]:
    """The lowest mode of the solid under each support."""
    return [b for b in records if b.model == "solid" and b.mode == 1]


def yield_told(limit: Yielding, bar: BarRecord, critical: list[Critical], curves: list[Curve]) -> list[str]:
    """What the yield stress makes of the loads, and what it is measured by."""
    both = 2.0 * limit.limit * limit.area
    return [
        *yield_sentences(limit.limit, both, bar.buckling, critical, curves),
        "Stresses of the linkage are those of the solid bar under unit loads away from its ends, those of pull and of "
        f"bending added: {force(limit.limit * limit.area)} a bar where it stays straight.",
    ]


def detail_of(coarse: bool, fine: bool, path: Path) -> Detail:
    """The level of detail; InputError for one that a file does not have."""
    if fine:
        raise InputError(
            f"{path}: --fine is for a bar with a section, allowed for a file is a smaller mesh.size_mm"
        )
    return COARSE if coarse else DEFAULT
