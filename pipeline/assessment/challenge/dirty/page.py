"""The score of the dirty programme as a page, beside that of the clean one."""

from __future__ import annotations

from typing import get_args

from pipeline.assessment.challenge.dirty.cases import SEED
from pipeline.assessment.challenge.dirty.judged import Score
from pipeline.assessment.challenge.dirty.score import DirtyScored
from pipeline.assessment.challenge.page import by_score
from pipeline.assessment.challenge.score import Scored

SCORES = tuple(get_args(Score))


def dirty_page(it: DirtyScored, clean: Scored | None) -> str:
    """Markdown; clean: the other score, where there is one."""
    others = {} if clean is None else {goal.name: goal for goal in clean.goals}
    lines = [
        "# The diagnosis on benches as they are",
        "",
        f"{it.cases} virtual benches of the frame finite elements, seed {SEED}. The bar is up to 3 % beside its "
        "drawing; load cell and dials have gains up to 1 % off and noise in proportion to the reading, both as "
        "written under [noise]; up to 2 % of the readings are knocked by 15 to 60 sigma; sigmas are declared half or "
        "twice as large as they are; noise is correlated from row to row; displays round. Each of it in some benches, "
        "the bar in all. A bad reading that is told with another of its step in its place is found where either was "
        "knocked. One shows where a method that knew the true model would see it in nine of ten noises: what was "
        "prescribed and moves nothing that is read does not, however far it is off. Hidden are nothing, one to three "
        "effects, a fault of one sensor, or what nothing known "
        f"explains. With the code of {', '.join(each[:12] for each in it.commits)}: "
        f"`python -m pipeline challenge --dirty --cases {it.cases}`.",
        "",
        "| goal | wanted | found (95 % bounds, Clopper-Pearson) |",
        "|---|---|---|",
        *(f"| {g.name} | {g.wanted} | {g.share} |" for g in it.goals),
        "",
        "A large effect shows by max(3γ, 6) sigmas, after tolerances. right: exactly what was hidden, or nothing where "
        "nothing was, or unknown or the faulty sensor where nothing known explains it · in set: one of the named sets "
        "is right · certain: none of these, but what is told as certain is there · part: some of it, nothing else · "
        "missed: nothing was named · undecided: unknown · doctor: a mistake of the table is told that is not there · "
        "wrong: a name of what was not there, certain included.",
        "",
        *by_score("kind", it.kinds, SCORES),
        *by_score("hidden", it.effects, SCORES),
        *by_score("nothing known explains it", it.faults, SCORES),
        f"A case took {it.seconds_median:.0f} s of one processor in the median, {it.seconds_95:.0f} s at most in 95 %. "
        f"Wrong names and false alarms: {', '.join(f'case {n}' for n in it.wrong) or 'none'}.",
        "",
    ]
    if others:
        lines += [
            "The same goals on clean benches: "
            + "; ".join(f"{name} {goal.share}" for name, goal in list(others.items())[:2])
            + ".",
            "",
        ]
    return "\n".join(lines)
