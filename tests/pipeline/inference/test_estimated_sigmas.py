"""Sigmas that a campaign does not say, against those that it was simulated with."""

from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.virtual.plan import SENSORS
from pipeline.campaign import Campaign, Data, Noise, ParallelogramRig, Test
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.load_cases import load_cases
from pipeline.inference.sensor_noise import from_lines, from_parabolas
from tests.pipeline.bench import bench
from vjm import paper

RIG = ParallelogramRig(length=310.0, width=80.0, bar_stiffness=paper.BAR_STIFFNESS)
CONTROL = ("force", "displacement", "displacement", "displacement", "displacement", "displacement")
UNKNOWN = Noise(np.full(6, np.nan), np.full(6, np.nan), np.full(1, np.nan))


def one_test(fx: np.ndarray, **columns: np.ndarray) -> Campaign:
    """Loads along x, everything else held and, but for `columns` by number, not read."""
    displacement, wrench = np.zeros((fx.size, 6)), np.full((fx.size, 6), np.nan)
    wrench[:, 0] = fx
    for name, values in columns.items():
        (displacement if int(name[1:]) < 6 else wrench)[:, int(name[1:]) % 6] = values
    steps = np.arange(fx.size)
    data = Data(steps, displacement, wrench, np.zeros((fx.size, 0)), None, np.zeros_like(steps))
    noise = Noise(np.full(6, np.nan), np.full(6, np.nan), np.zeros(0))
    return Campaign("one", RIG, noise, (), (Test("t", 0.0, "fit", CONTROL, "nominal", RIG, data),))


def test_all_sigmas_of_a_bench_are_found() -> None:
    """Friction and bent curves and all. 72 readings give 12 % each; shape adds, so the upper bound is wider."""
    found = completed(replace(bench("joint_friction.torque_Nmm", 300.0), noise=UNKNOWN))
    ratio = np.concatenate([found.noise.displacement, found.noise.wrench, found.noise.gauges])
    ratio /= np.concatenate([SENSORS.displacement, SENSORS.wrench, SENSORS.gauges])
    assert np.all(ratio > 0.5) and np.all(ratio < 1.8), ratio
    assert 0.5 < found.noise.temperature / SENSORS.temperature < 1.8
    assert sum("from the roughness" in r or "from the scatter about" in r for r in found.remarks) == 14
    assert np.isfinite(load_cases(found).sigma).all()


def test_what_is_known_stays() -> None:
    campaign = bench()
    known = replace(UNKNOWN, displacement=np.array([7.0, *UNKNOWN.displacement[1:]]))
    assert completed(replace(campaign, noise=known)).noise.displacement[0] == 7.0
    whole = completed(campaign)
    assert np.array_equal(whole.noise.wrench, campaign.noise.wrench) and whole.remarks == campaign.remarks


def test_steps_done_twice_are_preferred() -> None:
    """A rough curve, which differences would take for noise; 60 repeats give sigma to 9 %."""
    rng = np.random.default_rng(4)
    fx = np.repeat(rng.normal(scale=1000.0, size=60), 2)
    x = np.sin(fx) + rng.normal(scale=1e-3, size=fx.size)
    found = completed(one_test(fx, c0=x))
    assert found.noise.displacement[0] == pytest.approx(1e-3, rel=0.4)
    assert any(r.startswith("x_mm") and "from 60 repeated steps" in r for r in found.remarks)


def test_rounded_readings_have_the_noise_of_rounding() -> None:
    """Uniform over one step of the display: the step over the root of twelve."""
    fx = np.linspace(0.0, 1000.0, 40)
    x = np.where(np.arange(40) < 20, 0.02, 0.03)
    assert completed(one_test(fx, c0=x)).noise.displacement[0] == pytest.approx(0.01 / np.sqrt(12.0))


def test_what_never_moves_is_exact_only_where_it_is_prescribed() -> None:
    fx = np.linspace(0.0, 1000.0, 40)
    found = completed(one_test(fx, c0=1e-5 * fx**3 + np.random.default_rng(0).normal(size=40)))
    assert found.noise.displacement[1] == 0.0
    still = completed(one_test(fx, c0=np.zeros(40)))
    assert np.isnan(still.noise.displacement[0])
    assert "x_mm: no sigma is given and none can be told" in " ".join(still.remarks)


def test_of_few_steps_no_sigma_is_guessed_and_the_line_to_write_is_said() -> None:
    few = completed(one_test(np.array([0.0, 1.0, 2.5]), c0=np.array([0.0, 0.1, 0.3])))
    assert np.isnan(few.noise.displacement[0])
    said = " ".join(few.remarks)
    assert "0 differences, allowed are 6 or more; write under [noise] in campaign.toml: x_mm = ..." in said
    # What is only prescribed needs none.
    assert few.noise.wrench[0] == 0.0 and "fy_N" not in said


def test_steps_that_were_chosen_are_exact_and_noise_of_a_display_is_not() -> None:
    rng = np.random.default_rng(3)
    z = 1e-3 * np.arange(9) + rng.normal(0.0, 1e-4, 9)
    assert completed(one_test(100.0 * np.arange(9), c0=z)).noise.wrench[0] == 0.0
    read = np.round(100.0 * np.arange(40) + rng.normal(0.0, 2.0, 40), 1)
    found = completed(one_test(read, c0=1e-3 * np.arange(40) + rng.normal(0.0, 1e-6, 40)))
    assert 1.0 < found.noise.wrench[0] < 4.0


def test_scatter_about_lines_is_unbiased() -> None:
    rng = np.random.default_rng(5)
    load = np.linspace(0.0, 1.0, 6)
    values = [from_lines([(load, 2.0 + 3.0 * load + rng.normal(size=6))]).value for _ in range(2000)]
    # 4 degrees of freedom: a standard deviation of 0.36, over the root of 2000.
    assert abs(float(np.mean(np.array(values, dtype=float))) - 1.0) < 4.0 * 0.36 / np.sqrt(2000.0)
    assert from_lines([(load[:4], load[:4])]).value is None


def test_scatter_about_parabolas_is_unbiased_and_blind_to_one() -> None:
    rng = np.random.default_rng(5)
    load = 1e6 + np.array([0.0, 1.0, 2.5, 3.0, 4.0, 5.5, 6.0])
    noise = rng.normal(size=(2000, 7))
    bent = 2.0 + 3.0 * (load - 1e6) - 5.0 * (load - 1e6) ** 2
    values = [from_parabolas([(load, bent + each)]).value for each in noise]
    assert abs(float(np.mean(np.array(values, dtype=float))) - 1.0) < 4.0 * 0.36 / np.sqrt(2000.0)
    alone = [from_parabolas([(load, each)]).value for each in noise[:20]]
    np.testing.assert_allclose(values[:20], alone, rtol=1e-6)
    assert from_parabolas([(load[:6], load[:6])]).value is None
