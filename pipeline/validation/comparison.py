"""VJM, FEA and LIN side by side: stiffness, critical loads, curves, and how far LIN is good."""

from collections.abc import Sequence
from math import cos, radians

import numpy as np

from fem.euler import bending_of, critical_compression
from meshes.solid import Floats
from pipeline.validation.case import Case
from pipeline.validation.entries import rows
from pipeline.validation.result import Critical, Curve, Parallelogram, Validity
from pipeline.validation.stages.bar import Specimen
from pipeline.validation.stages.linkage import BOW, SolidBuckling, SolidPath, SolidStiffness
from pipeline.validation.stages.springs import PLACES, SpringLinkage, linear_slope
from vjm.closed_forms import middle_hinge_only
from vjm.stiffness import in_bar_frame, singular_values

DEVIATIONS = (0.01, 0.05)
# What bends sideways in each way of holding the platform: supports of each bar and its plane.
SIDEWAYS = {
    ("y", "z", "rx", "ry", "rz"): (("clamped", "xy"), ("pinned", "xz")),
    ("z", "rx", "ry", "rz"): (("guided", "xy"), ("pinned", "xz")),
    ("z",): (("free", "xy"),),
}
NAMED = {
    ("clamped", "xy"): "out of plane, platform fully held",
    ("pinned", "xz"): "in plane, between the pins",
    ("guided", "xy"): "out of plane, platform slides along y",
    ("free", "xy"): "out of plane, platform y and rz free",
}
NAME_OF = {
    "tip": "spring at tip",
    "middle": "spring at middle",
    "base": "spring at base",
    "distributed": "distributed",
}
WHY_PLACE = {
    "tip": "compression stretches the lever of the tip spring: it stabilises the bar's angle, and tension upsets it",
    "middle": "the rigid halves fold about the spring in mid-bar, whose translations (before the turn in Eq. 1) give",
    "base": "the rigid bar leans on the spring at its base hinge",
    "distributed": "the same K_b shared out over the bar, with its geometric stiffness",
}


def stiffness_records(case: Case, stiffness: Floats, solids: Sequence[SolidStiffness]) -> list[Parallelogram]:
    """K_p at every angle by closed form, VJM, solid finite elements and the paper, in the bar frame."""
    records = []
    for solid in solids:
        springs = SpringLinkage(case, stiffness, solid.q_deg)
        closed = springs.closed_form
        fea = in_bar_frame(np.array(solid.matrix), radians(solid.q_deg))
        filled = np.abs(closed) > 0.0
        paper = None
        if case.paper and case.paper.half_linkage_stiffness and case.paper.linkage_angle_deg == solid.q_deg:
            paper = rows(2.0 * np.array(case.paper.half_linkage_stiffness))
        records.append(
            Parallelogram(
                q_deg=solid.q_deg,
                closed_form=rows(closed),
                vjm=rows(springs.eliminated),
                fea=rows(fea),
                paper=paper,
                doubled_bar=rows(2.0 * stiffness),
                rank=int(springs.rank),
                singular_values_fea=[float(v) for v in singular_values(fea, case.linkage.length_mm)],
                frame="bar",
                worst_fea_deviation=float(np.max(np.abs(fea[filled] / closed[filled] - 1.0))),
            )
        )
    return records


def critical_records(
    case: Case, s: Specimen, stiffness: Floats, solids: Sequence[SolidBuckling]
) -> list[Critical]:
    """Every critical load of the linkage: solid, beam formulas, springs at three places and distributed."""
    records = []
    for solid in solids:
        for plane, load in lowest_by_plane(solid).items():
            records.append(
                Critical(
                    q_deg=solid.q_deg,
                    held=solid.held,
                    model="solid",
                    spring_at=None,
                    what=f"lowest mode in {plane}",
                    load_N=load,
                    ratio_to_solid=load / solid.loads[0],
                    why="linear buckling of two solid bars with pins and a rigid platform",
                )
            )
        records.extend(formula_records(s, stiffness, solid))
        records.extend(spring_records(case, stiffness, solid))
    return records


def lowest_by_plane(solid: SolidBuckling) -> dict[str, float]:
    """The lowest load of each plane among the modes that were computed, lowest first."""
    found: dict[str, float] = {}
    for plane, load in zip(solid.planes, solid.loads, strict=True):
        found.setdefault(plane, load)
    return found


