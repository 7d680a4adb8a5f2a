"""The score of the look for laws as a page."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pipeline.assessment.challenge.laws.cases import BEYOND, SEED
from pipeline.assessment.challenge.laws.outcome import LawOutcome
from pipeline.assessment.challenge.laws.score import LawScored


def law_page(it: LawScored) -> str:
    """Markdown."""
    excess = "not measured" if it.excess is None else f"{it.excess:.2f}"
    return "\n".join(
        [
            "# Laws beyond the catalogue on virtual benches",
            "",
            f"{it.cases} benches of the frame finite elements, seed {SEED}, with a law or two at a place of the "
            "linkage, or with none. The bar is up to 2 % beside its drawing; a third of the benches have tails, bad "
            "readings or correlated noise. Held-out tests go to "
            f"{BEYOND:g} times the loads. With the code of {', '.join(each[:12] for each in it.commits)}: "
            "`python -m pipeline.assessment.challenge.laws`.",
            "",
            "| goal | wanted | found (95 % bounds, Clopper-Pearson) |",
            "|---|---|---|",
            *(f"| {g.name} | {g.wanted} | {g.share} |" for g in it.goals),
            "",
            "The median of what is left beyond noise in held-out tests, sqrt(rms² - 1), over that of a Gaussian "
            f"process that learned the residual of the fitted tests: {excess} (wanted: at most 0.25). A bench took "
            f"{it.seconds_median:.0f} s of one processor in the median and {it.seconds_most:.0f} s at most, of which "
            f"{it.seconds_of_diagnosis:.0f} s in the median are the diagnosis before laws are looked for.",
            "",
            "## Bench by bench",
            "",
            "A law shows by so many sigmas where all else is as written; beside the tolerances (the bar's four "
            "stiffnesses, lengths, angle) by those that no deviation within them explains, for its price in them: "
            "sqrt(s^T (1 + G G^T)^-1 s), s what it does to the readings and G a column for each tolerance. A law "
            "along the bar or a tilt of an axis is much as a bar that is softer: of 25 sigmas 3 may be left, "
            "which no evidence tells from noise.",
            "",
            "| bench | hidden, sigmas (beside the tolerances) | found (first of the group, form) "
            "| place | held out | verdict |",
            "|---|---|---|---|---|---|",
            *(_row(each) for each in it.outcomes if each.kind != "clean" or each.found or each.error),
            "",
        ]
    )


def _row(it: LawOutcome) -> str:
    hidden = ", ".join(f"{law.law} {law.site} {law.mu:.0f} ({law.told:.0f})" for law in it.hidden) or "–"
    found = ", ".join(_found(it)) or it.error.partition(":")[0] or "nothing"
    right = "–" if not it.hidden else "right" if all(it.right) else "other"
    held = "–" if not it.held_out else f"{np.sqrt(np.mean(np.square(it.held_out))):.2f}"
    names = " + ".join(it.sets[0]) if it.sets and it.verdict in ("identified", "ambiguous") else ""
    return f"| {it.kind} {it.number} | {hidden} | {found} | {right} | {held} | {it.verdict} {names} |"


def _found(it: LawOutcome) -> Iterator[str]:
    for place in it.found:
        form = f" {place.forms[0]}" if place.forms else ""
        more = f" (+{len(place.group) - 1})" if len(place.group) > 1 else ""
        yield f"{place.site}{more}{form}"
