"""Predictions of some rows of a campaign, and of all rows from those of parts.

What is fitted looks at fitted rows alone. Rows that were held out cost as much, and where tests are filled up to
equal numbers of steps a long one among short ones costs many times that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.load_cases import Group, LoadCases
from pipeline.inference.predicted import Prediction
from vjm.equilibrium import Equilibrium

Rows = NDArray[np.int64]
ARRAYS = ("values", "by_inputs", "by_free", "shift", "stops", "slides", "lost")
"""Of a prediction, by rows."""


def at_rows(found: Prediction, cases: LoadCases, part: LoadCases, rows: Rows) -> Prediction:
    """The prediction of all cases at these rows (R,), laid out as in the load cases of these rows alone."""
    arrays = {name: getattr(found, name)[rows] for name in ARRAYS}
    if found.nominal.size:
        arrays["by_nominal"] = found.by_nominal[rows]
    reasons = {k: found.reasons[int(row)] for k, row in enumerate(rows) if int(row) in found.reasons}
    return replace(found, states=states_at(found, cases, part, rows), reasons=reasons, **arrays)


def rows_in(cases: LoadCases, other: LoadCases) -> Rows | None:
    """The rows (R,) of other load cases that are those of cases, by test and step; None where some are not there."""
    names = [(test.id, int(step)) for test in other.campaign.tests for step in test.data.steps]
    places = {name: row for row, name in enumerate(names)}
    wanted = [(test.id, int(step)) for test in cases.campaign.tests for step in test.data.steps]
    return np.array([places[name] for name in wanted]) if all(name in places for name in wanted) else None


def carried(found: Prediction, cases: LoadCases, other: LoadCases) -> Prediction | None:
    """A prediction of other load cases at the rows of cases; None where some are not there, or of another rig."""
    rows = rows_in(cases, other)
    known = all(any(group.rig.stands_as(one.rig) for one in other.groups) for group in cases.groups)
    return None if rows is None or not known else at_rows(found, other, cases, rows)


def states_at(found: Prediction, cases: LoadCases, part: LoadCases, rows: Rows) -> tuple[Equilibrium, ...]:
    """The states of a prediction of all cases at these rows (R,), laid out as in `part`, the load cases of these alone:
    in its order."""
    out = []
    for group in part.groups:
        number = next(k for k, one in enumerate(cases.groups) if one.rig.stands_as(group.rig))
        whole, state = cases.groups[number], found.states[number]
        width, length = whole.rise.shape[1], group.rise.shape[1]
        places = np.zeros(group.rise.shape, dtype=np.int64)
        for k, own in enumerate(group.numbers):
            test, steps = _place(cases, whole, rows[part.first[own] : part.first[own + 1]])
            places[k] = test * width + steps[np.minimum(np.arange(length), steps.size - 1)]
        flat = state.reshaped(whole.rise.size).member(places.ravel())
        out.append(flat.reshaped(len(group.numbers), length))
    return tuple(out)


def _place(cases: LoadCases, group: Group, rows: Rows) -> tuple[int, Rows]:
    """Where rows (N,) of one test stand in a group: number of the test there, and their steps (N,)."""
    test = cases.test[rows[0]]
    return int(np.flatnonzero(group.numbers == test)[0]), rows - cases.first[test]


def states_with(
    found: Prediction,
    cases: LoadCases,
    part: LoadCases,
    rows: Rows,
    other: Prediction,
    some: NDArray[np.bool_],
) -> tuple[Equilibrium, ...]:
    """The states of a prediction of all cases, with those of `some` (N,) of these rows from one of them alone."""
    out = list(found.states)
    for group, state in zip(part.groups, other.states, strict=True):
        number = next(k for k, one in enumerate(cases.groups) if one.rig.stands_as(group.rig))
        for k, own in enumerate(group.numbers):
            mine = slice(part.first[own], part.first[own + 1])
            test, steps = _place(cases, cases.groups[number], rows[mine])
            taken = np.flatnonzero(some[mine])
            there = state.member((np.full(taken.size, k), taken))
            out[number] = out[number].with_members((np.full(taken.size, test), steps[taken]), there)
    return tuple(out)


def joined(cases: LoadCases, pieces: Sequence[tuple[Rows, LoadCases, Prediction]]) -> Prediction:
    """The prediction of all cases from those of parts: rows (R,), load cases and prediction of each, whole tests."""
    arrays: dict[str, NDArray[Any]] = {}
    reasons: dict[int, str] = {}
    for name in ARRAYS:
        first = getattr(pieces[0][2], name)
        arrays[name] = np.zeros((len(cases.test), *first.shape[1:]), dtype=first.dtype)
        for rows, _, found in pieces:
            arrays[name][rows] = getattr(found, name)
    first = pieces[0][2]
    if first.nominal.size:
        arrays["nominal"] = first.nominal
        arrays["by_nominal"] = np.zeros((len(cases.test), *first.by_nominal.shape[1:]))
        for rows, _, found in pieces:
            arrays["by_nominal"][rows] = found.by_nominal
    for rows, _, found in pieces:
        reasons |= {int(rows[k]): said for k, said in found.reasons.items()}
    states = tuple(_joined_states(cases, number, pieces) for number in range(len(cases.groups)))
    return Prediction(reasons=reasons, states=states, **arrays)


def _joined_states(
    cases: LoadCases, number: int, pieces: Sequence[tuple[Rows, LoadCases, Prediction]]
) -> Equilibrium:
    """Those of a group; its tests filled up with their last step, as in the parts."""
    group = cases.groups[number]
    names = [cases.campaign.tests[n].id for n in group.numbers]
    steps = np.arange(group.rise.shape[1])
    out: Equilibrium | None = None
    for _, part, found in pieces:
        for inner, state in zip(part.groups, found.states, strict=True):
            if not inner.rig.stands_as(group.rig):
                continue
            mine = np.array([names.index(part.campaign.tests[n].id) for n in inner.numbers])
            last = np.minimum(steps, inner.rise.shape[1] - 1)
            if out is None:
                every = np.zeros(len(names), dtype=np.int64)
                every[mine] = np.arange(mine.size)
                out = state.member((every[:, None], last))
            else:
                there = state.member((np.arange(mine.size)[:, None], last))
                out = out.with_members((mine[:, None], steps), there)
    if out is None:
        raise ValueError(f"no part has a test of group {number}")
    return out
