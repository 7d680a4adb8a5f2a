"""The findings of a run in plain sentences; every number is from the run."""

from collections.abc import Sequence

import numpy as np

from pipeline.validation.entries import eight_entries
from pipeline.validation.quantities import force, stress
from pipeline.validation.result import Bar, Buckling, Critical, Curve, Parallelogram, Validity
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
    solid = [r for r in records if r.model == "solid"]
    torsion = min((r.load_N for r in records if r.plane == "torsion"), default=None)
    named = (("guided", "xy"), ("clamped", "xy"), ("pinned", "xz"))
    sideways, clamped, in_plane = (
        marked(min(bent_in(solid, supports, plane), key=lambda r: r.load_N, default=None))
        for supports, plane in named
    )
    highest = marked(max(solid, key=lambda r: r.load_N))
    return [
        f"The bar's three buckling configurations in the linkage are, for one bar: sliding sideways at {sideways}, "
        f"clamped sideways at {clamped}, and in plane between the pins at {in_plane}.",
        f"{against_formulas(solid)}; torsion would come at {force(torsion)}, the highest of these modes at {highest}.",
    ]


def bent_in(solid: Sequence[Buckling], supports: str, plane: str) -> list[Buckling]:
    """The modes of the bar with these supports that bend it in this plane."""
    return [r for r in solid if (r.supports, r.plane) == (supports, plane)]


def against_formulas(solid: Sequence[Buckling]) -> str:
    """How far the loads of solid and formula are apart, and how many modes have no formula of their shape."""
    compared = [r for r in solid if r.deviation is not None]
    alone = len(solid) - len(compared)
    if not compared:
        return f"None of {len(solid)} solid modes has the shape of a formula's mode"
    worst = max(compared, key=lambda r: abs(r.deviation or 0.0))
    bending = all(r.plane != "torsion" for r in solid)
    modes = "solid bending modes" if bending else "solid modes of bending and torsion"
    which = f"All {len(compared)} {modes}" if not alone else f"{len(compared)} of {len(solid)} {modes}"
    formulas = "Euler's formulas with shear and the bar's own end softness"
    formulas += "" if bending else " and the formula for torsion"
    said = (
        f"{which} lie within {100 * abs(worst.deviation or 0.0):.1f} % of {formulas} (worst: {worst.supports}, mode "
        f"{worst.mode}, in {worst.plane})"
    )
    return (
        said
        if not alone
        else f"{said}, {alone} have the shape of no formula's mode and are compared with none"
    )


def critical_sentences(records: Sequence[Critical]) -> list[str]:
    """Where the spring sits decides; both lower and higher, if so."""
    at_zero = [r for r in records if r.q_deg == 0.0]
    if not at_zero:
        return []
    lowest: dict[tuple[str, ...], Critical] = {}
    for r in at_zero:
        if r.model == "solid" and r.load_N is not None:
            lowest.setdefault(tuple(r.held), r)
    solid = sorted(r.load_N or 0.0 for r in lowest.values())
    spring = {(r.spring_at, r.what): r for r in at_zero if r.model == "vjm" and r.held == GUIDED}
    places = ", ".join(
        f"at the {place} {at(spring[place, 'in compression'])}" for place in ("base", "middle", "tip")
    )
    loads = ", ".join(marked(r) for r in sorted(lowest.values(), key=lambda r: r.load_N or 0.0))
    sentences = [
        f"K_p does not depend on where the lumped spring sits, the critical load does: with z held and the platform "
        f"guided, springs buckle {places}; at the tip (Eq. 1 as written) tension upsets the linkage "
        f"{at(spring['tip', 'in tension (spurious)'])}. The solid parallelogram buckles at {loads}, depending on what "
        f"is held."
    ]
    base = spring["base", "in compression"].load_N
    if base is not None and solid[0] < base < solid[-1]:
        sentences.append('The paper\'s "both lower and higher" is true against the spring at the base.')
    sentences.append(missing_effect(records))
    return sentences


def at(record: Critical) -> str:
    """Where a spring buckles, or that it does not; the size of a load in tension."""
    return "never" if record.load_N is None else f"at {marked(record)}"


def marked(record: Buckling | Critical | Validity | None) -> str:
    """A load, with its stress where the material yields before it is reached."""
    if record is None or record.load_N is None:
        return force(None)
    load = force(abs(record.load_N))
    return f"{load} ({stress(record.stress_MPa)}, beyond yield)" if record.beyond_yield else load


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
            r.deviation: r
            for r in records
            if r.q_deg == 0.0 and r.held == held and r.model == "solid FE" and r.load_N is not None
        }
        if 0.01 in loads and 0.05 in loads:
            sentences.append(
                f"With the platform {named}, the linear model is good to 1 % up to {marked(loads[0.01])} and to 5 % "
                f"up to {marked(loads[0.05])} (solid bars of the path's coarser mesh with {BOW}, q = 0; "
                f"a larger bow bends earlier)."
            )
    return sentences


def yield_sentences(
    limit: float,
    straight: float,
    buckling: Sequence[Buckling],
    critical: Sequence[Critical],
    curves: Sequence[Curve],
) -> list[str]:
    """What the yield stress `limit`, MPa, makes of the loads; `straight` N: where both straight bars yield, q = 0."""
    bars, linkage = [r for r in buckling if r.model == "solid"], [r for r in critical if r.model == "solid"]
    said = (
        f"All models are elastic; the material yields at {limit:g} MPa, which straight bars reach at {force(straight)} "
        f"(both bars, q = 0). Beyond it lie {sum(r.beyond_yield for r in bars)} of {len(bars)} critical loads of the "
        f"solid bar and {sum(r.beyond_yield for r in linkage)} of {len(linkage)} of the solid linkage"
    )
    beyond = [r for r in linkage if r.beyond_yield]
    if beyond:
        highest = max(beyond, key=lambda r: r.stress_MPa or 0.0)
        said += f" ({force(highest.load_N)} would be {stress(highest.stress_MPa)}); a real bar yields first"
    sentences = [f"{said}."]
    for curve in curves:
        if curve.model == "fea" and curve.branch == "buckled" and curve.yield_x_mm is not None:
            sentences.append(
                f"On the solid's load path at q = {curve.q_deg:g}° with {', '.join(curve.held)} held the first fibre "
                f"yields at x = {curve.yield_x_mm:.3g} mm, Fx = {force(curve.yield_fx_N)}; the rest of the path "
                f"is that of an elastic bar only."
            )
    return sentences
