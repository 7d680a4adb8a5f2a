"""Laws that remember: a test ends at the step that has no equilibrium, and no other test is touched."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from pipeline.inference import history
from pipeline.inference.load_cases import Group, load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.selection.signatures import probed
from tests.pipeline.selection.bench import bench
from tests.vjm.load_paths import load_path
from vjm.effects import catalogue
from vjm.effects.base import Rig
from vjm.equilibrium import Equilibrium
from vjm.lagrangian import layout
from vjm.reasons import Reason

CASES = load_cases(
    bench("joint_friction.torque_Nmm", 200.0, ("swing_q+0", "axial_held_q+0", "axial_held_q+15"))
)
SWING = load_cases(bench("joint_friction.torque_Nmm", 200.0, ("swing_q+0",)))
NAMES = ("bar_geometric_nonlinearity", "joint_friction")
MODEL = Model().with_effects([catalogue()[name] for name in NAMES])
MODEL = MODEL.at(np.array([200.0 if f.parameter.name == "torque_Nmm" else 2e-3 for f in MODEL.free]))


def test_a_test_ends_where_a_step_is_lost() -> None:
    """A force that no state bears at one step; what the hinges remember after it nobody knows."""
    test = next(k for k, t in enumerate(CASES.campaign.tests) if t.id == "axial_held_q+0")
    row = int(CASES.first[test]) + 5
    shift = np.zeros((len(CASES.test), 7))
    shift[row, 0] = -1e12
    before, after = predict(MODEL, CASES, slopes=False), predict(MODEL, CASES, slopes=False, shift=shift)
    ended = (CASES.test == test) & (np.arange(len(CASES.test)) >= row)
    assert not before.lost.any()
    np.testing.assert_array_equal(after.lost, ended)
    assert {after.reasons[k] for k in np.flatnonzero(ended)[1:]} == {Reason.ENDED}
    assert after.reasons[row] != Reason.ENDED
    np.testing.assert_allclose(after.values[~ended], before.values[~ended], rtol=1e-9, atol=1e-9)


def test_all_tests_may_end() -> None:
    rows = CASES.first[:-1] + 5
    shift = np.zeros((len(CASES.test), 7))
    shift[rows, 0] = np.where(CASES.channels[rows, 0] >= 6, -1e12, 0.0)
    shift[rows, 1] = np.where(CASES.channels[rows, 1] >= 6, -1e12, 0.0)
    after = predict(MODEL, CASES, slopes=False, shift=shift)
    steps = np.arange(len(CASES.test)) - CASES.first[CASES.test]
    np.testing.assert_array_equal(after.lost, steps >= 5)


@pytest.mark.parametrize(
    ("effect", "value", "marks"),
    [
        ("material_yield", 0.0199, False),
        ("material_yield", 2e-3, True),
        ("material_yield", 1.3e-3, True),
        ("joint_friction", 20.0, True),
        ("joint_friction", 200.0, True),
    ],
)
def test_all_steps_at_once_are_step_after_step(effect: str, value: float, marks: bool) -> None:
    """From rest, and from the states of another size: as by going through all tests step by step, up and down."""
    cases = load_cases(bench(ids=("lateral_q+0", "swing_q+0")))
    term = catalogue()[effect]
    model = Model().with_effects([term])
    here, other = (probed(model, term, v) for v in (value, 1.1 * value))
    fresh = predict(here, cases, slopes=False)
    moved = predict(here, cases, slopes=False, start=predict(other, cases, slopes=False))
    mechanism = here.mechanism(cases.groups[0].rig, cases.campaign.gauges)
    path = _step_by_step(mechanism, cases.groups[0])
    size = np.max(np.abs(path.unknowns), axis=(0, 1)) + 1e-9
    # Plastic strains are known to some 1e-11; slips and the work that they took by their own size.
    kept = 1e-4 if effect == "material_yield" else np.max(np.abs(path.next_memory), axis=(0, 1)) + 1e-6
    for (state,) in (fresh.states, moved.states):
        assert state.converged.all() and path.converged.all()
        for ours, theirs, scale in (
            (state.unknowns, path.unknowns, size),
            (state.next_memory, path.next_memory, kept),
        ):
            np.testing.assert_allclose(ours / scale, np.moveaxis(theirs, 0, 1) / scale, atol=1e-7)
        marked = np.any(state.next_memory != 0.0, axis=-1)
        assert marked.any() == marks
        assert effect == "joint_friction" or not marked[:, 0].any()


def _step_by_step(mechanism: Rig, group: Group) -> Equilibrium:
    drives = {"q": group.q} if "q" in layout(mechanism).drives else {}
    steps = np.moveaxis(group.targets, 1, 0)
    return load_path(mechanism, steps, np.broadcast_to(group.channels, steps.shape), drives=drives)


def test_after_a_step_that_is_not_reached_the_others_stay_as_they_were(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One state led nowhere: that step is solved from the one before it, and none after it."""
    cases = SWING
    fresh = predict(MODEL, cases, slopes=False)
    (state,) = fresh.states
    moved = state.unknowns.copy()
    moved[0, 3] *= 1e3
    asked: list[int] = []
    step_by_step = history._next

    def counted(*given: Any) -> Equilibrium:
        asked.append(given[4])
        return step_by_step(*given)

    monkeypatch.setattr(history, "_next", counted)
    begin = replace(fresh, states=(replace(state, unknowns=moved),))
    again = predict(MODEL, cases, slopes=False, start=begin)
    assert asked == [3]
    assert not again.lost.any()
    np.testing.assert_allclose(again.values, fresh.values, rtol=1e-6, atol=1e-6)


