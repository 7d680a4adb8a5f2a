"""The score as a page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import get_args

from pipeline.assessment.challenge.cases import SEED
from pipeline.assessment.challenge.outcome import Score
from pipeline.assessment.challenge.score import Scored

SCORES = tuple(get_args(Score))


def page(it: Scored) -> str:
    """Markdown."""
    lines = [
        "# The diagnosis on benches with hidden effects",
        "",
        f"{it.cases} virtual benches of the frame finite elements, seed {SEED}: nothing hidden, one effect, two, what "
        "no effect of the catalogue explains, and plans that cannot tell; rigs, bars, sensors, tests and sizes drawn "
        "at random. The diagnosis knows none of that. Again, with the code of "
        f"{', '.join(each[:12] for each in it.commits)}: `python -m pipeline challenge --cases {it.cases}`.",
        "",
        "| goal | wanted | found (95 % bounds, Clopper-Pearson) |",
        "|---|---|---|",
        *(f"| {g.name} | {g.wanted} | {g.share} |" for g in it.goals),
        "",
        "right: exactly what was hidden, or nothing where nothing was, or unknown where nothing known explains it · "
        "in set: one of the named sets is right · part: some of two effects, nothing else · missed: nothing was named "
        "· undecided: unknown where the catalogue explains it, or several sets where it does not · wrong: a name of "
        "what was not there.",
        "",
        *by_score("kind", it.kinds, SCORES),
        "## Single effects by size and confusability",
        "",
        "Size μ: sigmas of all fitted readings together. γ = 1/sqrt(1 - ρ), ρ the correlation with the effect that "
        "looks most like it. Formula: share that the rule μ = 2.33 γ for 95 % would name right.",
        "",
        f"| μ | γ | {' | '.join(SCORES)} | formula |",
        f"|---|---|{'---|' * (len(SCORES) + 1)}",
        *(
            f"| {_range(c.size)} | {_range(c.gamma)} | {_counts(c.scores, SCORES)} | "
            f"{'–' if c.formula is None else f'{100 * c.formula:.0f} %'} |"
            for c in it.cells
        ),
        "",
        *by_score("hidden effect", it.effects, SCORES),
        *by_score("outside the catalogue", it.faults, SCORES),
        f"A case took {it.seconds_median:.0f} s of one processor in the median, {it.seconds_95:.0f} s at most in 95 %.",
        f"Wrong names and false alarms: {', '.join(f'case {n}' for n in it.wrong) or 'none'}.",
        "",
        "`outcomes.jsonl` has every case, with the digest of its code; a run that was stopped goes on from it.",
        "",
    ]
    return "\n".join(lines)


def by_score(name: str, rows: Mapping[str, Mapping[str, int]], scores: Sequence[str]) -> list[str]:
    """A table of how many answers of each kind had which score; none without rows."""
    if not rows:
        return []
    head = [f"| {name} | {' | '.join(scores)} |", f"|---|{'---|' * len(scores)}"]
    return [*head, *(f"| {row} | {_counts(found, scores)} |" for row, found in rows.items()), ""]


def _counts(found: Mapping[str, int], scores: Sequence[str]) -> str:
    return " | ".join(str(found.get(score, "")) for score in scores)


def _range(ends: tuple[float, float]) -> str:
    return f"{ends[0]:g} .. {ends[1]:g}" if ends[1] < 1e8 else f"from {ends[0]:g}"
