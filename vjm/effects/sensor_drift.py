"""A sensor's zero moves while a campaign is measured."""

from __future__ import annotations

from vjm.effects.base import Values
from vjm.effects.sensor_fault import SIZE, Rows, SensorFault
from vjm.frames import Array


class SensorDrift(SensorFault):
    """y -> y + size t, t from 0 at the first row of the campaign to 1 at the last."""

    name = "sensor_drift"
    title = "a sensor's zero drifts over the campaign"
    equation = "y -> y + size t, t = 0 .. 1 over the rows of the campaign"
    signature = "one column is off by ever more from test to test, whatever the load"
    limits = "linear over the rows as they stand; one column"
    source = "first-order drift, as warming electronics have it"
    parameters = (SIZE,)

    def error(self, readings: Array, rows: Rows, values: Values) -> Array:
        return values["size"] * rows.clock
