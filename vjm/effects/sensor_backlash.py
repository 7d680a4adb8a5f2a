"""A sensor has backlash."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from vjm.effects.base import Parameter, Values
from vjm.effects.sensor_fault import SIZE, Rows, SensorFault
from vjm.frames import Array


class SensorBacklash(SensorFault):
    """A reading r stays where it is while y moves within the gap, and follows y at its ends.

    Where y rises it is low by gap (1 - start) / 2, where it falls high by gap (1 + start) / 2, against the first row.
    """

    name = "sensor_backlash"
    title = "a sensor has backlash"
    equation = "r_n = min(max(r_(n-1), y_n - gap (1 - start) / 2), y_n + gap (1 + start) / 2), r_0 = y_0 in each test"
    signature = (
        "one column stands still after each reversal of its own motion, then follows on a parallel line: a loop of one "
        "width, that no force makes"
    )
    limits = (
        "as wide in all of the travel; each test begins at the same place in the gap, as after a zero without load; "
        "one column"
    )
    source = (
        "play operator, as in M. Brokate, J. Sprekels, Hysteresis and Phase Transitions, 1996, section 2.2"
    )
    parameters = (
        replace(SIZE, name="gap", low=0.0, meaning="travel that is not read after a reversal"),
        Parameter(
            "start", "1", 0.0, 0.5, -2.0, 2.0, "place in the gap at first: at 1 it follows a rise at once"
        ),
    )

    smooth = False
    probes = (3.0, 10.0, 30.0)
    history = True

    def error(self, readings: Array, rows: Rows, values: Values) -> Array:
        own = self.own(readings, rows)
        # Differences at null ask for a gap below zero: its error is the same with the other sign.
        return np.asarray(np.sign(values["gap"]) * (_dragged(own, rows, values)[0] - own))

    def follows(self, readings: Array, rows: Rows, values: Values) -> NDArray[np.int64]:
        return _dragged(self.own(readings, rows), rows, values)[1]

    def absent(self, values: Values) -> bool:
        """Where in no gap it stands does not matter."""
        return values["gap"] == 0.0


def _dragged(own: Array, rows: Rows, values: Values) -> tuple[Array, NDArray[np.int64]]:
    """(R,) what is read of a motion (R,), and the row at which it was moved last."""
    gap, start = abs(values["gap"]), values["start"]
    low, high = own - gap * (1.0 - start) / 2.0, own + gap * (1.0 + start) / 2.0
    out, moved = own.copy(), np.arange(len(own))
    for row in range(1, len(own)):
        if rows.test[row] != rows.test[row - 1]:
            continue
        here, by = out[row - 1], moved[row - 1]
        if not low[row] < here < high[row]:
            here, by = (low[row], row) if here <= low[row] else (high[row], row)
        out[row], moved[row] = here, by
    return out, moved