def formula_records(s: Specimen, stiffness: Floats, solid: SolidBuckling) -> list[Critical]:
    """Both bars by Euler's formulas with the EI, shear and end softness identified from K_b.

    Off q = 0 a platform that is free to turn moves the tips of the two bars unequally out of plane: they are no
    longer two bars with one load, and there is no such formula.
    """
    body = s.segments[len(s.segments) // 2]
    by_plane = lowest_by_plane(solid)
    records = []
    for supports, plane in SIDEWAYS[tuple(solid.held)]:
        if supports == "free" and solid.q_deg != 0.0:
            continue
        shear = body.GAy if plane == "xy" else body.GAz
        one = critical_compression(bending_of(stiffness, s.bar.length, plane, shear), supports, 1)
        load = 2.0 * one * cos(radians(solid.q_deg))
        records.append(
            Critical(
                q_deg=solid.q_deg,
                held=solid.held,
                model="beam formula",
                spring_at=None,
                what=NAMED[supports, plane],
                load_N=load,
                ratio_to_solid=load / by_plane[plane] if plane in by_plane else None,
                why=f"two bars, {supports}, EI from K_b, times cos q; ratio to the solid's load in the same plane",
            )
        )
    return records


def spring_records(case: Case, stiffness: Floats, solid: SolidBuckling) -> list[Critical]:
    """The springs in compression, lumped ones at the tip in tension too."""
    records = []
    for place in PLACES:
        springs = SpringLinkage(case, stiffness, solid.q_deg, place)
        for sign in (-1, 1) if place == "tip" else (-1,):
            found = springs.critical(solid.held, sign)
            formula = springs.formula(solid.held, sign)
            load = -found.load if found.found else None
            records.append(
                Critical(
                    q_deg=solid.q_deg,
                    held=solid.held,
                    model="vjm",
                    spring_at=place,
                    what="in compression" if sign < 0 else "in tension (spurious)",
                    load_N=load,
                    searched_N=None if found.found else -found.searched_load,
                    closed_form_N=None if formula is None else -formula,
                    ratio_to_solid=None if load is None or sign > 0 else load / solid.loads[0],
                    why=why(springs),
                )
            )
    return records


def why(springs: SpringLinkage) -> str:
    """Why springs at this place buckle as they do."""
    text = WHY_PLACE[springs.place]
    if springs.place == "middle" and springs.q_deg == 0.0:
        rigid = -middle_hinge_only(springs.stiffness, springs.case.linkage.length_mm)
        text += (
            f"; in plane they would hold 8 K55'/L = {rigid / 1000:.4g} kN if they followed half of the turn"
        )
    return text


def curve_records(case: Case, stiffness: Floats, paths: Sequence[SolidPath]) -> list[Curve]:
    """LIN, FEA and the lumped springs over the travel of each solid path."""
    records = []
    for path in paths:
        springs = {place: SpringLinkage(case, stiffness, path.q_deg, place) for place in PLACES}
        slope = linear_slope(springs["tip"].closed_form, path.q_deg, path.held)
        ends = np.array([0.0, path.x[-1]])
        records.append(curve(path, "lin", "tip", ends, slope * ends, "LIN: the straight line of Eq. 11"))
        note = f"FEA: solid bars with {BOW} in the shape of the lowest mode"
        if path.failure:
            note = f"FEA at q = {path.q_deg:g}°, {' '.join(path.held)} held: {path.failure}"
        records.append(
            curve(path, "fea", "distributed", path.x, path.fx, note, [-path.critical], buckled=True)
        )
        for place in PLACES:
            records.extend(spring_curves(springs[place], path))
    return records


def curve(
    path: SolidPath,
    model: str,
    spring_at: str,
    x: Sequence[float] | Floats,
    fx: Sequence[float] | Floats,
    note: str,
    critical: Sequence[float] = (),
    buckled: bool = False,
) -> Curve:
    """A curve of a model under the conditions of a solid path."""
    return Curve(
        model=model,
        q_deg=path.q_deg,
        held=path.held,
        spring_at=spring_at,
        branch="buckled" if buckled else "straight",
        x_mm=[float(v) for v in x],
        fx_N=[float(v) for v in fx],
        critical_N=[float(v) for v in critical],
        note=note,
    )


def spring_curves(springs: SpringLinkage, path: SolidPath) -> list[Curve]:
    """The straight path of lumped springs, and the branch past their critical load where there is one."""
    x = np.array(path.x)
    found = springs.critical(path.held, -1)
    within = found.found and found.displacement > x[-1]
    straight = x[x >= found.displacement] if within else x
    if within:
        straight = np.append(straight, found.displacement)
    critical = [found.load] if found.found else []
    loads = springs.curve(path.held, straight)
    good = np.isfinite(loads)
    note = "VJM: lumped springs on the straight path"
    if not good.all():
        note = "VJM: lumped springs; the line ends where no equilibrium was found"
    records = [curve(path, "vjm", springs.place, straight[good], loads[good], note, critical)]
    if within:
        past = np.linspace(found.displacement, x[-1], 12)[1:]
        reached, force = springs.buckled(found, past)
        note = "VJM: the branch past the critical load"
        bent = ([found.displacement, *reached], [found.load, *force])
        records.append(curve(path, "vjm", springs.place, *bent, note, critical, buckled=True))
    return records


def validity_records(curves: Sequence[Curve], paths: Sequence[SolidPath]) -> list[Validity]:
    """Loads at which each model has left its own initial tangent by 1 % and 5 %."""
    records = []
    for path in paths:
        records.extend(departures("solid FE", path, np.array(path.x), np.array(path.fx), path.tangent))
        for place in PLACES:
            parts = [
                c
                for c in curves
                if c.model == "vjm" and c.spring_at == place and c.q_deg == path.q_deg and c.held == path.held
            ]
            x = np.concatenate([c.x_mm for c in parts])
            fx = np.concatenate([c.fx_N for c in parts])
            records.extend(departures(f"VJM, {NAME_OF[place]}", path, x, fx, fx[1] / x[1]))
    return records


def departures(model: str, path: SolidPath, x: Floats, fx: Floats, tangent: float) -> list[Validity]:
    """The load at each deviation from the tangent, by interpolation between the points of the path."""
    gone = np.abs(fx[1:] / (tangent * x[1:]) - 1.0)
    records = []
    for deviation in DEVIATIONS:
        past = np.flatnonzero(gone >= deviation)
        load = None
        if len(past):
            i = int(past[0])
            before = gone[i - 1] if i else 0.0
            share = (deviation - before) / (gone[i] - before)
            load = float(-(fx[i] + share * (fx[i + 1] - fx[i])))
        records.append(
            Validity(model=model, q_deg=path.q_deg, held=path.held, deviation=deviation, load_N=load)
        )
    return records
