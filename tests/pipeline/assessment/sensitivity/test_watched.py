"""Watched criteria: nothing that a changed one would decide otherwise goes unnoted."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from math import sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pipeline.assessment.sensitivity.trial import Verdict, varied_alone
from pipeline.assessment.sensitivity.watched import FACTORS, watched
from pipeline.selection.criteria import CRITERIA, Criteria

VALUES = np.array([0.5, 3.0, 9.0])


def _in_place(value: Any) -> float:
    out = np.array(3.0)
    out *= value
    return float(out)


WAYS: dict[str, Callable[[Criteria], object]] = {
    "compared": lambda it: it.exclusion > 3.0,
    "from the other side": lambda it: np.float64(4.0) < it.exclusion,
    "in an array": lambda it: (it.exclusion > VALUES).tolist(),
    "after arithmetic": lambda it: 2.0 * it.exclusion + 1.0 > 12.0,
    "of two": lambda it: it.exclusion * it.rival_gap > 200.0,
    "as a root": lambda it: sqrt(it.exclusion) > 2.5,
    "as numpy's root": lambda it: np.sqrt(it.exclusion) > 1.7,
    "the larger": lambda it: max(it.exclusion, 6.0) > 7.0,
    "times an array": lambda it: bool((it.exclusion * VALUES).max() > 50.0),
    "as turns": lambda it: len(list(range(it.sets_fitted))),
    "as a part of a list": lambda it: [1, 2, 3][: it.sets_fitted],
    "rounded": lambda it: round(it.exclusion),
    "by a method": lambda it: it.apart(2) > 13.0,
    "as truth": lambda it: bool(it.exclusion - 5.0),
    "as truth, else": lambda it: (it.exclusion - 2.5) or 7.0,
    "into an array": lambda it: np.greater(VALUES, it.exclusion, out=np.zeros(3, dtype=bool)).tolist(),
    "in place": lambda it: _in_place(it.exclusion),
    "as text": lambda it: f"{it.exclusion} {it.exclusion:g}",
    "as a whole number": lambda it: int(it.exclusion),
    "as a key": lambda it: {it.exclusion: 1}.get(5.0),
}


@pytest.mark.parametrize("way", WAYS)
def test_what_another_value_would_decide_is_noted(way: str) -> None:
    names = ("exclusion", "rival_gap", "sets_fitted", "exclusion_chance")
    criteria, noted = watched(names)
    told = WAYS[way](criteria)
    assert told == WAYS[way](CRITERIA)
    for name in names:
        for factor in FACTORS:
            if WAYS[way](CRITERIA.times(name, factor)) != told:
                assert (name, factor) in noted


@given(st.floats(0.0, 100.0), st.floats(-5.0, 5.0), st.floats(-5.0, 5.0))
def test_a_comparison_notes_those_that_turn_it_and_no_others(x: float, a: float, b: float) -> None:
    criteria, noted = watched(["exclusion"])
    told = bool(a * criteria.exclusion + b < x)
    others = {f: bool(a * (f * CRITERIA.exclusion) + b < x) for f in FACTORS}
    assert {f for _, f in noted} == {f for f, other in others.items() if other != told}


def test_no_copy_notes_what_is_lost() -> None:
    with pytest.raises(TypeError, match="stays in its process"):
        deepcopy(watched(["exclusion"])[0])


def test_what_decided_nothing_is_not_asked_about_again() -> None:
    asked: list[Criteria] = []

    def ask(criteria: Criteria) -> Verdict:
        asked.append(criteria)
        named = "load_offset" if criteria.exclusion < 4.0 else "modulus_error"
        return Verdict(verdict="identified", sets=((named,),), score="right" if len(named) > 11 else "wrong")

    here, changes = varied_alone(ask, ("exclusion", "rival_gap"))
    assert here.sets == (("modulus_error",),)
    assert [(c.criterion, c.factor, c.answer.score) for c in changes] == [("exclusion", 0.5, "wrong")]
    assert len(asked) == 2
