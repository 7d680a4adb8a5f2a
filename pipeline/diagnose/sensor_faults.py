"""A fault of a sensor instead of an effect: where one explains as much, a name would be a guess."""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.diagnose.evidence import apart, numbers
from pipeline.diagnose.merit import badness
from pipeline.diagnose.patterns import scores
from pipeline.diagnose.rivals import Found
from pipeline.diagnose.shelf import Names


@dataclass(frozen=True)
class Instead:
    """A pattern that a sensor's fault leaves, beside the set without an effect. explains, of: chi-square that the
    pattern takes off with one number, and the effect with its own."""

    effect: str
    without: Names
    words: str
    explains: float
    of: float


def faults_instead(found: Found) -> tuple[Instead, ...]:
    """For each effect of the best set the plainest fault that the data do not exclude in its place.

    The same measure as between effects: worse by what tells so many numbers apart. A fault has one.
    """
    shelf, best = found.shelf, found.best
    out = []
    for name in shelf.order(best):
        effect, without = shelf.candidates[name], best - {name}
        if not effect.parameters or any(name in shelf.candidates[other].includes for other in without):
            continue
        gain = badness(shelf, without) - badness(shelf, best)
        every = scores(shelf.fit(without))
        if every and every[0].score ** 2 >= gain - apart(numbers(effect) - 1):
            out.append(Instead(name, without, every[0].words, every[0].score ** 2, gain))
    return tuple(out)
