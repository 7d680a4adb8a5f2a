"""Gauges on members of a leg, wherever they are: the bars of a parallelogram read what they read on the bench."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.vjm.manipulator.example import LENGTH, WIDTH, orthoglide, pair
from vjm import paper
from vjm.equilibrium import equilibrium
from vjm.leg_chain import build
from vjm.manipulator.machine import Machine, posture_inputs
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import postures
from vjm.mechanisms import parallelogram as bench
from vjm.mechanisms.assembly import GaugeAt
from vjm.parts import Leg

PLACES = [(1, 1.0, (0.0, 1.0, 0.0)), (2, 0.5, (0.0, 0.0, 1.0)), (2, 1.0, (1.0, 0.0, 0.0))]
TARGET = np.array([400.0, 30.0, 2.0, 1e3, 500.0, -2e3])


@pytest.mark.parametrize("segments", [0, 3])
def test_bars_of_a_machine_read_as_on_the_bench(segments: int) -> None:
    linkage = bench.Parallelogram(
        LENGTH, WIDTH, paper.BAR_STIFFNESS, gauge_at=tuple(GaugeAt(*p) for p in PLACES)
    )
    linkage = linkage.refined(segments) if segments else linkage
    leg = Leg("one", (Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, segments=segments),))
    members = build(leg).members
    gauges = tuple(members[bar - 1].gauge(0, station, direction) for bar, station, direction in PLACES)
    whole = Machine(Manipulator("one", (leg,), LENGTH), gauges=gauges)
    theirs, ours = (equilibrium(it, TARGET, ("z",)) for it in (linkage, whole))
    assert ours.converged and theirs.converged and len(members) == 2
    read, expected = ours.readings[12:], theirs.readings[12:]
    np.testing.assert_allclose(read, expected, rtol=1e-8, atol=1e-10)
    assert np.min(np.abs(expected)) > 1e-6


def test_a_gauge_may_be_driven_in_a_machine() -> None:
    """Prescribing what a gauge on a bar reads gives back the load that made it read so."""
    whole = orthoglide(pair(segments=2))
    at = postures(whole, [20.0, -30.0, 10.0])
    seen = build(whole.legs[1]).members[2].gauge(1, 0.5, (0.0, 0.0, 1.0))
    machine = replace(Machine(whole), gauges=(seen,))
    inputs = posture_inputs(at)
    load = np.array([50.0, -20.0, 300.0, 0.0, 1e3, 0.0])
    first = equilibrium(machine, load, (), drives=inputs)
    driven = np.array([*load[:2], first.readings[12], *load[3:]])
    second = equilibrium(machine, driven, np.array([6, 7, 12, 9, 10, 11]), drives=inputs)
    assert first.converged and second.converged
    np.testing.assert_allclose(second.load[2], load[2], rtol=1e-6)
