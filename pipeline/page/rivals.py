"""What a diagnosis leaves possible: every set of effects with its own numbers, each as an answer of its own."""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.answer.of_diagnosis import answered
from pipeline.answer.record import Answer
from pipeline.callbacks import OnProgress
from pipeline.inference.fit import Fit
from pipeline.page.record import RivalPage
from pipeline.selection.diagnosis import Diagnosis

MOST = 4
"""Sets that stand side by side on a page; a verdict of more names them all."""


@dataclass(frozen=True, eq=False)
class Possible:
    """One set: its record, and its fit."""

    answer: Answer
    fit: Fit


def possible(
    found: Diagnosis, answer: Answer, on_progress: OnProgress = lambda _: None, most: int = MOST
) -> tuple[Possible, ...]:
    """The sets that a verdict leaves, the simplest first; one where it is not ambiguous.

    answer: that of the diagnosis, which is the first of them. Each of the others is the diagnosis with its
    own set as the first.
    """
    first = Possible(answer, found.fit)
    if found.verdict != "ambiguous":
        return (first,)
    return (first, *(_with(found, names, on_progress) for names in found.sets[1:most]))


def pages_of(sets: tuple[Possible, ...]) -> tuple[RivalPage, ...]:
    """As a page has them; none where the verdict leaves one only."""
    every = (it.answer for it in sets if it.answer.verdict == "ambiguous")
    return tuple(RivalPage(effects=it.effects, error=it.error[-1], parameters=it.parameters) for it in every)


def _with(found: Diagnosis, names: tuple[str, ...], on_progress: OnProgress) -> Possible:
    """The answer with another set as the first."""
    on_progress(" + ".join(names))
    about = found.about(names)
    return Possible(answered(about), about.fit)
