"""Predictions of parts of a campaign: the same as among all, and put together they are those of all."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from pipeline.assessment.coverage.cases import BASE
from pipeline.assessment.coverage.trial import campaign
from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit, fit
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.inference.subsets import ARRAYS, at_rows, joined, states_at, states_with
from vjm.effects import catalogue

HIDDEN = (("modulus_error.scale", 0.9),)


@cache
def whole() -> Campaign:
    """Three tests to fit and two held out, one of them between the others and longer."""
    few, many = campaign(HIDDEN, 3, 6), campaign(HIDDEN, 3, 9)
    held = [replace(test, role="holdout") for test in many.tests[:1]]
    tests = (few.tests[1], *held, few.tests[3], few.tests[5], few.tests[-1])
    return replace(
        few, tests=tuple(replace(test, id=f"{k}", rig=tests[0].rig) for k, test in enumerate(tests))
    )


@cache
def cases() -> LoadCases:
    return load_cases(whole())


def model(name: str) -> Model:
    return Model().with_effects([catalogue()[each] for each in (BASE, name)])


@pytest.mark.parametrize("name", ["modulus_error", "joint_friction"])
def test_parts_are_the_whole(name: str) -> None:
    """Readings within a hundred-thousandth of their sigmas; states are handed on as they are."""
    it = model(name)
    every = predict(it, cases())
    parts = [(rows, part, predict(it, part)) for rows, part in cases().by_role]
    assert [rows.size for rows, _, _ in parts] == [18, 15]
    together = joined(cases(), parts)
    for array in ARRAYS:
        one, other = getattr(every, array), getattr(together, array)
        size = float(np.abs(one[np.isfinite(one)]).max(initial=1e-9))
        np.testing.assert_allclose(other, one, atol=1e-5 * size, err_msg=array)
    for (rows, part, alone), (_, _, again) in zip(
        parts, [(r, p, at_rows(together, cases(), p, r)) for r, p, _ in parts], strict=True
    ):
        np.testing.assert_array_equal(again.values, alone.values)
        for group, one, other in zip(part.groups, again.states, alone.states, strict=True):
            np.testing.assert_array_equal(one.unknowns[group.real], other.unknowns[group.real])
        assert rows.size == part.test.size


@pytest.mark.parametrize("name", ["joint_clearance", "joint_friction"])
def test_readings_alone_are_those_with_derivatives(name: str) -> None:
    alone, whole = (predict(model(name), cases(), slopes=False, order=order) for order in (0, 2))
    np.testing.assert_array_equal(alone.values, whole.values)
    np.testing.assert_array_equal(alone.stops[..., 0], whole.stops[..., 0])
    assert not alone.by_inputs.any() and whole.by_inputs.any()
    assert alone.by_free.shape == whole.by_free.shape and alone.lost.shape == whole.lost.shape


def test_states_of_some_rows_take_their_place() -> None:
    """Those of other inputs at some rows of two tests; all other rows keep theirs."""
    it, rows = model("modulus_error"), np.array([1, 3, 4, 20, 22, 23])
    some = np.array([True, False, True, False, True, False])
    shift = np.zeros((len(cases().test), 7))
    shift[rows, 0] = 1e-3
    part = cases().only(rows)
    before, moved = predict(it, cases()), predict(it, part, shift=shift[rows])
    after = replace(before, states=states_with(before, cases(), part, rows, moved, some))
    expected = predict(
        it, cases(), shift=np.where(np.isin(np.arange(len(shift)), rows[some])[:, None], shift, 0.0)
    )
    for group, one, other in zip(cases().groups, after.states, expected.states, strict=True):
        np.testing.assert_allclose(
            one.unknowns[group.real],
            other.unknowns[group.real],
            rtol=1e-9,
            atol=1e-9 * np.abs(other.unknowns).max(),
        )
    changed = [
        not np.array_equal(a.unknowns, b.unknowns) for a, b in zip(after.states, before.states, strict=True)
    ]
    assert any(changed)


def test_sets_that_share_rows_are_predicted_beside_each_other() -> None:
    it, sets = model("modulus_error"), (np.array([1, 3, 4, 20]), np.array([3, 4, 22, 23]))
    together = cases().only(*sets)
    every = np.concatenate(sets)
    np.testing.assert_array_equal(together.measured, cases().measured[every])
    before, shift = predict(it, cases()), np.zeros((every.size, 7))
    shift[:, 0] = 1e-3 * np.arange(every.size)
    begin = replace(before, states=states_at(before, cases(), together, every))
    found = predict(it, together, start=begin, shift=shift)
    for rows, own in zip(sets, (slice(0, 4), slice(4, 8)), strict=True):
        alone = predict(it, cases().only(rows), shift=shift[own])
        np.testing.assert_allclose(
            found.values[own] / cases().sigma, alone.values / cases().sigma, rtol=0, atol=1e-7
        )


def test_lost_rows_keep_their_reasons() -> None:
    found = predict(model("modulus_error"), cases())
    lost = np.zeros(33, dtype=bool)
    lost[[2, 8, 30]] = True
    found = replace(found, lost=lost, reasons={2: "a", 8: "b", 30: "c"})
    parts = [(rows, part, at_rows(found, cases(), part, rows)) for rows, part in cases().by_role]
    assert [sorted(each.reasons.values()) for _, _, each in parts] == [["a"], ["b", "c"]]
    assert joined(cases(), parts).reasons == found.reasons


def test_what_is_held_out_changes_no_fit() -> None:
    alone = replace(whole(), tests=tuple(t for t in whole().tests if t.role == "fit"))
    one: Fit = fit(model("modulus_error"), cases())
    two: Fit = fit(model("modulus_error"), load_cases(alone))
    np.testing.assert_allclose(one.model.values, two.model.values, rtol=1e-9)
    assert one.chi_square == pytest.approx(two.chi_square, rel=1e-9) and one.degrees == two.degrees
    # Those held out are predicted all the same, and as the whole campaign would be.
    held = ~cases().fitted
    assert np.all(np.abs(one.residual.values[held]) < 6.0) and np.any(one.residual.values[held])
    np.testing.assert_allclose(
        one.prediction.values[held] / cases().sigma,
        predict(one.model, cases(), shift=one.prediction.shift).values[held] / cases().sigma,
        atol=1e-4,
    )


def test_all_alike_are_one_part() -> None:
    ((rows, part),) = load_cases(replace(whole(), tests=whole().tests[2:4])).by_role
    assert rows.size == 12 == part.test.size
