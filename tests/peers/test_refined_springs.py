"""The refined virtual springs of bar P's parallelogram against two beam programs, OpenSees and exudyn.

Loads of bifurcation in N (both bars, platform driven along -x, extrapolated to no imperfection) and slopes of the load
just after, N/mm (origin of the numbers: tests/fem/bar_p.py). Twelve segments a bar: half a per cent on the loads, three
per cent on the slopes, as of the solid and of the frame. The branch is that of perfect bars: nothing is extrapolated.
With eight segments the two slopes of the fully held platform are 3.4 and 4.1 % low, their waves being the shortest.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.fem import bar_p
from tests.vjm.beams import BAR_P
from vjm.branch import buckled_path
from vjm.critical import critical_load
from vjm.mechanisms.parallelogram import Parallelogram

SEGMENTS = 12
TABLE = [
    (bar_p.ALL_BUT_X, 0.0, 39461.0, 65.0),
    (bar_p.GUIDED, 0.0, 9937.0, 16.1),
    (("z",), 0.0, 2489.0, 4.03),
    (bar_p.ALL_BUT_X, 30.0, 34141.0, 15.5),
    (bar_p.GUIDED, 30.0, 8603.5, 3.93),
    (("z",), 30.0, 2196.0, 1.416),
]


@pytest.mark.parametrize(
    ("held", "degrees", "load", "slope"),
    [pytest.param(*it, marks=[] if it[1] else pytest.mark.long) for it in TABLE],
)
def test_bifurcation(held: tuple[str, ...], degrees: float, load: float, slope: float) -> None:
    bars = BAR_P.stiffness(bar_p.LENGTH)
    linkage = Parallelogram(bar_p.LENGTH, bar_p.WIDTH, bars, np.radians(degrees)).refined(SEGMENTS)
    critical = critical_load(linkage, held, max_strain=0.005)
    assert -critical.load == pytest.approx(load, rel=5e-3)
    after = buckled_path(critical, [1.01 * critical.displacement])
    assert after.converged[0]
    climb = (after.load[0, 0] - critical.load) / (after.pose[0, 0] - critical.state.pose[0])
    assert climb == pytest.approx(slope, rel=0.03)
