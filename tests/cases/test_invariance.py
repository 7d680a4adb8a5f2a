"""What may not change a verdict: the unit of force, the size of the drawing, the order of tests; and what must.

A bench of the virtual plan with bars 10 % softer than said, by frame elements, and tables that people met.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.campaign import Campaign, Rig, RigOfBars, Test, read
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import Diagnosis, diagnose
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

DATA = Path(__file__).parent / "data"
IDS = ("axial_held_q+0", "lateral_q+0", "axial_held_q+30")


def found(campaign: Campaign) -> Diagnosis:
    return diagnose(campaign, Model(), catalogue())


@cache
def soft() -> Campaign:
    return bench("modulus_error.scale", 0.9, ids=IDS)


@cache
def plain() -> Diagnosis:
    return found(soft())


def scaled(it: Campaign, force: float, length: float) -> Campaign:
    """The same bench in other units, or as a model to scale."""
    moment = force * length
    size = np.array([length] * 3 + [1.0] * 3)
    load = np.array([force] * 3 + [moment] * 3)

    def rig(old: Rig) -> Rig:
        assert isinstance(old, RigOfBars) and old.bar_stiffness is not None
        stiffness = old.bar_stiffness * load[:, None] / size
        sizes = {n: length * v for n in ("width", "fibre_y", "fibre_z") if (v := getattr(old, n, None))}
        return replace(old, length=length * old.length, bar_stiffness=stiffness, **sizes)

    def test(old: Test) -> Test:
        d = old.data
        data = replace(
            d, displacement=size * d.displacement, wrench=load * d.wrench, gauges=length * d.gauges
        )
        return replace(old, rig=base if old.rig is it.rig else rig(old.rig), data=data)

    base, n = rig(it.rig), it.noise
    noise = replace(n, displacement=size * n.displacement, wrench=load * n.wrench, gauges=length * n.gauges)
    return replace(it, rig=base, noise=noise, tests=tuple(map(test, it.tests)))


@pytest.mark.parametrize(
    ("force", "length"),
    [
        pytest.param(1000.0, 1.0, marks=pytest.mark.long),
        pytest.param(1.0, 10.0, marks=pytest.mark.long),
        pytest.param(0.01, 0.1, marks=pytest.mark.long),
    ],
)
def test_units_and_scale_change_no_verdict(force: float, length: float) -> None:
    other = found(scaled(soft(), force, length))
    assert plain().verdict == "identified"
    assert (other.verdict, other.sets) == (plain().verdict, plain().sets)
    assert other.fit.rms == pytest.approx(plain().fit.rms, rel=1e-3)
    # A ratio has no unit; the standard error neither.
    np.testing.assert_allclose(other.model.values, plain().model.values, rtol=1e-4)


@pytest.mark.long
def test_the_order_of_the_tests_changes_no_verdict() -> None:
    for order in list(permutations(soft().tests))[3:5]:
        other = found(replace(soft(), tests=order))
        assert (other.verdict, other.sets) == (plain().verdict, plain().sets)
        np.testing.assert_allclose(other.model.values, plain().model.values, rtol=1e-3)


@pytest.mark.long
def test_sigmas_a_hundred_thousand_times_too_large_hide_nothing() -> None:
    n = soft().noise
    loose = replace(n, displacement=1e5 * n.displacement, wrench=1e5 * n.wrench, gauges=1e5 * n.gauges)
    answer = answered(found(replace(soft(), noise=loose)))
    assert answer.verdict != "within_noise"
    assert any("but the readings scatter far less" in said for said in answer.sentences)


@pytest.mark.long
@pytest.mark.parametrize("channel", [0, 1])
def test_a_shifted_channel_is_first_a_zero(channel: int) -> None:
    """By a thousand of its sigmas, in every test."""
    it = soft()
    name, shift = "xyz"[channel], 1000.0 * it.noise.displacement[channel]
    tests = tuple(
        replace(t, data=replace(t.data, displacement=t.data.displacement + shift * np.eye(6)[channel]))
        for t in it.tests
    )
    answer = answered(found(replace(it, tests=tests)))
    assert answer.verdict != "identified"
    assert f"{name} starts at" in answer.sentences[0] and 'zero = "fitted"?' in answer.sentences[0]


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("c04_dial_softer", marks=pytest.mark.long),
        "c05_one_point",
        pytest.param("t09_identified_undetermined", marks=pytest.mark.long),
        pytest.param("n_B_s4", marks=pytest.mark.long),
    ],
)
def test_a_larger_set_never_leaves_more_than_one_that_it_contains(name: str) -> None:
    fits = found(read(DATA / name)).cache
    pairs = 0
    for small, one in fits.fits.items():
        for large, other in fits.fits.items():
            if small < large and all(fits.candidates[n].parameters for n in large - small):
                pairs += 1
                assert other.order <= (one.lost, one.chi_square * (1.0 + 1e-9) + 1e-9), (small, large)
    assert pairs > 2
