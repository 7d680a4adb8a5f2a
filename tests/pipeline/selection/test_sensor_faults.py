"""An effect that a sensor's fault explains as well is not named alone; one that no fault explains is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answer_of, answered
from pipeline.campaign import Data
from pipeline.improve.steps import certain
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import diagnose
from tests.pipeline.selection.bench import bench, with_fault
from vjm.effects import catalogue

ALWAYS = "bar_geometric_nonlinearity"


def slightly_creeping(data: Data) -> Data:
    """The gauge's zero moves by half a sigma during each test."""
    return replace(data, gauges=data.gauges + 0.0025 * np.linspace(0.0, 1.0, len(data.steps))[:, None])


@pytest.mark.long
@pytest.mark.parametrize("seed", [2, 3])
def test_a_gauge_that_creeps_a_little_is_no_tilt(seed: int) -> None:
    """A tilt of the mounting takes more off chi-square than any other effect, the gauge's own fault still more."""
    it = diagnose(with_fault(bench(seed=seed), slightly_creeping), Model(), catalogue())
    assert it.sets == ((ALWAYS, "mounting_tilt"),)
    (fault,) = it.instead
    assert fault.effect == "mounting_tilt" and "has a zero that moves during a test" in fault.words
    assert fault.explains > fault.of
    answer = answer_of(it)
    assert answer.verdict == "ambiguous" and answer.alternatives == ((ALWAYS,),)
    assert it.next_test is None and certain(it) == {ALWAYS}
    said = answered(it).sentences
    assert "mounting_tilt or a fault of a sensor; these tests cannot tell" in said[0]
    assert any("Instead of mounting_tilt a sensor may be at fault" in each for each in said)
    assert not any("No further test" in each for each in said)


@pytest.mark.long
def test_what_no_sensor_does_is_named() -> None:
    it = diagnose(bench("mounting_tilt.rz_rad", 2e-3), Model(), catalogue())
    assert it.verdict == "identified" and it.sets == ((ALWAYS, "mounting_tilt"),) and not it.instead
