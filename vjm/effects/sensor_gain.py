"""A sensor reads too much or too little in proportion."""

from __future__ import annotations

from vjm.effects.base import Parameter, Values
from vjm.effects.sensor_fault import Rows, SensorFault
from vjm.frames import Array


class SensorGain(SensorFault):
    """y -> (1 + share) y of one column."""

    name = "sensor_gain"
    title = "a sensor's gain is off"
    equation = "y -> (1 + share) y"
    signature = "one column is off in proportion to its reading, in every test alike"
    limits = "one column, one share"
    source = "calibration of linear sensors"
    parameters = (Parameter("share", "1", 0.0, 0.01, -0.5, 0.5, "of the reading that it reads too much"),)

    def error(self, readings: Array, rows: Rows, values: Values) -> Array:
        return values["share"] * self.own(readings, rows)
