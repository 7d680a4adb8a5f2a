"""The dirty programme: what its benches have besides the physics, and how an answer to one is judged."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline.assessment.challenge.benches import Bench, drawn_rig
from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.challenge.command import run_dirty
from pipeline.assessment.challenge.dirty.cases import ROUND, DirtyCase, dirty_case
from pipeline.assessment.challenge.dirty.dirt import Dirt, read_dirty, true_rig
from pipeline.assessment.challenge.dirty.judged import judged
from pipeline.assessment.challenge.dirty.outcome import DirtyOutcome
from pipeline.assessment.challenge.dirty.page import dirty_page
from pipeline.assessment.challenge.dirty.score import dirty_scored
from pipeline.assessment.challenge.dirty.shown import shown
from pipeline.assessment.challenge.dirty.sizes import after, sizes_after_tolerances
from pipeline.assessment.virtual.bench import true_readings
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.provenance import code_digest
from pipeline.selection.adequacy.bad_readings import bad_readings
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import cached_fits
from pipeline.simulate import bench_rig
from vjm.effects import catalogue

CHANNELS = 12 + len(GAUGES)
CLEAN = Dirt(
    np.ones(4), np.ones(CHANNELS), np.zeros(CHANNELS), 0.0, np.ones(CHANNELS), None, np.zeros(CHANNELS)
)
PLAN = tuple(test for test in bench_plan(40) if test.id in ("axial_held_q+0", "lateral_q+0"))
BENCH = Bench(bench_rig(), SENSORS, PLAN, "two")
EXACT = true_readings(BENCH.rig, BENCH.plan, {}, GAUGES)


def errors(dirt: Dirt, seed: int = 5) -> np.ndarray:
    """(R, C) of the readings that are written, in sigmas of clean sensors."""
    campaign, _ = read_dirty("it", BENCH, dirt, EXACT, seed)
    read = np.vstack([np.hstack([t.data.displacement, t.data.wrench, t.data.gauges]) for t in campaign.tests])
    return (read - exact()) / np.concatenate([SENSORS.displacement, SENSORS.wrench, SENSORS.gauges])


def exact() -> np.ndarray:
    return np.vstack([np.hstack([it.displacement, it.wrench, it.gauges]) for it in EXACT])


def channels(value: float, *which: int, rest: float = 0.0) -> np.ndarray:
    out = np.full(CHANNELS, rest)
    out[list(which)] = value
    return out


def test_a_number_is_always_the_same_case_and_kinds_come_in_turn() -> None:
    one, two = dirty_case(6), dirty_case(6)
    assert dict(one.hidden) == dict(two.hidden) and one.seed == two.seed
    np.testing.assert_array_equal(one.dirt.gains, two.dirt.gains)
    every = [dirty_case(n) for n in range(200)]
    assert [it.kind for it in every[:20]] == list(ROUND)
    assert {len(it.effects) for it in every if it.kind == "triple"} == {3}
    assert {next(iter(it.effects)).partition("@")[0] for it in every if it.kind == "sensor"} == {
        f"sensor_{kind}" for kind in ("gain", "drift", "settling", "cross_talk", "lag", "backlash")
    }
    # Nobody's bar is as drawn, and none is farther off than 3 %.
    off = np.array([it.dirt.bar - 1.0 for it in every])
    assert np.all(np.any(off != 0.0, axis=1)) and np.abs(off).max() < 0.0301
    shares = [np.mean([getattr(it.dirt, key) > 0.0 for it in every]) for key in ("bad",)]
    assert 0.35 < shares[0] < 0.65


def test_without_dirt_the_noise_is_white_and_of_its_sigma() -> None:
    found = errors(CLEAN)
    assert np.std(found) == pytest.approx(1.0, abs=0.04)
    assert np.abs(found).max() < 5.0
    assert abs(np.mean(found[1:] * found[:-1])) < 0.1


def test_each_dirt_is_what_it_says() -> None:
    there = exact()
    gain = errors(replace(CLEAN, gains=channels(1.02, 6, rest=1.0))) - errors(CLEAN)
    # Less what displays round.
    np.testing.assert_allclose(gain[:, 6], 0.02 * there[:, 6] / SENSORS.wrench[0], atol=0.2)
    assert np.abs(np.delete(gain, 6, axis=1)).max() < 0.2
    share = errors(replace(CLEAN, shares=channels(0.01, 6)))[:, 6]
    large = np.abs(there[:, 6]) > 1000.0
    assert np.std(share[large] / (0.01 * np.abs(there[large, 6]))) == pytest.approx(1.0, abs=0.25)
    assert np.std(errors(replace(CLEAN, rounded=channels(4.0, 0)))[:, 0]) > 1.2
    kept = np.concatenate([errors(replace(CLEAN, correlated=(6, 0.7)), seed)[:, 6] for seed in range(8)])
    assert np.corrcoef(kept[1:], kept[:-1])[0, 1] == pytest.approx(0.7, abs=0.12)


def test_knocked_readings_are_those_that_are_told() -> None:
    dirt = replace(CLEAN, bad=0.5)
    _, knocks = read_dirty("it", BENCH, dirt, EXACT, 5)
    first = np.cumsum([0, *(len(it.wrench) for it in EXACT)])
    places = {(int(first[k.test]) + k.row, k.channel) for k in knocks}
    far = np.abs(errors(dirt)) > 10.0
    assert places == set(zip(*(axis.tolist() for axis in np.nonzero(far)), strict=True)) and len(places) > 20


@pytest.mark.parametrize("seeds", [range(6), pytest.param(range(6, 46), marks=pytest.mark.long)])
def test_a_knocked_reading_shows_where_the_true_model_would_see_it(seeds: range) -> None:
    """With nothing else in the table: of those that show nine of ten are found, of the others fewer than a third."""
    counts = {True: [0, 0], False: [0, 0]}
    for seed in seeds:
        campaign, knocks = read_dirty("it", BENCH, replace(CLEAN, bad=0.02), EXACT, seed)
        found = unfitted(Model().with_effects([catalogue()[ALWAYS]]), load_cases(campaign))
        columns = found.residual.load_cases.rows.columns
        tests = {test.id: k for k, test in enumerate(campaign.tests)}
        aside = {
            (tests[it.test], int(it.step), columns.index(name))
            for it in bad_readings(found, CRITERIA)
            for name in (it.column, *it.instead)
        }
        fitted = [k for k in knocks if campaign.tests[k.test].role == "fit"]
        clear = shown(campaign, fitted)
        for knock in fitted:
            counts[knock in clear][0] += (knock.test, knock.row, knock.channel) in aside
            counts[knock in clear][1] += 1
    (seen, of), (hidden, rest) = counts[True], counts[False]
    assert of >= len(seeds) // 2 and seen / of >= 0.9
    assert rest > len(seeds) // 6 and hidden / rest < 1 / 3


def test_what_is_declared_is_the_drawing_and_the_certificates() -> None:
    gains, declared = channels(1.004, 6, rest=1.0), channels(2.0, 6, 7, rest=1.0)
    dirt = replace(CLEAN, gains=gains, shares=channels(0.002, 7), declared=declared)
    campaign, _ = read_dirty("it", BENCH, dirt, EXACT, 1)
    assert campaign.rig is BENCH.rig and campaign.tolerance["EA"] == 0.02
    assert (
        campaign.noise.sigmas[6] == 2.0 * SENSORS.wrench[0] and campaign.noise.sigmas[8] == SENSORS.wrench[2]
    )
    assert campaign.noise.gains[6] == 0.005 and not campaign.noise.gains[7]
    assert campaign.noise.shares[7] == 0.004


@pytest.mark.parametrize("seed", [0, 3])
def test_the_true_bar_has_other_stiffnesses(seed: int) -> None:
    """Against the compliances of a beam in closed form: EA, EI_y, EI_z, GJ each by itself."""
    rig, bar = drawn_rig(np.random.default_rng(seed)), np.array([1.03, 0.98, 1.02, 0.97])
    ratio = true_rig(rig, bar).stiffness / np.where(rig.stiffness == 0.0, np.inf, rig.stiffness)
    blocks = {(0, 0): 1.03, (1, 1): 1.02, (1, 5): 1.02, (5, 5): 1.02, (3, 3): 0.97}
    blocks |= {(2, 2): 0.98, (2, 4): 0.98, (4, 4): 0.98}
    for (row, column), expected in blocks.items():
        assert ratio[row, column] == pytest.approx(expected, rel=1e-9)


def test_sizes_after_tolerances_are_those_of_the_covariance() -> None:
    generator = np.random.default_rng(8)
    given, values = generator.normal(size=(30, 4)), generator.normal(size=30)
    expected = values @ np.linalg.solve(np.eye(30) + given @ given.T, values)
    assert np.sum(after(given, values) ** 2) == pytest.approx(expected, rel=1e-12)
    both = np.column_stack([values, given[:, 0]])
    np.testing.assert_allclose(after(given, both)[:, 0], after(given, values), rtol=1e-12)


def test_a_size_after_tolerances_is_no_more_than_the_number_in_its_own() -> None:
    """What all bars are off by cannot show by more than its tolerance allows, however good the sensors are."""
    off = 0.03
    case = DirtyCase(0, "single", BENCH, {"modulus_error.scale": 1.0 + off}, None, 3, CLEAN)
    found = true_readings(BENCH.rig, BENCH.plan, case.hidden, GAUGES)
    campaign, _ = read_dirty("it", BENCH, CLEAN, found, 3)
    exact = replace(campaign, tolerance=dict.fromkeys(campaign.tolerance, 0.0))
    sizes = []
    for each in (campaign, exact):
        cache = cached_fits(each, Model(), {name: catalogue()[name] for name in (ALWAYS, "modulus_error")})
        size, _ = sizes_after_tolerances(case, found, EXACT, cache)
        sizes.append(size["modulus_error"])
    # A modulus moves four numbers, each with its tolerance.
    bar = campaign.tolerance["EA"]
    assert 0.2 * off / bar < sizes[0] < 1.01 * off / bar * 2.0
    assert sizes[1] > 20.0 * sizes[0]


def a_case(kind: str, *hidden: str, fault: str = "") -> DirtyCase:
    values = {f"{name}.scale": 1.0 for name in hidden}
    return DirtyCase(0, kind, BENCH, values, (fault, 1.0) if fault else None, 0, CLEAN)


@pytest.mark.parametrize(
    ("case", "verdict", "sets", "certain", "score"),
    [
        (a_case("single", "a"), "identified", [["a"]], [], "right"),
        (a_case("single", "a"), "identified", [["b"]], [], "wrong"),
        (a_case("single", "a"), "ambiguous", [["b"], ["a"]], [], "in set"),
        (a_case("single", "a"), "unknown", [["b"]], [], "undecided"),
        (a_case("single", "a"), "unknown", [["b"]], ["a"], "certain"),
        (a_case("single", "a"), "identified", [["a"]], ["b"], "wrong"),
        (a_case("pair", "a", "b"), "identified", [["a"]], [], "part"),
        (a_case("pair", "a", "b"), "identified", [["a"]], ["a"], "certain"),
        (a_case("single", "a"), "within_noise", [[]], [], "missed"),
        (a_case("clean"), "within_noise", [[]], [], "right"),
        (a_case("clean"), "identified", [["a"]], [], "false alarm"),
        (a_case("clean"), "unknown", [["a"]], [], "undecided"),
        (a_case("clean"), "unknown", [["a"]], ["a"], "false alarm"),
        (a_case("outside", fault="creeping_gauge"), "unknown", [["a"]], [], "right"),
        (a_case("outside", fault="creeping_gauge"), "identified", [["sensor_settling@mid_mm"]], [], "right"),
        (a_case("outside", fault="creeping_gauge"), "identified", [["sensor_settling@fx_N"]], [], "wrong"),
        (a_case("outside", fault="sticking_hinge"), "identified", [["sensor_lag@fx_N"]], [], "wrong"),
        (a_case("sensor", "sensor_gain@fy_N"), "identified", [["sensor_gain@fy_N"]], [], "right"),
    ],
)
def test_an_answer_is_judged_with_what_is_certain(
    case: DirtyCase, verdict: str, sets: list[list[str]], certain: list[str], score: str
) -> None:
    assert judged(case, verdict, sets, certain, doctor=False) == score
    assert judged(case, verdict, sets, certain, doctor=True) == "doctor"


def made(number: int, **more: object) -> DirtyOutcome:
    plain = {"kind": "single", "plan": "rich", "hidden": {"a.scale": 1.0}, "fault": None, "dirt": {}}
    known = {
        "seconds": 3.0,
        "commit": "abc",
        "code": code_digest(),
        "sizes": {"a": 20.0},
        "gamma": {"a": 1.0},
    }
    return DirtyOutcome.model_validate({"number": number, **plain, **known, **more})


def test_a_score_counts_what_it_says() -> None:
    counts = {
        "knocked": 4,
        "knocked_found": 3,
        "shown": 3,
        "shown_found": 2,
        "readings": 1000,
        "good_aside": 1,
    }
    every = [
        made(0, score="right", inside={"a.scale": True}, certain=("a",)),
        made(1, score="wrong", certain=("b",)),
        made(2, kind="clean", hidden={}, sizes={}, gamma={}, score="right", **counts),
        made(3, score="undecided", declared_found=False),
    ]  # fmt: skip
    goals = {goal.name: (goal.share.count, goal.share.of) for goal in dirty_scored(every).goals}
    assert goals["right, in a set or certain, large effects"] == (1, 3)
    assert goals["a name that is not there, of all cases"] == (1, 4)
    assert goals["certain and not there"] == (1, 2)
    assert goals["bad readings found, of all"] == (3, 4) and goals[
        "bad readings found, of those that show"
    ] == (2, 3)
    assert goals["good readings set aside"] == (1, 1000)
    assert goals["declared sigmas off by two recognised"] == (0, 1)
    assert goals["certain, of true effects from 10 sigmas"] == (1, 3)
    text = dirty_page(dirty_scored(every), None)
    assert "| a name that is not there, of all cases | at most 1 % | 25.0 % (0.6 .. 80.6) of 4 |" in text
    assert "case 1." in text


def test_a_stored_run_is_scored_again(tmp_path: Path) -> None:
    store = tmp_path / "dirty_outcomes.jsonl"
    store.write_text(made(0, score="right").model_dump_json() + "\n")
    found = run_dirty(1, 1, tmp_path, store, quiet=True)
    assert found.cases == 1 and (tmp_path / "dirty.md").read_text().startswith(
        "# The diagnosis on benches as they are"
    )
    assert (tmp_path / "dirty.json").is_file()
