"""The findings of a run in plain sentences; every number is from the run."""

from collections.abc import Sequence

import numpy as np

from pipeline.validation.entries import eight_entries
from pipeline.validation.result import Bar, Buckling, Critical, Parallelogram, Validity
from pipeline.validation.stages.linkage import BOW

FULLY = ["y", "z", "rx", "ry", "rz"]
GUIDED = ["z", "rx", "ry", "rz"]


def tell(
    bar: Bar,
    buckling: Sequence[Buckling],
    parallelogram: Sequence[Parallelogram],
    critical: Sequence[Critical],
    validity: Sequence[Validity],
) -> list[str]:
    """Sentences in the order of the report."""
    sentences = [
        *stiffness_sentences(bar),
        *linkage_sentences(parallelogram),
        *bar_buckling_sentences(buckling),
        *critical_sentences(critical),
        *validity_sentences(validity),
    ]
    return [s for s in sentences if s]


def stiffness_sentences(bar: Bar) -> list[str]:
    """How well the bar meets the paper, and how well its K_b is known."""
    sentences = []
    if bar.worst_entry_error is not None and bar.paper is not None:
        worst = max(bar.entries, key=lambda e: abs(e.deviation))
        limit = eight_entries(np.array(bar.convergence.extrapolated))
        off = float(np.abs(limit / eight_entries(np.array(bar.paper)) - 1.0).max())
        sentences.append(
            f"The solid bar meets the eight entries of Eq. 12 within {100 * bar.worst_entry_error:.1f} % "
            f"(worst: {worst.entry}, {100 * worst.deviation:+.1f} %); extrapolated to a mesh without error, within "
            f"{100 * off:.1f} %."
        )
    band = bar.convergence.band
    widest = max(band, key=lambda k: band[k])
    second = max(bar.second_route.entries, key=lambda e: abs(e.deviation))
    others = max(error for name, error in band.items() if name != widest)
    sentences.append(
        f"Its K_b is known to {100 * band[widest]:.1f} % in {widest}, the slowest to converge, and to "
        f"{100 * others:.1f} % or better in the other entries; virtual experiments on the tip agree with the rigid "
        f"tie within {100 * abs(second.deviation):.1f} % ({second.entry})."
    )
    return sentences


def linkage_sentences(records: Sequence[Parallelogram]) -> list[str]:
    """Closed form against finite elements."""
    worst = max(r.worst_fea_deviation for r in records)
    ranks = sorted({r.rank for r in records})
    return [
        f"The closed form of K_p (Eq. 11), fed with this K_b, agrees with the solid parallelogram within "
        f"{max(100 * worst, 1e-3):.1g} % in every entry, as it must with rigid faces and ideal pins: this checks both "
        f"programs, not the pins. Its rank is {' and '.join(map(str, ranks))}, without stiffness along z of the bar "
        "frame."
    ]


def bar_buckling_sentences(records: Sequence[Buckling]) -> list[str]:
    """Solid buckling of the bar against the formulas."""
    solid = [r for r in records if r.model == "solid" and r.deviation is not None]
    worst = max(solid, key=lambda r: abs(r.deviation or 0.0))
    torsion = min(r.load_N for r in records if r.plane == "torsion")
    lowest = {r.supports: r.load_N for r in reversed(solid) if r.mode == 1}
    in_plane = min((r.load_N for r in solid if r.supports == "pinned" and r.plane == "xz"), default=None)
    highest = max(r.load_N for r in solid)
    return [
        f"The bar's three buckling configurations in the linkage are, for one bar: sliding sideways at "
        f"{kilo(lowest['guided'])}, clamped sideways at {kilo(lowest['clamped'])}, and in plane between the pins at "
        f"{kilo(in_plane)}.",
        f"All {len(solid)} solid bending modes lie within {100 * abs(worst.deviation or 0.0):.1f} % of Euler's "
        f"formulas with shear and the bar's own end softness (worst: {worst.supports}, mode {worst.mode}, in "
        f"{worst.plane}); torsion would come at {kilo(torsion)}, the highest of these modes at {kilo(highest)}.",
    ]


def critical_sentences(records: Sequence[Critical]) -> list[str]:
    """Where the spring sits decides; both lower and higher, if so."""
    at_zero = [r for r in records if r.q_deg == 0.0]
    if not at_zero:
        return []
    solid: dict[tuple[str, ...], float] = {}
    for r in at_zero:
        if r.model == "solid" and r.load_N is not None:
            solid.setdefault(tuple(r.held), r.load_N)
    spring = {(r.spring_at, r.what): r.load_N for r in at_zero if r.model == "vjm" and r.held == GUIDED}
    places = ", ".join(
        f"at the {place} {at(spring[place, 'in compression'])}" for place in ("base", "middle", "tip")
    )
    tension = spring["tip", "in tension (spurious)"]
    loads = ", ".join(kilo(v) for v in sorted(solid.values()))
    sentences = [
        f"K_p does not depend on where the lumped spring sits, the critical load does: with z held and the platform "
        f"guided, springs buckle {places}; at the tip (Eq. 1 as written) tension upsets the linkage "
        f"{at(None if tension is None else -tension)}. The solid parallelogram buckles at {loads}, depending on what "
        f"is held."
    ]
    base = spring["base", "in compression"]
    if base is not None and min(solid.values()) < base < max(solid.values()):
        sentences.append('The paper\'s "both lower and higher" is true against the spring at the base.')
    sentences.append(missing_effect(records))
    return sentences


def at(load: float | None) -> str:
    """Where a spring buckles, or that it does not."""
    return "never" if load is None else f"at {kilo(load)}"


def missing_effect(records: Sequence[Critical]) -> str:
    """The error of the critical loads without and with geometric stiffness, over all angles and ways of holding."""
    compression = [r for r in records if r.model == "vjm" and "compression" in r.what]
    with_it = [
        abs(r.ratio_to_solid - 1.0) for r in compression if r.spring_at == "distributed" and r.ratio_to_solid
    ]
    without = [abs(r.ratio_to_solid - 1.0) for r in compression if r.spring_at == "base" and r.ratio_to_solid]
    gained = (
        f" Shared out over the bar with it, the same K_b meets all {len(with_it)} critical loads of the solid within "
        f"{100 * max(with_it):.1f} %; without it the spring at the base is off by up to {100 * max(without):.0f} %, "
        f"the one at the tip finds none."
        if with_it and without
        else ""
    )
    return (
        "The first missing effect has a name: geometric stiffness. A lumped 6x6 has none of its own, and sideways "
        "(out of the linkage's plane) the spring at the tip has none at all." + gained
    )


def validity_sentences(records: Sequence[Validity]) -> list[str]:
    """How far LIN is good, as far as solid bars of the path's mesh and bow say so."""
    sentences = []
    for held, named in ((FULLY, "fully held"), (GUIDED, "free along y")):
        loads = {
            r.deviation: r.load_N
            for r in records
            if r.q_deg == 0.0 and r.held == held and r.model == "solid FE" and r.load_N is not None
        }
        if 0.01 in loads and 0.05 in loads:
            sentences.append(
                f"With the platform {named}, the linear model is good to 1 % up to {kilo(loads[0.01])} and to 5 % "
                f"up to {kilo(loads[0.05])} (solid bars of the path's coarser mesh with {BOW}, q = 0; "
                f"a larger bow bends earlier)."
            )
    return sentences


def kilo(load: float | None) -> str:
    """A load in kN with three digits."""
    return "no load" if load is None else f"{load / 1000:.3g} kN"
