"""Exported modules under six unit loads in Exudyn: a bar, and a linkage with its joints."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.peers.export import CASES, LIMIT, loaded, source, wanted
from tests.pipeline.export.sources import relative_error

exudyn = pytest.importorskip("exudyn", reason="Exudyn (exudyn) is not installed")

# N and N·mm: bends of up to 1e-4 rad, whose second order goes with the mean of both signs, whose third is 1e-8.
LOADS = np.array([100.0, 0.1, 0.1, 1.0, 1.0, 1.0])
# N: the spring's stiffness, 2e4 N/mm, on the rounding of places some 300 mm away.
ROUNDING = 5e-9


def moved(module: dict[str, Any], wrench: np.ndarray, held: bool) -> np.ndarray:
    """(6,) mm and rad of the loaded body at rest; held: along z."""
    from exudyn import itemInterface as item

    # The container has to live as long as its system.
    container = exudyn.SystemContainer()
    mbs = container.AddSystem()
    made = module["build"](mbs)
    if held:
        ground = mbs.AddMarker(item.MarkerBodyRigid(bodyNumber=made["ground"], localPosition=module["POINT"]))
        joint = item.ObjectJointGeneric(
            markerNumbers=[ground, made["point"]], constrainedAxes=[0, 0, 1, 0, 0, 0]
        )
        mbs.AddObject(joint)
    mbs.AddLoad(item.LoadForceVector(markerNumber=made["point"], loadVector=list(wrench[:3])))
    mbs.AddLoad(item.LoadTorqueVector(markerNumber=made["point"], loadVector=list(wrench[3:])))
    mbs.Assemble()
    settings = exudyn.SimulationSettings()
    settings.staticSolver.newton.absoluteTolerance = ROUNDING
    settings.staticSolver.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    mbs.SolveStatic(settings)
    body = made.get("platform", made.get("body"))

    def read(what: Any) -> np.ndarray:
        return np.array(mbs.GetObjectOutputBody(body, what, [0.0, 0.0, 0.0]))

    turn = read(exudyn.OutputVariableType.RotationMatrix).reshape(3, 3)
    vector = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    return np.concatenate([read(exudyn.OutputVariableType.Displacement), vector])


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
@pytest.mark.parametrize("case", CASES)
def test_six_unit_loads(case: str, tmp_path: Path) -> None:
    it, path = source(case, "exudyn", tmp_path)
    module, free = runpy.run_path(str(path)), loaded(it)
    columns = []
    for direction in free:
        load = LOADS[direction] * np.eye(6)[direction]
        both = [moved(module, sign * load, len(free) < 6) for sign in (1.0, -1.0)]
        columns.append(0.5 * (both[0] - both[1]) / LOADS[direction])
    assert relative_error(np.stack(columns, axis=1)[free], wanted(it)) < LIMIT
