"""The score of an answer to a dirty case, what it tells as certain included."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from pipeline.assessment.challenge.dirty.cases import DirtyCase
from pipeline.assessment.challenge.faults import AT_FAULT, of_sensor
from pipeline.assessment.challenge.outcome import of_effects, of_nothing

Score = Literal[
    "right", "in set", "certain", "part", "missed", "undecided", "doctor", "wrong", "false alarm", "failed"
]
"""right: exactly what was hidden, or that nothing was, or that nothing known explains it. in set: one of the sets is
right. certain: none of these, but what is told as certain is there. part: some of it, and nothing else. missed: nothing
was named where something was hidden. undecided: unknown where something was hidden. doctor: a mistake of the table is
told that is not there. wrong: a name, certain included, of what was not there. false alarm: one where nothing was
hidden. failed: no answer."""


def judged(
    it: DirtyCase, verdict: str, sets: Sequence[Sequence[str]], certain: Sequence[str], doctor: bool
) -> Score:
    """The score of an answer; names without what every bench has."""
    truth, named, sure = set(it.effects), [set(names) for names in sets], set(certain)
    at_fault = AT_FAULT.get(it.fault[0], ()) if it.fault else ()
    if doctor:
        return "doctor"
    if any(name not in truth and not of_sensor(name, at_fault) for name in sure):
        return "false alarm" if it.kind == "clean" else "wrong"
    if it.fault:
        return _of_fault(verdict, named, at_fault)
    if verdict == "unknown":
        found: Score = "undecided"
    else:
        found = of_effects(named, truth) if truth else of_nothing(named)
    return "certain" if sure and found in ("undecided", "part", "missed") else found


def _of_fault(verdict: str, named: Sequence[set[str]], at_fault: Sequence[str]) -> Score:
    if verdict == "unknown":
        return "right"
    if not any(named):
        return "missed"
    if all(names and all(of_sensor(name, at_fault) for name in names) for names in named):
        return "right"
    return "wrong" if len(named) == 1 else "undecided"
