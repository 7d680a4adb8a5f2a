"""The thresholds of the choice, and the score that they have on benches with known hidden effects."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

from scipy.stats import norm

from docs.made.lists import rows
from pipeline.assessment.challenge.page import SCORES
from pipeline.assessment.challenge.score import Scored
from pipeline.selection.criteria import CRITERIA

ROOT = Path(__file__).resolve().parents[2]
SCORE = ROOT / "reports" / "challenge" / "challenge.json"


@cache
def scored() -> Scored:
    """The score that is kept with the project."""
    return Scored.model_validate_json(SCORE.read_text(encoding="utf-8"))


def criteria() -> str:
    """Every threshold with its unit, meaning and source, by what it decides."""
    groups = dict.fromkeys(each.group for each in CRITERIA.of())
    parts = []
    for group in groups:
        lines = [
            (f"`{each.name}`", f"{each.value:g}", each.unit, _cell(each.meaning), _cell(each.source))
            for each in CRITERIA.of()
            if each.group == group
        ]
        table = rows(("name", "value", "unit", "meaning", "source"), lines)
        parts.append(f"## {group[0].upper()}{group[1:]}\n\n{table}")
    return "\n".join(parts)


def score() -> str:
    """What was wanted and what was found, with Clopper-Pearson bounds."""
    found = scored()
    lines = [(goal.name, goal.wanted, str(goal.share)) for goal in found.goals]
    table = rows(("goal", "wanted", "found (95 % bounds)"), lines)
    return (
        f"{found.cases} virtual benches; a case took {found.seconds_median:.0f} s of one processor in the median, "
        f"{found.seconds_95:.0f} s at most in 95 %.\n\n{table}"
    )


def by_effect() -> str:
    """Outcomes by hidden effect."""
    found = scored().effects
    there = {kind for outcomes in found.values() for kind in outcomes}
    kinds = [kind for kind in SCORES if kind in there]
    lines = [
        (f"[`{name}`](#effect-{name})", *(str(outcomes.get(kind, "")) for kind in kinds))
        for name, outcomes in sorted(found.items())
    ]
    return rows(("hidden effect", *kinds), lines)


def _cell(text: str) -> str:
    return text.replace("|", r"\|").replace("*", r"\*").replace("<", "&lt;")


def wrong_name() -> str:
    """Largest chance to name the wrong one of two effects: Phi(-(a² + e) / (2 a)) at a² = e, e the criterion."""
    return f"{100 * norm.cdf(-(CRITERIA.exclusion**0.5)):.1f}"


PIECES: dict[str, Callable[[], str]] = {
    "criteria": criteria,
    "chance of a wrong name": wrong_name,
    "score": score,
    "score by effect": by_effect,
}
for _each in CRITERIA.of():
    PIECES[f"criterion {_each.name}"] = lambda value=_each.value: f"{value:g}"  # type: ignore[misc]
