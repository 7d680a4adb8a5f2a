"""How a model fails, on failures that were planted: the right number, in the right words, and none on noise."""

from dataclasses import replace

import numpy as np
import pytest

from pipeline.campaign.names import DISPLACEMENTS, WRENCHES
from pipeline.compare.error import Discrepancy
from pipeline.compare.failure import findings, groups
from pipeline.compare.misfit import Series, misfit
from pipeline.compare.record import Finding
from pipeline.compare.sentence import Look, sentence
from pipeline.inference.load_cases import load_cases
from tests.pipeline.bench import bench
from tests.pipeline.compare.test_error import planted

CASES = load_cases(bench(steps=24))
NAMES = [name.rpartition("_")[0] for name in (*DISPLACEMENTS, *WRENCHES)] + ["mid"]


def found(channel: str, shape: np.ndarray, test: str) -> list[Finding]:
    """Findings for noise, and a shape (R,) in sigmas in one channel of the tests so named."""
    number = NAMES.index(channel)
    own = np.array([t.id.startswith(test) for t in CASES.campaign.tests])[CASES.test]
    difference = np.random.default_rng(2).normal(size=CASES.measured.shape)
    difference[:, number] += np.where(own, shape, 0.0)
    return list(findings(Discrepancy(CASES, planted(CASES, difference * CASES.sigma)))[0])


def column(name: str) -> np.ndarray:
    return np.nan_to_num(CASES.measured[:, NAMES.index(name)])


def test_noise_alone_shows_nothing() -> None:
    assert found("x", np.zeros(len(CASES.test)), "axial") == []


def test_a_stiffness_that_is_wrong_shows_as_a_slope_and_nothing_else_is_told() -> None:
    fx = column("fx")
    first, *rest = found("x", 40.0 * fx / 4000.0, "axial_held")
    assert (first.group, first.channel, first.number, first.load) == ("axial_held", "x", "slope", "fx")
    # 40 sigma of 1 µm at 4000 N; 48 readings spread over the load give it to 0.3 sigma.
    assert first.value == pytest.approx(40e-3 / 4000.0, rel=0.03) and first.unit == "mm/N"
    assert first.significance > 50.0
    assert not any(each.sentence for each in rest)


def test_a_bend_is_called_a_bend_and_not_an_offset() -> None:
    """The mean of a square is an offset as well, and the stronger number of the two."""
    y = column("y")
    told = [each for each in found("x", 50.0 * (y / 6.0) ** 2, "lateral") if each.sentence]
    assert [each.number for each in told] == ["curvature"]
    assert told[0].sentence.startswith("x in lateral_q+0: bends with the square of y, +0.0")


def test_a_loop_is_called_a_loop_with_its_width() -> None:
    z = column("z")
    rising = np.sign(np.gradient(z))
    told = [each for each in found("fz", 10.0 * rising, "swing") if each.sentence]
    assert told[0].number == "loop" and told[0].group == "swing"
    # ± 10 sigma of 0.5 N. The direction at the two turns is a matter of definition: 4 of 48 steps.
    width = float(told[0].sentence.split("loop of ")[1].split()[0])
    assert width == pytest.approx(10.0, rel=0.15)


def test_a_second_failure_is_told_beside_the_first() -> None:
    fx = column("fx")
    shape = 60.0 * fx / 4000.0 + 30.0 * np.abs(fx) / 4000.0
    told = [each.number for each in found("x", shape, "axial_held") if each.sentence]
    assert told == ["slope", "asymmetry"]


def test_tests_that_are_loaded_alike_are_one_group() -> None:
    tests = CASES.campaign.tests
    named = {g.name: [tests[n].id for n in g.numbers] for g in groups(tests, CASES.campaign.gauges)}
    assert named == {
        "axial_held": ["axial_held_q+0", "axial_held_q+30"],
        "lateral_q+0": ["lateral_q+0"],
        "swing": ["swing_q+0", "swing_q+30"],
    }


@pytest.mark.parametrize(
    ("ids", "name"),
    [
        (("V1", "V2"), "V1 and V2"),
        (("q0", "q30"), "q0 and q30"),
        (("run-1", "run-2", "run-3"), "run-1, run-2 and run-3"),
        (("V1", "V2", "V3", "V4"), "all tests"),
        (("V1", "V2", "V3", "V4", "other"), "V1 and 3 more"),
        (("push_q+0", "push_q-30"), "push"),
    ],
)
def test_only_an_angle_is_left_out_of_the_names_of_tests(ids: tuple[str, ...], name: str) -> None:
    tests = tuple(replace(CASES.campaign.tests[0], id=each) for each in ids)
    assert groups(tests, CASES.campaign.gauges)[0].name == name


def test_every_number_has_words() -> None:
    """A series in which all numbers can be told, with the words of each."""
    rng = np.random.default_rng(0)
    load = np.tile(np.concatenate([np.linspace(0, 9, 10), np.linspace(8, -9, 18)]), 4)
    test = np.repeat(np.arange(4), 28)
    series = Series(
        rng.normal(size=112),
        load,
        np.full(112, 2.0),
        np.array([0.1, -0.3, 0.5, 0.0])[test],
        np.tile(np.arange(28.0), 4),
        test,
        rng.normal(size=112),
        unit="N",
        load_unit="mm",
    )
    numbers = misfit(series).signatures
    assert len(numbers) == 11
    said = {number.name: sentence(number, Look(series, 100.0, "y")) for number in numbers}
    assert all(text.endswith("sigma)") and "nan" not in text for text in said.values())
    assert len(set(said.values())) == 11 and "the model's" in said["slope"]


@pytest.mark.parametrize(("value", "words"), [(-4.1, "4.1 % below"), (12.0, "12 % above")])
def test_a_slope_is_a_share_of_the_models(value: float, words: str) -> None:
    load = np.linspace(-10.0, 10.0, 30)
    ones, zeros = np.ones(30), np.zeros(30)
    series = Series(value * load, load, ones, zeros, np.arange(30.0), zeros.astype(int), unit="N")
    slope = next(s for s in misfit(series).signatures if s.name == "slope")
    assert words in sentence(slope, Look(series, 100.0, "y"))
    # Of a model without a slope no share is taken.
    assert "more than the model says" in sentence(slope, Look(series, 0.0, "y"))
