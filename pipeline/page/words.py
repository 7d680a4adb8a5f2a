"""What a page says of candidates, of what was assumed, and of where equations come from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from pipeline.answer.record import Answer, Candidate
from pipeline.answer.wording.diagnosis import no_next_test
from pipeline.campaign import Campaign
from pipeline.inference.load_cases import LOST
from pipeline.page.record import ByHand, Following, TolerancePage
from pipeline.typed import command
from reports.quantities import short, sigma
from vjm.effects import effect_of
from vjm.effects.base import Effect

SOURCES = (
    "Virtual joints (Eqs. 1 to 10), closed form (Eq. 11): A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, Stiffness "
    "modelling of parallelogram-based parallel manipulators.",
    "Residuals with noise in the inputs: W. A. Fuller, Measurement Error Models, Wiley 1987, ch. 3; H. I. Britt, "
    "R. H. Luecke, Technometrics 15 (1973).",
    "Intervals by profile likelihood: D. J. Venzon, S. H. Moolgavkar, Applied Statistics 37 (1988) 87-94.",
)
"""What every page rests on."""


def why(it: Candidate, answer: Answer) -> str:
    """Why an effect was chosen, or lost."""
    least = answer.error[-1].fit
    rivals = {name for names in answer.alternatives for name in names}
    if it.effect in answer.effects:
        return "chosen" if answer.verdict != "ambiguous" else "in the simplest of the sets that fit alike"
    if any(it.effect in names for names in answer.out_by_plausibility) and it.effect not in rivals:
        return "fits as well, but only with an implausible size"
    if it.effect in rivals:
        return "fits as well: these tests cannot tell it from what was chosen"
    if it.fit is not None and it.evidence is not None:
        return f"fitted beside the others it leaves {sigma(it.fit)} sigma, {_behind(it.evidence)}"
    if it.screen is None:
        return "does not show in these tests, or was part of another set"
    if it.screen <= 1.02 * least:
        return "promises no more than what was chosen without it"
    return f"explains too little: {sigma(it.screen)} sigma would be left, {sigma(least)} are left with what was chosen"


TOLERANCES = {
    "EA": ("axial stiffness EA of the bars", "share"),
    "EIy": ("bending stiffness EI_y of the bars", "share"),
    "EIz": ("bending stiffness EI_z of the bars", "share"),
    "GJ": ("torsional stiffness GJ of the bars", "share"),
    "ends": ("compliance of the bars' ends", "share"),
    "bars": ("stiffness of the bars of all parallelograms", "share"),
    "drives": ("stiffness of all drives", "share"),
    "links": ("stiffness of all links", "share"),
    "length_mm": ("length of the bars", "mm"),
    "width_mm": ("distance of the bars", "mm"),
    "q_mrad": ("angle of the bars as it was set up", "mrad"),
}
"""Keys of [tolerance] in words, and their units."""


def tolerances_of(campaign: Campaign) -> Iterator[TolerancePage]:
    """Of everything that is written about the rig; zero where it is exact."""
    for key in campaign.rig.written:
        words, unit = TOLERANCES.get(key, (key, "share"))
        yield TolerancePage(key=key, words=words, unit=unit, value=campaign.tolerance.get(key, 0.0))


def by_hand(campaign: Campaign) -> Iterator[ByHand]:
    """Readings that campaign.toml sets aside or keeps."""
    for test in campaign.tests:
        for cells, kept in ((test.set_aside, False), (test.keep, True)):
            yield from (ByHand(test=test.id, step=step, column=it, kept=kept) for step, it in cells)


def following(campaign: Campaign, answer: Answer, diagnosed: bool) -> Iterator[Following]:
    """What to do next, in the order in which it is worth doing."""
    folder = campaign.folder or campaign.name
    if answer.doctor:
        yield from (Following(words=f"Mend the table first: {it.mend}.") for it in answer.doctor)
    elif not diagnosed:
        if answer.verdict == "unknown":
            yield Following(words="Look for what is missing.", command=command("diagnose", folder))
    elif answer.verdict == "identified":
        added = command("add", folder, *answer.added)
        yield Following(words="Take what was found into the model.", command=added)
    elif answer.verdict == "within_noise":
        yield Following(
            words="Nothing is missing in these tests: the model can be used as far as they reach."
        )
    elif answer.verdict == "unknown":
        said = "Look where in the linkage the rest sits, and what law it follows."
        yield Following(words=said, command=command("discover", folder))
    elif answer.verdict == "ambiguous":
        yield from _apart(answer)


def _apart(answer: Answer) -> Iterator[Following]:
    """The test that tells the sets apart."""
    found = answer.next_test
    if found is None:
        if answer.evidence is not None and len(answer.evidence.sets) < 2:
            # One set beside a fault of a sensor: no test of the rig parts these.
            return
        yield Following(words=no_next_test(answer.evidence))
        return
    for said, it in zip(
        ("Measure", *("Only together with",) * 9), (found, *found["together_with"]), strict=False
    ):
        yield Following(words=f"{said}: {it['why']}.")


def _behind(evidence: float) -> str:
    """BIC shows how far a set is behind; what a verdict excludes is decided by the cost of sets, not by it."""
    return f"BIC {short(evidence, 2)} behind the best set" if evidence > 0.0 else "BIC as good"


def assumptions(campaign: Campaign, names: tuple[str, ...], known: Mapping[str, Effect]) -> Iterator[str]:
    """What the numbers rest on, a sentence each."""
    held_out = [test.id for test in campaign.tests if test.role == "holdout"]
    yield "Noise of every sensor is normal and independent from step to step, with the sigmas below."
    yield "What is prescribed is read with noise as well; it counts through the model's own tangent."
    yield f"A reading for which a model has no stable equilibrium counts as {LOST:g} sigma."
    yield "Every test starts unloaded, with hinge springs and friction relaxed, and its steps are one history."
    if held_out:
        yield f"Held out, never used to fit or to choose: {', '.join(held_out)}."
    for zero, said in (("first_row", "zeroed at their first row"), ("fitted", "with unknown zeros, fitted")):
        tests = [test.id for test in campaign.tests if test.zero == zero]
        if tests:
            yield f"Tests {said}: {', '.join(tests)}."
    rig = campaign.rig
    if rig.platform_weight or rig.line_weight:
        yield f"Known weights: platform {rig.platform_weight:g} N, bars {rig.line_weight:g} N/mm."
    for name in names:
        yield f"{name}: {effect_of(name, known).limits}."


_READING = (
    "An error of 1 sigma is noise. The error of the fitted tests is over their degrees of freedom.",
    "Evidence is BIC less that of the best set, for the best set that was fitted with the effect in it: it shows how "
    "far that is behind and decides nothing.",
)


def reading(axes: str) -> tuple[str, ...]:
    """How a page about a rig is to be read. axes: where those of its base frame lie (`Rig.axes`)."""
    return (
        "Units are N, mm, rad and N·mm. Displacements are of the platform point from its nominal unloaded pose, the "
        f"wrench is exerted on the platform at that point, both in the base frame{axes}.",
        *_READING,
    )
