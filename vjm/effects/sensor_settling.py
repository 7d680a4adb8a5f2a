"""A sensor settles after each test begins."""

from __future__ import annotations

import numpy as np

from vjm.effects.base import Parameter, Values
from vjm.effects.sensor_fault import SIZE, Rows, SensorFault
from vjm.frames import Array


class SensorSettling(SensorFault):
    """y -> y + size exp(-n / steps), n the steps since the test began."""

    name = "sensor_settling"
    title = "a sensor settles at the start of each test"
    equation = "y -> y + size exp(-n / steps), n = 0, 1, ... in each test"
    signature = "one column is off at the beginning of every test and recovers, whatever the load"
    limits = "the same in every test; one column"
    source = "exponential creep of a sensor after it was zeroed"
    parameters = (SIZE, Parameter("steps", "1", 3.0, 1.0, 0.3, 100.0, "in which it settles to 1/e"))

    def error(self, readings: Array, rows: Rows, values: Values) -> Array:
        return np.asarray(values["size"] * np.exp(-rows.step / values["steps"]))

    def absent(self, values: Values) -> bool:
        """How long nothing takes to settle does not matter."""
        return values["size"] == 0.0
