"""Where two models, meshes or routes of one report are farther apart than their band: the report's first lines."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from pipeline.manipulator.table_record import Table1
from pipeline.validation import bands
from pipeline.validation.agreement import force_at
from pipeline.validation.bands import Band
from pipeline.validation.entries import ENTRIES
from pipeline.validation.mode_alarms import mode_alarms
from pipeline.validation.quantities import force
from pipeline.validation.result import Bar, Buckling, Critical, Curve, Parallelogram, Refinement
from pipeline.validation.stages.axial import BENDING

FINER = "Choose a smaller mesh.size_mm, or run without --coarse."


@dataclass(frozen=True)
class Difference:
    """`what` differs by `share` of its reference, 0.1 for 10 %."""

    what: str
    share: float


def alarms(
    bar: Bar,
    buckling: Sequence[Buckling],
    parallelogram: Sequence[Parallelogram],
    critical: Sequence[Critical],
    curves: Sequence[Curve],
    refinement: Sequence[Refinement],
    table: Sequence[Table1],
) -> list[str]:
    """A sentence for each comparison of a run that is beyond its band, in the order of the report."""
    return [
        *bar_alarms(bar),
        *mode_alarms(bar, buckling),
        *linkage_alarms(parallelogram),
        *critical_alarms(critical),
        *path_alarms(curves, refinement),
        *table_alarms(table),
    ]


def beyond(title: str, band: Band, differences: Iterable[Difference], advice: str = "") -> list[str]:
    """One sentence about the differences that are larger than the band, with the largest of them; none if none is."""
    every = list(differences)
    worse = [d for d in every if not abs(d.share) <= band.value]
    if not worse:
        return []
    worst = max(worse, key=lambda d: abs(d.share) if d.share == d.share else np.inf)
    said = f"{title}: {worst.what}, {100 * worst.share:+.3g} %; the stated band is {band.text}."
    if len(every) > 1:
        said += f" {len(worse)} of {len(every)} are beyond it."
    return [f"{said} {advice}".rstrip()]


def bar_alarms(bar: Bar) -> list[str]:
    """K_b and K_g by every route."""
    found = []
    entries = (
        ("K_b of the solid bar against Eq. 12", bands.PAPER, bar.entries),
        ("K_b of the solid bar against the stepped beam", bands.BEAM, bar.oracle_entries),
        ("K_b by virtual experiments against the rigid tie", bands.SECOND_ROUTE, bar.second_route.entries),
    )
    for title, band, compared in entries:
        found += beyond(title, band, [Difference(e.entry, e.deviation) for e in compared])
    errors = [Difference(name, error) for name, error in bar.convergence.band.items()]
    found += beyond("Mesh error of K_b", bands.MESH, errors, FINER)
    if bar.axial is not None:
        solid = np.array(bar.axial.solid)
        for name, matrix in (("uniform beam", bar.axial.formula), ("refined springs", bar.axial.vjm)):
            off = [
                Difference(e, float(np.array(matrix)[ENTRIES[e]] / solid[ENTRIES[e]] - 1.0)) for e in BENDING
            ]
            found += beyond(f"K_g by the {name} against the solid", bands.AXIAL, off)
        errors = [Difference(name, bar.axial.band[name]) for name in BENDING]
        found += beyond("Mesh error of K_g", bands.MESH, errors, FINER)
    return found


def linkage_alarms(records: Sequence[Parallelogram]) -> list[str]:
    """K_p by solid and by Eq. 11, which has the K_b of the same mesh."""
    off = [Difference(f"worst entry at q = {r.q_deg:g}°", r.worst_fea_deviation) for r in records]
    return beyond("K_p of the solid parallelogram against Eq. 11", bands.LINKAGE, off)


def critical_alarms(records: Sequence[Critical]) -> list[str]:
    """Critical loads by beam formula and by distributed springs beside the solid's.

    Springs at one place differ by their nature: the report is about that.
    """
    found = []
    for title, chosen in (
        ("beam formula", [r for r in records if r.model == "beam formula" and r.ratio_to_solid is not None]),
        ("distributed springs", [r for r in records if r.spring_at == "distributed"]),
    ):
        off = [Difference(where(r), r.ratio_to_solid - 1.0) for r in chosen if r.ratio_to_solid is not None]
        found += beyond(f"Critical loads of the linkage, {title} against the solid", bands.CRITICAL, off)
        found += [not_found(title, r, records) for r in chosen if r.load_N is None]
    errors = [Difference(where(r), r.band) for r in records if r.band is not None]
    return [*found, *beyond("Mesh error of the linkage's critical loads", bands.MESH, errors, FINER)]


def where(record: Critical) -> str:
    """Which critical load it is."""
    return f"q = {record.q_deg:g}°, {', '.join(record.held)} held, {record.what}"


def not_found(title: str, record: Critical, records: Sequence[Critical]) -> str:
    """That a model has no critical load, how far it was looked for, and the lowest one of the solid there."""
    far = "" if record.searched_N is None else f" up to {force(record.searched_N)}"
    solids = [
        r.load_N
        for r in records
        if r.model == "solid" and (r.q_deg, r.held) == (record.q_deg, record.held) and r.load_N is not None
    ]
    beside = f", the solid has one at {force(min(solids))}" if solids else ""
    return (
        f"Critical loads of the linkage: no critical load found by {title}{far} for {where(record)}{beside}."
    )


def path_alarms(curves: Sequence[Curve], studies: Sequence[Refinement]) -> list[str]:
    """Loads on the paths of frame and distributed springs beside the solid's, and what refining the paths changes."""
    found = []
    for model in ("frame", "vjm"):
        off = [d for solid in curves if solid.model == "fea" for d in path_difference(solid, curves, model)]
        name = "frame" if model == "frame" else "distributed springs"
        found += beyond(f"Load paths, {name} against the solid", bands.PATH, off)
    meshes = [s for s in studies if s.refined == "unknowns a bar"]
    others = [s for s in studies if s.refined != "unknowns a bar"]
    found += beyond("Mesh error of the load paths", bands.MESH, map(refined, meshes), FINER)
    return [*found, *beyond("Refinement of the load paths", bands.REFINED, map(refined, others))]