def test_after_a_step_that_is_not_reached_the_others_remember_what_it_left() -> None:
    """One state of another friction led nowhere: those after it had that friction's memory."""
    cases = SWING
    fresh = predict(MODEL, cases, slopes=False)
    other = MODEL.at(0.5 * MODEL.values)
    (state,) = predict(other, cases, slopes=False).states
    moved = state.unknowns.copy()
    moved[0, 3] *= 1e3
    begin = replace(fresh, states=(replace(state, unknowns=moved),))
    again = predict(MODEL, cases, slopes=False, start=begin)
    np.testing.assert_allclose(again.values, fresh.values, rtol=1e-6, atol=1e-6)
    memory = fresh.states[0].next_memory
    size = np.max(np.abs(memory), axis=(0, 1)) + 1e-9
    assert np.any(np.abs(begin.states[0].memory - fresh.states[0].memory)[0, 4:] > 1e-3 * size)
    np.testing.assert_allclose(again.states[0].next_memory / size, memory / size, atol=1e-6)


def test_a_start_that_leads_nowhere_is_left() -> None:
    """States a thousand times as far away: from there no step is reached, from the step before every one."""
    cases = CASES.only(np.flatnonzero(CASES.test == 0)[:4])
    fresh = predict(MODEL, cases, slopes=False)
    far = tuple(replace(state, unknowns=1e3 * state.unknowns) for state in fresh.states)
    again = predict(MODEL, cases, slopes=False, start=replace(fresh, states=far))
    assert not again.lost.any()
    # Newton's method from elsewhere; the sensors' finest step is a thousand times this.
    np.testing.assert_allclose(again.values, fresh.values, rtol=1e-6, atol=1e-6)


def test_what_remembers_nothing_may_follow_what_does() -> None:
    """A play alone, begun where friction and play stood, in the loads that the friction took."""
    play = catalogue()["joint_clearance"]
    both = MODEL.with_effects([play])
    values = dict(zip((f.name for f in both.free), both.values, strict=True)) | {
        "joint_clearance.play_mm": 1e-2
    }
    both = both.at(np.array([values[f.name] for f in both.free]))
    start = predict(both, SWING, slopes=False)
    alone = both.without("joint_friction")
    found, expected = (predict(alone, SWING, start=it) for it in (start, None))
    assert not found.lost.any() and start.states[0].memory.size
    np.testing.assert_allclose(found.values, expected.values, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(
        found.by_free, expected.by_free, rtol=1e-6, atol=1e-6 * np.abs(expected.by_free).max()
    )


@pytest.mark.parametrize("name", ["contact_stiffening", "joint_clearance"])
def test_slides_beside_friction_begin_where_the_linkage_without_them_stands(name: str) -> None:
    """From rest the way of friction with a contact is gone in increments, of dozens of iterations."""
    first = predict(MODEL, CASES, slopes=False)
    more = MODEL.with_effects([catalogue()[name]])
    found, cold = (predict(more, CASES, slopes=False, start=start) for start in (first, None))
    assert not found.lost.any()
    np.testing.assert_allclose(found.values, cold.values, rtol=1e-9, atol=1e-6)
    iterations = [max(int(state.iterations.max()) for state in it.states) for it in (found, cold)]
    assert iterations[0] <= min(6, iterations[1])
