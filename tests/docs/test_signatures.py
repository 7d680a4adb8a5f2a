"""Pictures of signatures show what the effects do: closed forms on the plan of the bench."""

from __future__ import annotations

import re

import numpy as np
import pytest

from docs.made.pictures import drawn
from docs.made.signatures import PANELS, signature
from vjm import paper
from vjm.effects import catalogue

KNOWN = catalogue()


def test_friction_is_a_loop_of_its_own_torque() -> None:
    """Held in rotation while it swings, the platform takes the torques of its two hinges."""
    panels = signature(KNOWN["joint_friction"])
    swing = next(it for it in panels if it.test.startswith("swing") and it.name == ("my", "Nmm"))
    torque = KNOWN["joint_friction"].typicals["torque_Nmm"]
    assert np.max(swing.change) == pytest.approx(2.0 * torque, rel=1e-3)
    assert np.min(swing.change) == pytest.approx(-2.0 * torque, rel=1e-3)
    assert swing.load_name == ("z", "mm") and abs(swing.change[0]) < 1e-6
    assert len(panels) <= PANELS and drawn(panels).startswith(b"\x89PNG")


def test_a_gain_is_a_share_of_the_reading() -> None:
    """Moved along y and held in rotation, two bars of K22 take 2 K22 y while y is small."""
    panels = signature(KNOWN["sensor_gain"])
    assert {it.name for it in panels} == {("fy", "N")}
    lateral = next(it for it in panels if re.match(r"lateral_q", it.test))
    small = np.flatnonzero(np.abs(lateral.load) < 2.0)
    share = KNOWN["sensor_gain"].typicals["share"]
    stiffness = 2.0 * paper.BAR_STIFFNESS[1, 1]
    assert np.allclose(lateral.change[small], share * stiffness * lateral.load[small], rtol=0.01, atol=1e-9)
    assert lateral.size == pytest.approx(np.sqrt(np.mean((lateral.change / 0.5) ** 2)))


@pytest.mark.long
def test_a_drive_gives_along_its_axis_in_a_machine() -> None:
    """At 200 N along x at home a compliance c of the drive along x moves the platform by 200 c."""
    panels = signature(KNOWN["actuator_compliance"])
    c = KNOWN["actuator_compliance"].typicals["mm_per_N"]
    largest = max(float(np.max(np.abs(it.change))) for it in panels)
    assert 0.9 * 200.0 * c < largest < 1.3 * 200.0 * c
    assert {it.load_name[1] for it in panels} == {"N"}