def refined(study: Refinement) -> Difference:
    """What refining makes of one number of a path."""
    where = f"{study.model}, {study.refined}, q = {study.q_deg:g}°, {', '.join(study.held)} held"
    return Difference(where, study.band)


def path_difference(solid: Curve, curves: Sequence[Curve], model: str) -> list[Difference]:
    """The largest difference of a model's loads to those of a solid path in compression, at its displacements."""
    x, force = np.array(solid.x_mm[1:]), np.array(solid.fx_N[1:])
    same = [
        c
        for c in curves
        if (c.model, c.spring_at, c.q_deg, c.held) == (model, "distributed", solid.q_deg, solid.held)
        and c.x_mm[-1] < 0.0
    ]
    if not same or not len(x) or x[-1] > 0.0:
        return []
    off = force_at(same, x) / force - 1.0
    if np.isnan(off).all():
        return []
    worst = int(np.nanargmax(np.abs(off)))
    where = f"q = {solid.q_deg:g}°, {', '.join(solid.held)} held, x = {x[worst]:.4g} mm"
    return [Difference(where, float(off[worst]))]


def table_alarms(tables: Sequence[Table1]) -> list[str]:
    """The whole manipulator by springs and by frame elements.

    How far both are from the paper's cells is what its table is there to show.
    """
    off = [
        Difference("K_tran" if a.K_tran >= a.K_rot else "K_rot", max(a.K_tran, a.K_rot))
        for table in tables
        for a in table.agreement
    ]
    return beyond("Table 1, virtual springs against frame elements", bands.TABLE, off)
