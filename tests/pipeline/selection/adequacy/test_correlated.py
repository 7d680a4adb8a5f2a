"""Noise that is correlated from row to row is found by its likelihood, and explains what it made and nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answer_of, answered
from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.campaign import Campaign
from pipeline.inference.fit import fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model, Term
from pipeline.selection.adequacy.correlated import _residual, correlated
from pipeline.selection.adequacy.judgement import ORDER, judge
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import diagnose
from pipeline.simulate import bench_rig
from tests.pipeline.selection.bench import MIXED
from vjm.effects import catalogue

ALWAYS, FZ, MX = "bar_geometric_nonlinearity", 8, 9
NEARLY_EXACT = replace(
    SENSORS,
    displacement=1e-6 * SENSORS.displacement,
    wrench=1e-6 * SENSORS.wrench,
    gauges=1e-6 * SENSORS.gauges,
)


def read(channels: tuple[int, ...], r: float, hidden: dict[str, float], seed: int = 3) -> Campaign:
    """Readings of the usual sensors, the noise of some of them an autoregression of first order from row to row."""
    plan = [test for test in bench_plan(24) if test.id in MIXED]
    exact = measure("correlated", bench_rig(), plan, NEARLY_EXACT, hidden, seed, GAUGES)
    noise = measure("white", bench_rig(), plan[:1], SENSORS, {}, seed, GAUGES).noise
    sigma, generator = (
        np.concatenate([noise.displacement, noise.wrench, noise.gauges]),
        np.random.default_rng(seed),
    )
    tests = []
    for test in exact.tests:
        data, errors = test.data, generator.normal(size=(len(test.data.steps), sigma.size))
        for row in range(1, len(errors)):
            for k in channels:
                errors[row, k] = r * errors[row - 1, k] + np.sqrt(1.0 - r**2) * errors[row, k]
        errors *= sigma
        data = replace(
            data,
            displacement=data.displacement + errors[:, :6],
            wrench=data.wrench + errors[:, 6:12],
            gauges=data.gauges + errors[:, 12:],
        )
        tests.append(replace(test, data=data))
    return replace(exact, tests=tuple(tests), noise=noise)


def model(*names: str) -> Model:
    return Model(tuple(Term(catalogue()[name], {}) for name in (ALWAYS, *names)))


def test_the_covariance_is_that_of_an_autoregression() -> None:
    """Its inverse is tridiagonal: 1 + r² inside, 1 at the ends, -r beside, over 1 - r²."""
    found = fit(model(), load_cases(read((), 0.0, {})))
    it = _residual(found)
    one = it.tests[0]
    r, k, count = 0.6, int(np.flatnonzero(it.sensors == FZ)[0]), one.errors.shape[2]
    root = one.root(np.where(np.arange(len(it.sensors)) == k, r, 0.0))
    # fz is predicted in this test and read apart from all else: the errors of a row are one residual.
    rows = one.errors[k].argmax(axis=0)
    covariance = (root @ root.T)[np.ix_(rows, rows)]
    inverse = (1.0 + r**2) * np.eye(count) - r * (np.eye(count, k=1) + np.eye(count, k=-1))
    inverse[0, 0] = inverse[-1, -1] = 1.0
    size = one.errors[k].max(axis=0)
    expected = np.linalg.inv(inverse) * (1.0 - r**2)
    expected = np.outer(size, size) * expected + np.diag(1.0 - size**2)
    assert covariance == pytest.approx(expected, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("r", [0.4, 0.7])
def test_the_sensor_and_its_correlation_are_found(r: float) -> None:
    (each,) = correlated(fit(model(), load_cases(read((FZ,), r, {}))), CRITERIA)
    assert each.channel == FZ and each.error < 0.1
    assert abs(each.correlation - r) < 2.5 * each.error


def test_white_noise_has_none() -> None:
    found = [correlated(fit(model(), load_cases(read((), 0.0, {}, seed))), CRITERIA) for seed in range(3)]
    assert not any(found)


def test_a_missing_effect_is_no_correlation() -> None:
    found = fit(model(), load_cases(read((), 0.0, {"joint_friction.torque_Nmm": 100.0})))
    assert not next(check for check in judge(found).checks if check.name == ORDER).passed
    assert not correlated(found, CRITERIA)


def test_it_is_told_beside_a_verdict_that_stands() -> None:
    known = {
        name: catalogue()[name] for name in (ALWAYS, "modulus_error", "self_weight", "load_misalignment")
    }
    it = diagnose(read((FZ,), 0.7, {}), Model(), known)
    assert it.sets == ((ALWAYS,),) and it.verdict == "identified"
    (noise,) = answer_of(it).noise
    assert noise.column == "fz_N" and noise.correlation == pytest.approx(0.7, abs=0.1)
    assert any("fz_N (0.7" in each and "times as wide" in each for each in answered(it).sentences)


def test_the_sigma_beside_it_is_that_of_the_file_and_what_was_found() -> None:
    it = replace(read((FZ,), 0.4, {}), tolerance={"length_mm": 0.05})
    half = replace(it, noise=replace(it.noise, wrench=0.5 * it.noise.wrench))
    known = {name: catalogue()[name] for name in (ALWAYS, "modulus_error")}
    rows = [each for each in answer_of(diagnose(half, Model(), known)).noise if each.column == "fz_N"]
    assert [each.correlation is not None for each in rows] == [False, True]
    assert {each.declared for each in rows} == {float(half.noise.wrench[2])}
    assert all(1.5 < each.found / each.declared < 2.5 for each in rows)


@pytest.mark.long
def test_it_is_one_explanation_where_nothing_known_explains_the_rest() -> None:
    """Helpers that order along the load paths let in are not beside it."""
    it = diagnose(read(tuple(range(6, 12)), 0.7, {"modulus_error.scale": 0.93}), Model(), catalogue())
    assert it.verdict == "unknown" and it.alike_rows.beside == {ALWAYS, "modulus_error"}
    assert {each.channel for each in it.alike_rows.sensors} >= {FZ, MX}
    said = next(each for each in answered(it).sentences if "correlated from row to row" in each)
    assert f"beside {ALWAYS} + modulus_error it explains all" in said
