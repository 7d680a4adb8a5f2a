"""Euler loads of a single bar at the default number of elements, by the sign of its tangent's eigenvalues.

S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., McGraw-Hill 1961, sections 2.1 to 2.4. Half a
per cent is asked; 16 elements are 0.02 % high at the highest of these loads, and an extensible
column is P/EA, here 1e-5, higher.
"""

from __future__ import annotations

import numpy as np
import pytest

from fem.frame.bench import Trial, run
from fem.frame.errors import Errors
from fem.frame.rig import Rig
from fem.frame.section import uniform
from tests.fem.frame.rigs import LENGTH, control, steps

EI = 4.0e7
LIMIT = 0.005
# Softer in the plane of the hinges (about y), or across it (about z).
IN_PLANE, ACROSS = uniform(1e9, EI, 100 * EI, 1e8), uniform(1e9, 100 * EI, EI, 1e8)
# Free: k L = π/2; guided: π; clamped and pinned: tan kL = kL; pinned: π; clamped: 2π.
CASES = {
    "clamped, free": (ACROSS, "clamped", "free", (), np.pi / 2),
    "clamped, guided": (ACROSS, "clamped", "guided", (), np.pi),
    "clamped, pinned": (IN_PLANE, "clamped", "pinned", (), 4.493409458),
    "pinned, clamped": (IN_PLANE, "pinned", "guided", ("y", "z"), 4.493409458),
    "pinned, pinned": (IN_PLANE, "pinned", "pinned", (), np.pi),
    "clamped, clamped": (ACROSS, "clamped", "guided", ("y", "z"), 2 * np.pi),
}


@pytest.mark.parametrize("case", CASES)
def test_stability_is_lost_at_eulers_load(case: str) -> None:
    bar, base, tip, held, wave = CASES[case]
    load = (wave / LENGTH) ** 2 * EI
    rig = Rig("bar", LENGTH, bar, base=base, tip=tip)
    trials = [Trial(0.0, control(*held), steps(x=-s * load)) for s in (1.0 - LIMIT, 1.0 + LIMIT)]
    below, above = run(rig, Errors(), trials)
    assert below.converged.all() and above.converged.all(), (below.reason, above.reason)
    assert below.negative[0] == 0
    assert above.negative[0] == 1
