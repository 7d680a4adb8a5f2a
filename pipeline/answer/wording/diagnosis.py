"""A diagnosis as an engineer would say it, from its record alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import sqrt
from typing import Any

from pipeline.answer.evidence import Evidence, Explained
from pipeline.answer.record import Answer, SetAside
from pipeline.answer.wording.added import limits, written
from pipeline.answer.wording.doctor import doctor_sentence, lines_aside, mends
from pipeline.parameter_names import parted
from reports.quantities import estimate, p_is, percent, phrase, short, sigma

SIZE = "size"
"""Name of the check that looks at the sum of squares alone."""
CARRIES = 0.7
"""Part of the misfit that may be left of a test, for the others to foretell it."""


def sentences(it: Answer) -> tuple[str, ...]:
    """All that is worth saying, the verdict first."""
    evidence = it.evidence or Evidence(sets=(it.added,))
    remarks = tuple(f"{r}." for r in evidence.remarks)
    if it.doctor:
        return (*_doctored(it, evidence), *evidence.units, *remarks)
    told = list(evidence.units)
    if it.verdict != "nothing_tested":
        for part in (_effects, _aside, _limits, _left, _laws, _from_row_to_row, _rivals, _next):
            told += part(it, evidence)
    return (*_verdict(it, evidence), *told, *(f"{said}." for said in it.not_done), *remarks)


def _doctored(it: Answer, evidence: Evidence) -> Iterator[str]:
    """The mistakes of a table, and what mends each."""
    said = doctor_sentence(it.doctor)
    told = f"{evidence.zero} {said[0].upper()}{said[1:]}" if evidence.zero else said
    yield f"{it.verdict}: {told} Nothing is named before that is settled."
    yield from mends(it.doctor)


def _verdict(it: Answer, evidence: Evidence) -> Iterator[str]:
    if evidence.untested:
        yield evidence.untested
        return
    best, sets = evidence.sets[0], evidence.sets
    asked = f"{evidence.zero} " if evidence.zero else ""
    asked += _surely(it)
    if it.verdict == "nothing_tested":
        yield f"nothing_tested: {asked}With that zero unknown no reading is left to test a model by."
        return
    before, rms = it.error[0].fit, it.error[-1].fit
    fall = f"the error {'falls' if rms <= before else 'goes'} from {sigma(before)} to {sigma(rms)} sigma (1 is noise)"
    if it.verdict == "within_noise":
        yield f"within_noise: the model explains the measurements, {sigma(rms)} sigma are left (1 is noise)."
    elif it.verdict == "identified":
        yield f"identified: {_and(best)}; {fall}."
    elif it.verdict == "ambiguous":
        fault = ["a fault of a sensor"] if evidence.sensors else []
        law = [evidence.law] if evidence.law else []
        said = " or ".join([*map(_and, sets), *fault, *law])
        yield f"ambiguous: {asked}{said}; these tests cannot tell; {fall}."
    elif evidence.because:
        yield f"unknown: {asked}{_and(best)} would explain the misfit, {fall}, but {evidence.because}."
    elif best and rms > before:
        told = f"{_and(best)}, the nearest, leaves {sigma(rms)}"
        yield f"unknown: {asked}the misfit of {sigma(before)} sigma is no noise, {_unexplained(evidence)}; {told}."
    elif best:
        rest = f"what is left is no noise {_unexplained(evidence)}"
        yield f"unknown: {asked}{_and(best)} {'helps' if len(best) == 1 else 'help'}, {fall}, but {rest}."
    elif evidence.zero:
        yield f"unknown: {asked}Nothing is named before that is settled; the misfit is {sigma(rms)} sigma."
    else:
        yield f"unknown: the misfit of {sigma(rms)} sigma is no noise, {_unexplained(evidence)}."


def _unexplained(evidence: Evidence) -> str:
    """What was found of misfit that is no noise."""
    if evidence.unlooked:
        return f"and no single effect explains it; sets of them were not looked for: {evidence.unlooked}"
    return "and nothing known explains it"


def _surely(it: Answer) -> str:
    """What is certain beside a verdict that leaves something open."""
    if not it.certain:
        return ""
    told = [f"{each.effect}{_values(it, each.effect, ' (', ')')}" for each in it.certain]
    return f"{_listed(told)} {'are' if len(told) > 1 else 'is'} certain; "


def _listed(words: list[str]) -> str:
    *others, last = words
    return f"{', '.join(others)} and {last}" if others else last


def _effects(it: Answer, evidence: Evidence) -> Iterator[str]:
    """Each effect: what it is, how much it explains, how it looks."""
    for each in evidence.explained:
        shows = "" if each.size is None else f" It shows by {sigma(each.size)} sigma in these tests together."
        again = (
            ""
            if each.chosen_again is None
            else f" With one test left out it is chosen again in {percent(each.chosen_again)} of cases."
        )
        what = f"{each.effect}: {each.title}, {each.equation}. In data: {each.signature}."
        if each.held_out_only:
            what += " The tests that were fitted do not show it, those held out need it."
        yield f"{what}{shows}{again}{_values(it, each.effect)}{_where(each)}"


def _where(it: Explained) -> str:
    if it.only_angle_deg is None:
        return ""
    return (
        f" Only tests at q = {it.only_angle_deg:g}° show it ({', '.join(it.only_tests)}): whether it is there at "
        "other angles these data do not say, the same at another angle would."
    )


def _values(it: Answer, effect: str, before: str = " Fitted: ", after: str = ".") -> str:
    """The fitted parameters of an effect between these words; nothing where there are none."""
    said = [
        phrase(parted(path)[1], estimate(value.model_dump()), value.unit)
        for path, value in it.parameters.items()
        if parted(path)[0] == effect and value.interval != "fixed"
    ]
    return f"{before}{', '.join(said)}{after}" if said else ""


def _aside(it: Answer, evidence: Evidence) -> Iterator[str]:
    """What was found of the readings themselves, and the verdict with all of them as they were declared."""
    if it.set_aside:
        told = ", ".join(
            f"{b.column} at {b.place} ({sigma(b.sigma)} sigma{_or_else(b)})" for b in it.set_aside
        )
        each = "they are" if len(it.set_aside) > 1 else "it is"
        yield f"Set aside, for {each} off alone and what is beside is not: {told}."
        cells = [(b.test, b.step, b.column) for b in it.set_aside]
        yield f"Other commands keep what stands in the table: to leave it out of all write {lines_aside(cells)}."
    law = next((found.tails for found in it.noise if found.tails is not None), None)
    if law is not None:
        yield (
            f"The noise has long tails (Student's law of {law:.1f} degrees of freedom): readings far out "
            "count less, none is set aside."
        )
    for found in (found for found in it.noise if found.tails is None and found.correlation is None):
        error = "" if found.relative_error is None else f" (± {percent(found.relative_error)})"
        yield (
            f"{found.column} scatters by {short(found.found)}{error}, not by the {short(found.declared)} that is "
            "declared: what it does counts."
        )
    if it.as_declared is not None:
        by = ", by the best single effect" if evidence.as_declared_of_one else ""
        yield f"With all readings and sigmas as they are declared the verdict would be {it.as_declared}{by}."


def _or_else(bad: SetAside) -> str:
    return f", or {' or '.join(bad.instead)} of that step in its place" if bad.instead else ""


def _limits(it: Answer, _: Evidence) -> Iterator[str]:
    yield from limits(it)
    yield from written(it)


def _left(it: Answer, evidence: Evidence) -> Iterator[str]:
    """What the checks say of the rest, and what comes close where nothing explains it."""
    for check in evidence.failed_checks:
        yield f"Not noise ({check.name}, {p_is(check.p_value)}): {check.words}."
    if evidence.larger_scatter:
        yield f"By its order along the load paths the rest is noise, but {evidence.larger_scatter}."
    if it.verdict != "unknown":
        return
    if [check.name for check in evidence.failed_checks] == [SIZE]:
        yield (
            "It has no order along the load paths, no pattern, and no sensor or test of its own: sigmas that are "
            f"{percent(it.error[-1].fit - 1.0)} larger would explain it. Repeat one step some times, and declare "
            "how much the repeats scatter."
        )
    if evidence.ended_after is not None and not evidence.because:
        yield (
            f"The search ended after {evidence.ended_after} fits, as it takes long: what was not looked at may "
            "explain more."
        )
    for near in evidence.near:
        why = f": {near.against}" if near.against else ""
        yield f"{_and(near.effects)} leaves {sigma(near.rms)} sigma{why}."
    for rest in evidence.rest:
        carries = (
            f"known from the other tests it would be {sigma(rest.elsewhere)}"
            if rest.elsewhere < CARRIES * rest.rms
            else "which the other tests do not foretell"
        )
        yield (
            f"A description, not physics (Gaussian process): the rest of {rest.channel}, {sigma(rest.rms)} sigma, "
            f"varies with {', '.join(rest.inputs) or 'nothing that was prescribed'}; {carries}."
        )


def _laws(_: Answer, evidence: Evidence) -> Iterator[str]:
    yield from evidence.law_words


def _from_row_to_row(it: Answer, evidence: Evidence) -> Iterator[str]:
    """What noise that is correlated explains, or does to intervals."""
    mine = {found.column: found.correlation for found in it.noise if found.correlation is not None}
    if not mine:
        return
    told = _listed([f"{column} ({correlation:.2f})" for column, correlation in mine.items()])
    if it.verdict == "unknown":
        beside = _and(evidence.beside_correlated)
        yield (
            f"One explanation of the rest is noise that is correlated from row to row, of {told}: beside {beside} it "
            "explains all. Hold one load and read it thirty times: if neighbours are alike there too, it is noise."
        )
        return
    largest = max(mine.values())
    wider = sqrt((1.0 + largest) / (1.0 - largest))
    yield (
        f"The noise of {told} is correlated from row to row. Intervals are for noise that is not: of numbers that "
        f"this column alone tells they may be up to {wider:.1f} times as wide."
    )


def _rivals(_: Answer, evidence: Evidence) -> Iterator[str]:
    for fault in evidence.sensors:
        if not fault.effect:
            yield (
                f"Look first whether the sensor was zeroed: {fault.words} That takes {short(fault.explains)} "
                f"off chi-square beside {_and(fault.beside)}; say so in campaign.toml and diagnose again."
            )
            continue
        yield (
            f"Instead of {fault.effect} a sensor may be at fault: {_ended(fault.words)} That takes "
            f"{short(fault.explains)} off chi-square with one number, {fault.effect} {short(fault.of)}: "
            "check that sensor, or measure again with another."
        )
    for rival in evidence.rivals:
        so = f"{short(rival.would_exclude)} would exclude it"
        if rival.above_best > rival.would_exclude:
            so = (
                "alone that might exclude it, but not with others as near or with numbers that only fit noise"
            )
        yield f"{_and(rival.effects)}: chi-square {short(rival.above_best)} above the best; {so}."
    for a in evidence.look_alikes:
        yield (
            f"{a.rival} looks like {a.effect} here (correlation {a.correlation:.3f}): to tell them apart takes "
            f"{sigma(a.needed)} sigma, there are {sigma(a.size)}."
        )


def no_next_test(evidence: Evidence | None) -> str:
    """What to do where several sets fit and no planned test tells them apart."""
    if evidence is not None and evidence.no_sensor:
        return "No planned test reads a sensor that exists: none can be proposed."
    return (
        "No further test with these sensors tells them apart: add a sensor at another place, or measure the part "
        "itself."
    )


def _next(it: Answer, evidence: Evidence) -> Iterator[str]:
    if len(evidence.sets) < 2:
        return
    test: Mapping[str, Any] | None = it.next_test
    if test is None:
        yield no_next_test(evidence)
        return
    yield f"Next test: {test['why']}. {_how(test)}"
    for other in test["together_with"]:
        yield f"Only together with: {other['why']}. {_how(other)}"
    for (one, two), expected in zip(test["tells_apart"], test["expected_chi_square"], strict=True):
        yield (
            f"That tells {_and(one)} from {_and(two)}: they would differ by {sigma(sqrt(expected))} sigma."
        )


def _ended(words: str) -> str:
    return words if words.endswith("?") else f"{words}."


def _how(test: Mapping[str, Any]) -> str:
    held = [coordinate for coordinate, by in test["control"].items() if by == "displacement"]
    return (
        f"Prescribe the displacement of {', '.join(held)} and forces elsewhere."
        if held
        else "Prescribe forces."
    )


def _and(names: Sequence[str]) -> str:
    return " + ".join(names) or "no further effect"
