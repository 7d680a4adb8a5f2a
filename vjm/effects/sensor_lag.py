"""A sensor follows late."""

from __future__ import annotations

from vjm.effects.base import Parameter, Values
from vjm.effects.sensor_fault import Rows, SensorFault, lagged
from vjm.frames import Array


class SensorLag(SensorFault):
    """A reading keeps a part of the last one: r_n = keeps r_(n-1) + (1 - keeps) y_n."""

    name = "sensor_lag"
    title = "a sensor follows late"
    equation = "r_n = keeps r_(n-1) + (1 - keeps) y_n, from rest in each test"
    signature = "a loop in one column against all others, that no force makes; more where the load moves fast"
    limits = "steps as even in time; one column"
    source = "first-order lag of a filter"
    parameters = (
        Parameter("keeps", "1", 0.0, 0.05, 0.0, 0.95, "part of the last reading that is still there"),
    )

    def error(self, readings: Array, rows: Rows, values: Values) -> Array:
        own = self.own(readings, rows)
        return lagged(own, rows, values["keeps"]) - own
