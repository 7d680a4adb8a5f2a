"""The gain of a sensor, known to a standard deviation."""

from __future__ import annotations

from typing import ClassVar

from vjm.effects.sensor_gain import SensorGain
from vjm.tolerances.base import Tolerance


class Gain(SensorGain, Tolerance):
    """A sensor reads too much or too little in proportion, within what its certificate says."""

    name = "gain"
    title = "gain of a sensor as given"
    keys: ClassVar = {"share": "gain"}
    deviations: ClassVar = {"gain": 0.0}
