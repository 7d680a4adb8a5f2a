"""The cases: the same on any machine, of all kinds, and what they hide is what they say."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.assessment.challenge.benches import drawn_rig
from pipeline.assessment.challenge.cases import ALWAYS, HIDDEN, ROUND, Case, case
from pipeline.assessment.challenge.faults import FAULTS
from pipeline.assessment.challenge.outcome import campaign_of, judged, measured
from pipeline.assessment.virtual.bench import true_readings
from pipeline.assessment.virtual.plan import GAUGES, bench_plan
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import cached_fits
from pipeline.simulate import bench_rig, scaled
from vjm.effects import catalogue, for_kind


def test_a_number_is_always_the_same_case() -> None:
    one, two = case(9), case(9)
    assert dict(one.hidden) == dict(two.hidden) and one.seed == two.seed
    for a, b in zip(one.bench.plan, two.bench.plan, strict=True):
        np.testing.assert_array_equal(a.values, b.values)


def test_of_six_hundred_a_quarter_is_clean_and_all_kinds_are_there() -> None:
    every = [case(n) for n in range(600)]
    kinds = [it.kind for it in every]
    assert kinds.count("clean") >= 150
    assert set(kinds) == set(ROUND)
    hidden = {name for it in every if it.kind in ("single", "pair") for name in it.effects}
    assert hidden == set(HIDDEN)
    # All that may be missing of a parallelogram but what only exceeds a tolerance.
    may = {name for name, it in for_kind("parallelogram").items() if not it.nominal}
    assert hidden == may - {ALWAYS}
    assert {it.fault[0] for it in every if it.fault} == set(FAULTS)
    lengths = {it.bench.rig.length for it in every}
    assert len(lengths) > 100 and max(lengths) > 2.0 * min(lengths)
    for it in every:
        low = [p.low for n in it.effects for p in catalogue()[n].parameters]
        high = [p.high for n in it.effects for p in catalogue()[n].parameters]
        values = [it.hidden[f"{n}.{p.name}"] for n in it.effects for p in catalogue()[n].parameters]
        assert np.all(np.array(values) >= low) and np.all(np.array(values) <= high), it.number


def test_loads_grow_with_the_rig() -> None:
    rig = drawn_rig(np.random.default_rng(4))
    plan = bench_plan(6)
    ratio = rig.stiffness[1, 1] * rig.length / (bench_rig().stiffness[1, 1] * bench_rig().length)
    axial, lateral = (next(k for k, t in enumerate(plan) if t.id.startswith(n)) for n in ("axial", "lateral"))
    grown = scaled(plan, rig, 0.5)
    np.testing.assert_allclose(grown[axial].values, 0.5 * ratio * plan[axial].values)
    np.testing.assert_allclose(
        grown[lateral].values, 0.5 * rig.length / bench_rig().length * plan[lateral].values
    )


@pytest.mark.parametrize("name", sorted(FAULTS))
def test_a_fault_grows_with_its_size_and_is_nothing_at_none(name: str) -> None:
    # A plan with all angles: a hinge that sticks at one of them shows at no other.
    every = (c for c in (case(n) for n in range(3, 600, 4)) if c.fault and len(c.bench.plan) > 10)
    it = next(c for c in every if c.fault is not None and c.fault[0] == name)
    found = true_readings(it.bench.rig, it.bench.plan, {}, GAUGES)

    def change(size: float) -> float:
        there = FAULTS[name](it.bench, found, size)
        both = [(a.wrench - b.wrench, a.displacement - b.displacement, a.gauges - b.gauges)
                for a, b in zip(there, found, strict=True)]  # fmt: skip
        return sum(float(np.abs(d).sum()) for three in both for d in three)

    assert change(0.0) == pytest.approx(0.0, abs=1e-6)
    assert 0.0 < change(0.5) < change(1.0)


@pytest.mark.parametrize(
    ("effects", "fault", "verdict", "sets", "score"),
    [
        ((), None, "identified", [()], "right"),
        ((), None, "within_noise", [()], "right"),
        ((), None, "identified", [("modulus_error",)], "false alarm"),
        ((), None, "unknown", [()], "undecided"),
        (("modulus_error",), None, "identified", [("modulus_error",)], "right"),
        (("modulus_error",), None, "identified", [()], "missed"),
        (("modulus_error",), None, "identified", [("load_offset",)], "wrong"),
        (("modulus_error",), None, "identified", [("modulus_error", "load_offset")], "wrong"),
        (("modulus_error",), None, "ambiguous", [("load_offset",), ("modulus_error",)], "in set"),
        (("modulus_error",), None, "ambiguous", [("load_offset",), ("self_weight",)], "wrong"),
        (("modulus_error", "load_offset"), None, "identified", [("load_offset",)], "part"),
        (("modulus_error",), None, "unknown", [("modulus_error",)], "undecided"),
        ((), ("cross_talk", 1.0), "unknown", [("load_offset",)], "right"),
        ((), ("cross_talk", 1.0), "identified", [("load_offset",)], "wrong"),
        ((), ("cross_talk", 1.0), "identified", [()], "missed"),
        ((), ("cross_talk", 1.0), "ambiguous", [("load_offset",), ("modulus_error",)], "undecided"),
    ],
)
def test_answers_are_judged(
    effects: tuple[str, ...],
    fault: tuple[str, float] | None,
    verdict: str,
    sets: list[tuple[str, ...]],
    score: str,
) -> None:
    kind = "outside" if fault else "pair" if len(effects) == 2 else "single" if effects else "clean"
    hidden = {f"{name}.{catalogue()[name].parameters[0].name}": 1.0 for name in effects}
    assert judged(Case(0, kind, case(0).bench, hidden, fault, 0), verdict, sets) == score


@pytest.mark.parametrize("number", [1, 2])
def test_what_effects_do_stands_in_the_rows_of_the_diagnosis(number: int) -> None:
    """Columns of candidates and those of what is hidden are compared row by row."""
    it, found, _ = measured(number)
    whole = cached_fits(campaign_of(it, found, it.seed), Model(), catalogue()).whole
    exact = load_cases(campaign_of(it, found, None))
    assert [test.id for test in whole.campaign.tests] == [test.id for test in exact.campaign.tests]
    assert [test.id for test in whole.campaign.tests] != [test.id for test in it.bench.plan]
    far = np.abs(whole.measured - exact.measured) > 8.0 * whole.spread
    assert not np.any(far & whole.predicted)
