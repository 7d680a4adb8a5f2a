"""A virtual bench for whole manipulators: the frame finite elements at rest, loaded at some postures.

The frame is linear. Loads are so small that the geometric stiffness of bars, a share of about F / 10 kN of what they
give, stays below the sensors' noise. What only a load shows, such as friction or buckling, cannot be hidden in it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Data, Noise, Rig, Test
from pipeline.campaign.model import Role, Vector
from pipeline.errors import InputError
from pipeline.inference.rigs import manipulator_of, mechanism_of
from pipeline.manipulator.frame import frame_stiffness
from vjm.effects import catalogue
from vjm.manipulator.effects import linkages
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures

Array = NDArray[np.float64]
STEPS = 12
FORCE, MOMENT = 200.0, 4e3
"""N, N·mm: largest load of a test along or about one axis."""
NAMES = ("fx", "fy", "fz", "mx", "my", "mz")
SHARES: tuple[tuple[Vector, Role], ...] = (
    ((0.0, 0.0, 0.0), "fit"),
    ((0.16, -0.13, 0.19), "fit"),
    ((-0.19, 0.1, 0.24), "fit"),
    ((0.1, 0.2, -0.16), "holdout"),
)
"""Postures of the plan, from home, over the characteristic length of the manipulator."""
NOISE = Noise(
    displacement=np.array([1e-3, 1e-3, 1e-3, 2e-5, 2e-5, 2e-5]),
    wrench=np.array([0.5, 0.5, 0.5, 50.0, 50.0, 50.0]),
    gauges=np.zeros(0),
)
"""1 µm, 20 µrad, 0.5 N, 50 N·mm."""


@dataclass(frozen=True, eq=False)
class Loading:
    """One test: id, where the platform stands, its role, and the loads (steps, 6) on it."""

    id: str
    point: Vector
    role: Role
    loads: Array


def plan(manipulator: Manipulator, home: Array) -> tuple[Loading, ...]:
    """One axis after the other at every posture, to both sides and back."""
    turn = np.sin(np.linspace(0.0, 2.0 * np.pi, STEPS + 1)[1:])
    tests = []
    for number, (share, role) in enumerate(SHARES):
        x, y, z = home[:3] + manipulator.length * np.array(share)
        for axis, name in enumerate(NAMES):
            loads = np.zeros((STEPS, 6))
            loads[:, axis] = (FORCE if axis < 3 else MOMENT) * turn
            tests.append(Loading(f"{name}_p{number}", (float(x), float(y), float(z)), role, loads))
    return tuple(tests)


def measure_manipulator(
    name: str, rig: Rig, loadings: tuple[Loading, ...], hidden: Mapping[str, Mapping[str, float]], seed: int
) -> Campaign:
    """The campaign that this manipulator with hidden effects (values by effect and parameter) gives, with noise.

    InputError for an effect that the frame at rest does not have.
    """
    changed = _changed(rig, hidden)
    generator = np.random.default_rng(seed)
    rigs: dict[Vector, Rig] = {}
    tests = []
    for one in loadings:
        own = rigs.setdefault(one.point, replace(rig, point=one.point))
        k = _stiffness(rig, changed, np.array([*one.point, 0.0, 0.0, 0.0]))
        way = np.linalg.solve(k, (one.loads + _weight(rig)).T).T
        data = Data(
            np.arange(len(one.loads)),
            way + generator.normal(size=way.shape) * NOISE.displacement,
            one.loads + generator.normal(size=way.shape) * NOISE.wrench,
            np.zeros((len(one.loads), 0)),
            None,
            np.zeros(len(one.loads), dtype=np.int64),
        )
        tests.append(Test(one.id, 0.0, one.role, ("force",) * 6, "nominal", own, data))
    return Campaign(name, rig, NOISE, (), tuple(tests))


def _weight(rig: Rig) -> Array:
    weight = np.zeros(6)
    if rig.down is not None:
        weight[:3] = rig.platform_weight * rig.down
    return weight


def _changed(rig: Rig, hidden: Mapping[str, Mapping[str, float]]) -> Manipulator:
    known = catalogue()
    bench = reduce(lambda it, name: known[name].apply(it, hidden[name]), hidden, mechanism_of(rig, ()))
    changed = manipulator_of(rig, bench)
    assert rig.manipulator is not None
    pairs = zip(linkages(rig.manipulator), linkages(changed), strict=True)
    if any(type(one.as_built.model) is not type(other.as_built.model) for one, other in pairs):
        raise InputError("--effect: frame elements at rest do not show how bars stiffen or soften under load")
    return changed


def _stiffness(rig: Rig, changed: Manipulator, pose: Array) -> Array:
    """(6, 6) by frame elements, joints where the drawing has them."""
    assert rig.manipulator is not None
    at = postures(rig.manipulator, pose)
    if not at.reached:
        raise InputError(f"the plan has a posture at {pose[:3].round(1).tolist()} mm: {at.reason}")
    try:
        return frame_stiffness(changed, at.pose, at.coordinates)
    except ValueError as error:
        raise InputError(f"--effect: the virtual bench cannot have it: {error}") from None
