"""A diagnosis as an engineer would say it."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from pipeline.answer.of_diagnosis import answer_of, in_words
from pipeline.answer.record import Answer
from pipeline.answer.wording.added import limits, written
from pipeline.answer.wording.doctor import doctor_sentence, mends
from pipeline.attempt import Attempts
from pipeline.campaign.names import COORDINATES
from pipeline.discrepancy.description import descriptions
from pipeline.inference.driving import column_name
from pipeline.inference.fit import Fit
from pipeline.parameter_names import path_of
from pipeline.selection.adequacy.judgement import SIZE, judge
from pipeline.selection.adequacy.untested import in_units
from pipeline.selection.cost import cost_of
from pipeline.selection.diagnosis import Diagnosis
from pipeline.selection.exclusion import needed, worse
from pipeline.selection.possible_tests import Choice, menu
from pipeline.selection.single_angle import only_place
from reports.quantities import estimate, p_is, percent, phrase, short, sigma
from vjm.effects.base import Effect

CARRIES = 0.7
"""Part of the misfit that may be left of a test, for the others to foretell it."""


def answered(it: Diagnosis, found: Fit | None = None) -> Answer:
    """The diagnosis as a record with its sentences. found: whose numbers it has, default those of the first set."""
    answer = answer_of(it, found=found)
    own = answer if found is None or found is it.fit else answer_of(it)
    return answer.model_copy(update={"sentences": sentences(it, own)})


def sentences(it: Diagnosis, answer: Answer | None = None) -> tuple[str, ...]:
    """All that is worth saying, the verdict first. A part that fails is said, and takes no other with it.

    answer: of the diagnosis, so that its intervals are found once.
    """
    attempts = Attempts()
    record = answer or answer_of(it)
    if record.doctor:
        return (*doctored(it, record), *in_units(it.fit), *(f"{r}." for r in it.campaign.remarks))
    first = attempts.get("the verdict in words", lambda: tuple(_verdict(it, record)), (f"{it.verdict}.",))
    parts: dict[str, Callable[[], tuple[str, ...]]] = {"what is known in units": lambda: in_units(it.fit)}
    if it.verdict != "nothing_tested":
        parts |= {
            "the evidence in words": lambda: tuple(_evidence(it, record)),
            "what the readings are, in words": lambda: tuple(_aside(it, record)),
            "the limits in words": lambda: tuple(limits(record)),
            "what was written, in words": lambda: tuple(written(record, it.cache.criteria.nominal_moved)),
            "what is left in words": lambda: tuple(_left(it)),
            "laws in words": lambda: it.law_words,
            "noise from row to row, in words": lambda: tuple(_from_row_to_row(it, record)),
            "the rivals in words": lambda: tuple(_rivals(it)),
            "the next test in words": lambda: tuple(_next(it)),
        }
    told = [said for name, part in parts.items() for said in attempts.get(name, part, ())]
    failed = [f"{said}." for said in (*record.not_done, *attempts.failed)]
    return (*first, *told, *failed, *(f"{r}." for r in it.campaign.remarks))


def doctored(it: Diagnosis, answer: Answer) -> Iterator[str]:
    """The mistakes of a table, and what mends each."""
    asked, said = it.decision.zero, doctor_sentence(answer.doctor)
    told = f"{asked.words} {said[0].upper()}{said[1:]}" if asked else said
    yield f"{answer.verdict}: {told} Nothing is named before that is settled."
    yield from mends(answer.doctor)


def _verdict(it: Diagnosis, answer: Answer) -> Iterator[str]:
    if it.untested:
        yield it.untested
        return
    zero = it.decision.zero
    asked = f"{zero.words} " if zero else ""
    asked += _surely(it, answer)
    if it.verdict == "nothing_tested":
        yield f"nothing_tested: {asked}With that zero unknown no reading is left to test a model by."
        return
    rms, before = it.fit.rms, it.cache.fit(frozenset()).rms
    way = "the error falls" if rms <= before else "but the error does not fall: it goes"
    fall = f"{way} from {sigma(before)} to {sigma(rms)} sigma (1 is noise)"
    if it.verdict == "within_noise":
        yield f"within_noise: the model explains the measurements, {sigma(rms)} sigma are left (1 is noise)."
    elif it.verdict == "identified":
        yield f"identified: {_and(it.sets[0])}; {fall}."
    elif it.verdict == "ambiguous":
        fault = ["a fault of a sensor"] if it.instead else []
        law = [it.decision.law] if it.decision.law else []
        sets = " or ".join([*(_and(names) for names in it.sets), *fault, *law])
        yield f"ambiguous: {asked}{sets}; these tests cannot tell; {fall}."
    elif it.decision.because:
        yield f"unknown: {asked}{_and(it.sets[0])} would explain the misfit, {fall}, but {it.decision.because}."
    elif it.sets[0]:
        rest = "what is left is no noise and nothing known explains it"
        yield f"unknown: {asked}{_and(it.sets[0])} help, {fall}, but {rest}."
    elif zero:
        yield f"unknown: {asked}Nothing is named before that is settled; the misfit is {sigma(rms)} sigma."
    else:
        yield f"unknown: the misfit of {sigma(rms)} sigma is no noise, and nothing known explains it."


def _surely(it: Diagnosis, answer: Answer) -> str:
    """What is certain beside a verdict that leaves something open."""
    if not it.certain:
        return ""
    told = [f"{name}{_values(answer, it.cache.candidates[name], ' (', ')')}" for name in it.certain]
    return f"{_listed(told)} {'are' if len(told) > 1 else 'is'} certain; "


def _listed(words: list[str]) -> str:
    *others, last = words
    return f"{', '.join(others)} and {last}" if others else last


def _evidence(it: Diagnosis, answer: Answer) -> Iterator[str]:
    """Each effect: what it is, how much it explains, how it looks."""
    for name in it.sets[0]:
        effect = it.cache.candidates[name]
        size = next((a.size for a in it.alike if a.effect == name), None)
        shows = "" if size is None else f" It shows by {sigma(size)} sigma in these tests together."
        share = it.agreement.get(name)
        again = (
            ""
            if share is None
            else f" With one test left out it is chosen again in {percent(share)} of cases."
        )
        what = f"{name}: {effect.title}, {effect.equation}. In data: {effect.signature}."
        if name == it.found.beyond:
            what += " The tests that were fitted do not show it, those held out need it."
        yield f"{what}{shows}{again}{_values(answer, effect)}{_where(it, name)}"


def _where(it: Diagnosis, name: str) -> str:
    place = only_place(it.fit, name, it.cache.criteria)
    if place is None:
        return ""
    tests = ", ".join(place.tests)
    return (
        f" Only tests at q = {place.q_deg:g}° show it ({tests}): whether it is there at other angles these data do "
        "not say, the same at another angle would."
    )


def _values(answer: Answer, effect: Effect, before: str = " Fitted: ", after: str = ".") -> str:
    """The fitted parameters of an effect between these words; nothing where there are none."""
    mine = {p.name: answer.parameters.get(path_of(effect.name, p.name)) for p in effect.parameters}
    said = [
        phrase(name, estimate(value.model_dump()), value.unit)
        for name, value in mine.items()
        if value is not None and value.interval != "fixed"
    ]
    return f"{before}{', '.join(said)}{after}" if said else ""


def _aside(diagnosis: Diagnosis, answer: Answer) -> Iterator[str]:
    """What was found of the readings themselves, and the verdict with all of them as they were declared."""
    if answer.set_aside:
        told = ", ".join(
            f"{b.column} at step {b.step} of {b.test} ({sigma(b.sigma)} sigma)" for b in answer.set_aside
        )
        each = "they are" if len(answer.set_aside) > 1 else "it is"
        yield f"Set aside, for {each} off alone and what is beside is not: {told}."
    law = next((it.tails for it in answer.noise if it.tails is not None), None)
    if law is not None:
        yield (
            f"The noise has long tails (Student's law of {law:.1f} degrees of freedom): readings far out "
            "count less, none is set aside."
        )
    for it in (it for it in answer.noise if it.tails is None and it.correlation is None):
        error = "" if it.relative_error is None else f" (± {percent(it.relative_error)})"
        yield (
            f"{it.column} scatters by {short(it.found)}{error}, not by the {short(it.declared)} that is declared: "
            "what it does counts."
        )
    if answer.as_declared is not None:
        by = ", by the best single effect" if diagnosis.alone else ""
        yield f"With all readings and sigmas as they are declared the verdict would be {answer.as_declared}{by}."


def _from_row_to_row(it: Diagnosis, answer: Answer) -> Iterator[str]:
    """What noise that is correlated explains, or does to intervals."""
    mine = [each for each in answer.noise if each.correlation is not None]
    if not mine:
        return
    told = _listed([f"{each.column} ({each.correlation:.2f})" for each in mine])
    largest = max(each.correlation or 0.0 for each in mine)
    wider = np.sqrt((1.0 + largest) / (1.0 - largest))
    if it.verdict == "unknown":
        beside = _and(it.cache.order(it.alike_rows.beside))
        yield (
            f"One explanation of the rest is noise that is correlated from row to row, of {told}: beside {beside} it "
            "explains all. Hold one load and read it thirty times: if neighbours are alike there too, it is noise."
        )
        return
    yield (
        f"The noise of {told} is correlated from row to row. Intervals are for noise that is not: of numbers that "
        f"this column alone tells they may be up to {wider:.1f} times as wide."
    )


def _left(it: Diagnosis) -> Iterator[str]:
    """What the checks say of the rest."""
    failed = [check for check in it.judgement.checks if not check.passed]
    for check in failed:
        yield f"Not noise ({check.name}, {p_is(check.p_value)}): {check.words}."
    if it.judgement.scatter > 1.0:
        size = next(check.words for check in it.judgement.checks if check.name == SIZE)
        yield f"By its order along the load paths the rest is noise, but {size}."
    if it.verdict == "unknown":
        if it.found.ended and not it.decision.because:
            yield (
                f"The search ended after {len(it.cache.fits)} fits, as it takes long: what was not looked at may "
                "explain more."
            )
        yield from _why_not(it)
        yield from _described(it)


def _why_not(it: Diagnosis) -> Iterator[str]:
    """The closest known explanations, and why each fails."""
    cache = it.cache
    near = sorted(cache.fits, key=lambda names: cache.fit(names).chi_square)
    for names in [n for n in near if n and n != frozenset(it.sets[0])][:3]:
        found = cache.fit(names)
        worst = min(judge(found, it.cache.criteria).checks, key=lambda check: check.p_value)
        why = "" if worst.name == SIZE else f": {worst.words}"
        yield f"{_and(cache.order(names))} leaves {sigma(found.rms)} sigma{why}."


def _described(it: Diagnosis) -> Iterator[str]:
    for each in descriptions(it.fit):
        channel = column_name(each.channel, it.campaign.gauges)
        inputs = ", ".join(each.inputs) or "nothing that was prescribed"
        carries = (
            f"known from the other tests it would be {sigma(each.elsewhere)}"
            if each.elsewhere < CARRIES * each.rms
            else "which the other tests do not foretell"
        )
        yield (
            f"A description, not physics (Gaussian process): the rest of {channel}, {sigma(each.rms)} sigma, "
            f"varies with {inputs}; {carries}."
        )


def _rivals(it: Diagnosis) -> Iterator[str]:
    cache = it.cache
    for fault in it.instead:
        if not fault.effect:
            yield (
                f"Look first whether the sensor was zeroed: {fault.words} That takes {short(fault.explains)} "
                f"off chi-square beside {_and(cache.order(fault.without))}; say so in campaign.toml and diagnose again."
            )
            continue
        yield (
            f"Instead of {fault.effect} a sensor may be at fault: {_ended(fault.words)} That takes "
            f"{short(fault.explains)} off chi-square with one number, {fault.effect} {short(fault.of)}: "
            "check that sensor, or measure again with another."
        )
    if len(it.sets) > 1:
        least = min(map(frozenset, it.sets), key=lambda names: cost_of(cache, names))
        for names in it.sets:
            more = worse(cache, frozenset(names), least)
            limit = max(needed(cache, frozenset(names), least), cache.criteria.exclusion_least)
            so = f"{short(limit)} would exclude it"
            if more > limit:
                so = "alone that might exclude it, but not with others as near or with numbers that only fit noise"
            yield f"{_and(names)}: chi-square {short(more)} above the best; {so}."
    for a in it.alike:
        if a.correlation > 0.9 and a.effect in it.sets[0] and a.size < a.needed:
            yield (
                f"{a.rival} looks like {a.effect} here (correlation {a.correlation:.3f}): to tell them apart takes "
                f"{sigma(a.needed)} sigma, there are {sigma(a.size)}."
            )


def _next(it: Diagnosis) -> Iterator[str]:
    if len(it.sets) < 2:
        return
    if it.next_test is None or not it.next_test.apart:
        listed = it.campaign.rig.usual_tests(it.campaign.tests[0].control)
        if listed is not None and not menu(it.campaign):
            yield "No planned test reads a sensor that exists: none can be proposed."
        else:
            yield "No test of these kinds tells them apart on this rig: measure the part itself."
        return
    first, *others = it.next_test.choices
    yield f"Next test: {in_words(first)}. {_how(first)}"
    for other in others:
        yield f"Only together with: {in_words(other)}. {_how(other)}"
    for a, b in it.next_test.apart:
        apart = float(np.sqrt(it.next_test.parted[(a, b)]))
        yield f"That tells {_and(it.sets[a])} from {_and(it.sets[b])}: they would differ by {sigma(apart)} sigma."


def _ended(words: str) -> str:
    return words if words.endswith("?") else f"{words}."


def _how(choice: Choice) -> str:
    held = [c for c, by in zip(COORDINATES, choice.test.control, strict=True) if by == "displacement"]
    return (
        f"Prescribe the displacement of {', '.join(held)} and forces elsewhere."
        if held
        else "Prescribe forces."
    )


def _and(names: tuple[str, ...]) -> str:
    return " + ".join(names) or "no further effect"
