"""Critical loads and slopes of the parallelogram of plain I-bars P against two independent beam programs.

OpenSees and exudyn, beams with shear, platform driven along -x: bifurcation loads in N (both bars), stiffness before
and after in N/mm; computed for this project, extrapolated to no imperfection. Half a per cent on the loads, three per
cent on the slopes behind: theory at q = 0, P / (2 L), lies 2 % below the first of them itself.
"""

from __future__ import annotations

import numpy as np
import pytest

from fem.frame.bench import Trial, run
from fem.frame.errors import Errors
from tests.fem.frame.rigs import BAR_P, LENGTH, control, measure, parallelogram, steps

RIG = parallelogram(BAR_P)
CASES = {
    (("y", "z", "rx", "ry", "rz"), 0): (39461, 65.0, 43896),
    (("z", "rx", "ry", "rz"), 0): (9937, 16.1, 43896),
    (("z",), 0): (2489, 4.03, 43896),
    (("y", "z", "rx", "ry", "rz"), 30): (34141, 15.5, 32921),
    (("z", "rx", "ry", "rz"), 30): (8603.5, 3.93, 32921),
    (("z",), 30): (2196, 1.416, 32921),
}
each_case = pytest.mark.parametrize(("held", "degrees"), CASES)


@each_case
def test_critical_load_and_slope_before(held: tuple[str, ...], degrees: int) -> None:
    load, _, slope = CASES[held, degrees]
    trials = [Trial(np.radians(degrees), control(*held), steps(x=-s * load)) for s in (0.995, 1.005)]
    # Driven by its force along x: the same bifurcation, and no limit point before it.
    below, above = run(RIG, Errors(), trials)
    assert below.negative[0] == 0 and above.negative[0] > 0
    first = measure(RIG, ("x", *held), steps(x=-1e-3), degrees)
    # The reference prints the secant up to its bifurcation.
    assert first.wrench[0, 0] / -1e-3 == pytest.approx(slope, rel=2e-3)


def slope_after(held: tuple[str, ...], degrees: int, imperfection: float) -> float:
    """Slope at the bifurcation of the curve from 0.3 to 1.6 mm behind it, N/mm.

    A symmetric bow starts every mode but the sway of a guided platform; a side force of the same size starts that.
    """
    load, _, before = CASES[held, degrees]
    at = load / before
    travel = np.concatenate((np.linspace(0, 1.1 * at, 12)[1:], 1.1 * at + np.linspace(0, 1.5, 16)[1:]))
    effects = {"bar_initial_bow.bow_y_mm": imperfection, "self_weight.fy_N": 100.0 * imperfection}
    found = measure(RIG, ("x", *held), steps(x=list(-travel)), degrees, effects)
    far = travel > at + 0.3
    return float(np.polyfit(travel[far] - at, -found.wrench[far, 0], 2)[1])


@each_case
def test_slope_after_buckling(held: tuple[str, ...], degrees: int) -> None:
    one, two = (slope_after(held, degrees, size) for size in (2e-3, 1e-3))
    # The slope grows in proportion to the imperfection.
    assert 2 * two - one == pytest.approx(CASES[held, degrees][1], rel=0.03)
    if degrees == 0:
        assert 2 * two - one == pytest.approx(CASES[held, degrees][0] / (2 * LENGTH), rel=0.03)
