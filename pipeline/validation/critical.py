"""Critical loads of the linkage: solid, beam formulas, springs at three places and distributed."""

from collections.abc import Sequence
from math import cos, radians
from typing import Any

from fem.euler import bending_of, critical_compression
from meshes.solid import Floats
from pipeline.validation.result import Buckling, Critical
from pipeline.validation.stages.linkage import SolidBuckling
from pipeline.validation.stages.springs import PLACES, SpringLinkage, SpringSet
from pipeline.validation.stages.subject import SolidBar
from vjm.closed_forms import middle_hinge_only

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
WHY_PLACE = {
    "tip": "compression stretches the lever of the tip spring: it stabilises the bar's angle, and tension upsets it",
    "middle": "the rigid halves fold about the spring in mid-bar, whose translations (before the turn in Eq. 1) give",
    "base": "the rigid bar leans on the spring at its base hinge",
    "distributed": "the same K_b shared out over the bar, with its geometric stiffness",
}


def critical_records(
    s: SolidBar,
    stiffness: Floats,
    springs: SpringSet,
    solids: Sequence[SolidBuckling],
    bars: Sequence[Buckling],
) -> list[Critical]:
    """Every critical load of the linkage of bars with this K_b (6, 6); the mesh errors of the solid are those of its
    `bars` in the same supports."""
    records = []
    for solid in solids:
        records.extend(solid_records(solid, bars))
        records.extend(formula_records(s, stiffness, solid))
        records.extend(spring_records(springs, solid))
    return records


def record(solid: SolidBuckling, **found: Any) -> Critical:
    """A critical load under the conditions of a solid one."""
    return Critical.model_validate({"q_deg": solid.q_deg, "held": solid.held, "spring_at": None} | found)


def lowest_by_plane(solid: SolidBuckling) -> dict[str, float]:
    """The lowest load of each plane among the modes that were computed, lowest first."""
    found: dict[str, float] = {}
    for plane, load in zip(solid.planes, solid.loads, strict=True):
        found.setdefault(plane, load)
    return found


def bar_mode(bars: Sequence[Buckling], held: Sequence[str], plane: str) -> Buckling | None:
    """The lowest mode of one bar in a plane, with the supports that the linkage gives it."""
    supports = "pinned" if plane == "xz" else SIDEWAYS[tuple(held)][0][0]
    same = [b for b in bars if (b.model, b.supports, b.plane) == ("solid", supports, plane)]
    return min(same, key=lambda b: b.load_N, default=None)


def solid_records(solid: SolidBuckling, bars: Sequence[Buckling]) -> list[Critical]:
    """The solid's lowest load in each plane."""
    records = []
    for plane, load in lowest_by_plane(solid).items():
        bar = bar_mode(bars, solid.held, plane)
        records.append(
            record(
                solid,
                model="solid",
                what=f"lowest mode in {plane}",
                load_N=load,
                ratio_to_solid=load / solid.loads[0],
                why="linear buckling of two solid bars with pins and a rigid platform",
                band=None if bar is None else bar.band,
            )
        )
    return records


def formula_records(s: SolidBar, stiffness: Floats, solid: SolidBuckling) -> list[Critical]:
    """Both bars by Euler's formulas with the EI, shear and end softness identified from K_b (6, 6).

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
            record(
                solid,
                model="beam formula",
                what=NAMED[supports, plane],
                load_N=load,
                ratio_to_solid=load / by_plane[plane] if plane in by_plane else None,
                why=f"two bars, {supports}, EI from K_b, times cos q; ratio to the solid's load in the same plane",
            )
        )
    return records


def spring_records(every: SpringSet, solid: SolidBuckling) -> list[Critical]:
    """The springs in compression, lumped ones at the tip in tension too."""
    records = []
    for place in PLACES:
        springs = every[solid.q_deg, place]
        for sign in (-1, 1) if place == "tip" else (-1,):
            found = springs.critical(solid.held, sign)
            formula = springs.formula(solid.held, sign)
            load = -found.load if found.found else None
            records.append(
                record(
                    solid,
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
