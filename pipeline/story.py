"""The findings of a run in plain sentences; every number is from the run."""

from collections.abc import Sequence

from pipeline.result import Bar, Buckling, Critical, Parallelogram, Validity

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
    if bar.worst_entry_error is not None:
        worst = max(bar.entries, key=lambda e: abs(e.deviation))
        sentences.append(
            f"The solid bar meets the eight entries of Eq. 12 within {100 * bar.worst_entry_error:.1f} % "
            f"(worst: {worst.entry}, {100 * worst.deviation:+.1f} %)."
        )
    widest = max(bar.convergence.band, key=lambda k: bar.convergence.band[k])
    second = max(bar.second_route.entries, key=lambda e: abs(e.deviation))
    sentences.append(
        f"Its K_b is known to {100 * bar.convergence.band['K22']:.1f} % in K22 and "
        f"{100 * bar.convergence.band[widest]:.1f} % in {widest}, the slowest to converge; "
        f"virtual experiments on the tip agree with the rigid tie within "
        f"{100 * abs(second.deviation):.1f} % ({second.entry})."
    )
    return sentences


def linkage_sentences(records: Sequence[Parallelogram]) -> list[str]:
    """Closed form against finite elements."""
    worst = max(r.worst_fea_deviation for r in records)
    ranks = sorted({r.rank for r in records})
    return [
        f"The closed form of K_p (Eq. 11), fed with this K_b, agrees with the solid parallelogram within "
        f"{100 * worst:.2g} % in every entry; its rank is {' and '.join(map(str, ranks))}, "
        f"without any stiffness along z of the bar frame."
    ]


def bar_buckling_sentences(records: Sequence[Buckling]) -> list[str]:
    """Solid buckling of the bar against the formulas."""
    solid = [r for r in records if r.model == "solid" and r.deviation is not None]
    worst = max(solid, key=lambda r: abs(r.deviation or 0.0))
    torsion = min(r.load_N for r in records if r.plane == "torsion")
    lowest = {r.supports: r.load_N for r in reversed(solid) if r.mode == 1}
    in_plane = min(r.load_N for r in solid if r.supports == "pinned" and r.plane == "xz")
    return [
        f"The bar's three buckling configurations in the linkage are, for one bar: sliding sideways at "
        f"{kilo(lowest['guided'])}, clamped sideways at {kilo(lowest['clamped'])}, and in plane between the pins at "
        f"{kilo(in_plane)}.",
        f"All {len(solid)} solid modes lie within {100 * abs(worst.deviation or 0.0):.1f} % of Euler's formulas with "
        f"shear and the bar's own end softness (worst: {worst.supports}, mode {worst.mode} in {worst.plane}, where "
        f"the wave is short against the section); torsion would come at {kilo(torsion)} and plays no part.",
    ]


def critical_sentences(records: Sequence[Critical]) -> list[str]:
    """Both lower and higher, and why."""
    at_zero = [r for r in records if r.q_deg == 0.0]
    if not at_zero:
        return []
    solid = {tuple(r.held): r.load_N for r in at_zero if r.model == "solid"}
    spring = {(r.spring_at, tuple(r.held), r.what): r for r in at_zero if r.model == "vjm"}
    guided = tuple(GUIDED)
    tip = spring["tip", guided, "in compression"]
    tension = spring["tip", guided, "in tension (spurious)"]
    middle, base = spring["middle", guided, "in compression"], spring["base", guided, "in compression"]
    sentences = []
    if None not in (base.load_N, middle.load_N, tension.load_N) and tip.load_N is None:
        loads = ", ".join(kilo(v) for v in sorted(v for v in solid.values() if v is not None))
        sentences.append(
            f"K_p does not depend on where the lumped spring sits, the critical load does: with z held and the "
            f"platform guided, compression buckles springs at the base at {kilo(base.load_N)}, in the middle at "
            f"{kilo(middle.load_N)}, at the tip (Eq. 1 as written) never, which instead fails in tension at "
            f"{kilo(abs(tension.load_N or 0.0))}. "
            f"The solid parallelogram buckles at {loads}, depending on what is held: the paper's "
            f'"both lower and higher" holds against the spring at the base.'
        )
    sentences.append(missing_effect(records))
    return sentences


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
    """How far LIN is good."""
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
                f"up to {kilo(loads[0.05])} (solid bars with a bow of L/30000, q = 0)."
            )
    return sentences


def kilo(load: float | None) -> str:
    """A load in kN with three digits."""
    return "no load" if load is None else f"{load / 1000:.3g} kN"
