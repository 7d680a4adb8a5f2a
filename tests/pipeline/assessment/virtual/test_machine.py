"""The truth of machines, by frame finite elements, and virtual springs with the same effect agree under small loads.

Neither has code of the other: an effect of the catalogue acts on springs, an error of `fem.frame.errors` on beams,
joints and readings. Sizes are such that no two parameters could be exchanged, and signs are all told.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fem.frame.errors import Errors
from pipeline.assessment.virtual.bench import as_frame
from pipeline.assessment.virtual.machine import AROUND, OF_LEGS, OF_LINKAGES, Machine
from pipeline.assessment.virtual.manipulator import NOISE
from pipeline.campaign import Campaign, Data, ManipulatorRig, Test
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model, Term
from pipeline.inference.prediction import predict
from pipeline.manipulator.description import describe, read
from tests.pipeline.manipulator.machines import TRIPTERON
from vjm.effects import catalogue
from vjm.manipulator.posture import postures

EFFECTS = catalogue()
POINT = (50.0, -40.0, 60.0)
LOADS = np.vstack([np.zeros(6), np.diag([2.0, -1.5, 1.0, 40.0, -30.0, 20.0])])
"""N, N·mm: none, and along and about each axis alone. Geometric stiffness is 2e-6 of what they move."""
UNUSED = {
    "dimension_error": ("length_mm",),
    "self_weight": ("line_N_per_mm",),
    "actuator_compliance": ("rad_per_Nmm",),
}
"""Parameters that do not show at rest; no drive of these machines turns."""
SHARE = {"self_weight": 0.05}
"""Of the typical size: a weight is a load, and stiffens or softens as one."""
MACHINES = {
    "orthoglide": read("orthoglide").manipulator,
    "tripteron": describe(TRIPTERON, "tripteron.toml").manipulator,
}


def values(name: str) -> dict[str, float]:
    """Of both signs where both have a meaning, none as large as another."""
    out = {}
    for k, p in enumerate(EFFECTS[name].parameters):
        sign = 1.0 if p.one_sided or k % 2 == 0 else -1.0
        out[p.name] = (
            p.null
            if p.name in UNUSED.get(name, ())
            else p.null + sign * SHARE.get(name, 1.0) * (1.0 + 0.3 * k) * p.typical
        )
    return out


def by_springs(machine: str, name: str | None) -> np.ndarray:
    """(S, 6) displacements under the loads."""
    whole = MACHINES[machine]
    rig = ManipulatorRig(length=whole.length, manipulator=whole, file=machine, at=POINT)
    count = len(LOADS)
    nothing = np.zeros((count, 6)), LOADS, np.zeros((count, 0)), None
    data = Data(np.arange(count), *nothing, np.zeros(count, dtype=np.int64))
    test = Test("t", 0.0, "fit", ("force",) * 6, "nominal", rig, data)
    model = Model() if name is None else Model((Term(EFFECTS[name], values(name)),))
    found = predict(model, load_cases(Campaign("c", replace(rig, at=None), NOISE, (), (test,))), slopes=False)
    assert not found.lost.any()
    return found.values[:, :6]


def by_frame(machine: str, name: str | None) -> np.ndarray:
    whole = MACHINES[machine]
    rig = ManipulatorRig(length=whole.length, manipulator=whole)
    own = {} if name is None else {f"{name}.{p}": value for p, value in values(name).items()}
    errors = Errors.of(as_frame(own, rig))
    return Machine(whole, errors, postures(whole, np.array(POINT))).displacements(LOADS, np.zeros(3))


def size(moved: np.ndarray) -> np.ndarray:
    """(6,) largest shift, mm, and largest turn, rad."""
    return np.repeat([np.abs(moved[:, :3]).max(), np.abs(moved[:, 3:]).max()], 3)


CASES = [("orthoglide", name) for name in OF_LINKAGES + OF_LEGS + AROUND]
CASES += [("tripteron", name) for name in OF_LEGS + AROUND]


@pytest.mark.parametrize(("machine", "name"), CASES)
def test_an_effect_in_both(machine: str, name: str) -> None:
    springs, frame = by_springs(machine, name), by_frame(machine, name)
    allowed = 1e-5 * size(frame)
    assert np.all(np.abs(springs - frame) < allowed), np.abs(springs - frame).max(axis=0)
    assert np.any(np.abs(frame - by_frame(machine, None)) > 20.0 * allowed), "the effect does not show"


@pytest.mark.parametrize(("machine", "name"), CASES)
def test_a_wrong_sign_shows(machine: str, name: str) -> None:
    """Each parameter of the truth turned to its other side of null, where it has one, is another machine."""
    springs = by_springs(machine, name)
    rig = ManipulatorRig(length=MACHINES[machine].length, manipulator=MACHINES[machine])
    allowed = 1e-5 * size(springs)
    turned = 0
    for p in EFFECTS[name].parameters:
        if p.one_sided or p.name in UNUSED.get(name, ()):
            continue
        own = values(name)
        own[p.name] = 2.0 * p.null - own[p.name]
        errors = Errors.of(as_frame({f"{name}.{q}": value for q, value in own.items()}, rig))
        at = postures(MACHINES[machine], np.array(POINT))
        wrong = Machine(MACHINES[machine], errors, at).displacements(LOADS, np.zeros(3))
        assert np.any(np.abs(wrong - springs) > 20.0 * allowed), p.name
        turned += 1
    assert turned or all(p.one_sided for p in EFFECTS[name].parameters)
