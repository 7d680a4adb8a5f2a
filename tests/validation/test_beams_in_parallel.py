"""Buckling of the parallelogram of two plain I-bars against two beam programs.

OpenSees (F. McKenna, Computing in Science & Engineering 13 (4), 2011; 64 corotational beams with shear a bar)
and exudyn (J. Gerstmayr, Multibody System Dynamics 60, 2024; geometrically exact beams): load at which the
straight path of both bars, driven along -x, becomes unstable, extrapolated to full refinement, and the slope of
the load just after. The bars: E 70e3 MPa, nu 0.33, A 97.20, I_y 2812.1, I_z 692.8, J 357.4 mm^4, shear areas
59.7 and 51.8 mm², 310 mm; width 80 mm.

Loads: 0.1 %, what eight segments leave in the row with the shortest waves. Slopes: 5 %, for the same reason;
they are small differences of the energy, and the programs' own values carry three digits.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.vjm.beams import BAR_P
from vjm.branch import buckled_path
from vjm.critical import critical_load
from vjm.equilibrium import equilibrium
from vjm.mechanisms.parallelogram import Parallelogram

LENGTH, WIDTH = 310.0, 80.0
GUIDED = ("z", "rx", "ry", "rz")
PROGRAMS = [
    (0, ("y", *GUIDED), 39461.0, 65.0),
    (0, GUIDED, 9937.0, 16.1),
    (0, ("z",), 2489.0, 4.03),
    (30, ("y", *GUIDED), 34141.0, 15.5),
    (30, GUIDED, 8603.5, 3.93),
    (30, ("z",), 2196.0, 1.416),
]


def linkage(degrees: float) -> Parallelogram:
    """Eight segments a bar; in the first row of each angle the modes of two planes lie within one per cent."""
    segments = 8
    plain = Parallelogram(LENGTH, WIDTH, BAR_P.stiffness(LENGTH), np.radians(degrees))
    return plain.refined(segments)


# At 30 degrees no two of the six loads are alike; test_parallelogram_of_bars_p.py has both angles.
@pytest.mark.parametrize(
    ("degrees", "held", "load", "slope"),
    [pytest.param(*it, marks=[] if it[0] else pytest.mark.long) for it in PROGRAMS],
)
def test_critical_load_and_slope_after_it(degrees: int, held: tuple, load: float, slope: float) -> None:
    critical = critical_load(linkage(degrees), held, max_strain=0.005)
    assert -critical.load == pytest.approx(load, rel=1e-3)
    after = buckled_path(critical, [1.01 * critical.displacement])
    assert after.converged[0]
    climb = (after.load[0, 0] - critical.load) / (after.pose[0, 0] - critical.state.pose[0])
    assert climb == pytest.approx(slope, rel=0.05)


@pytest.mark.parametrize(("degrees", "slope"), [(0, 43896.0), (30, 32921.0)])
def test_slope_before(degrees: int, slope: float) -> None:
    mechanism = linkage(degrees)
    state = equilibrium(mechanism, mechanism.unloaded_pose - [1e-4, 0, 0, 0, 0, 0])
    assert state.load[0] / -1e-4 == pytest.approx(slope, rel=1e-3)
