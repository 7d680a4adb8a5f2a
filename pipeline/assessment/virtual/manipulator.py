"""A virtual bench for whole manipulators: the frame finite elements at rest, loaded at some postures.

The frame is linear. Loads are so small that the geometric stiffness of bars, a share of about F / 10 kN of what they
give, stays below the sensors' noise. What only a load shows, such as friction or buckling, cannot be hidden in it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fem.frame.errors import Errors
from pipeline.assessment.virtual.bench import as_frame
from pipeline.assessment.virtual.machine import Machine, refused
from pipeline.assessment.virtual.sensors import as_read
from pipeline.campaign import Campaign, Data, ManipulatorRig, Noise, Test
from pipeline.campaign.model import Role, Vector
from pipeline.errors import InputError
from pipeline.parameter_names import path_of
from vjm.manipulator.effects import linkages
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import Postures

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
    """One axis after the other at every posture, to both sides and back; home (6,): the platform's pose, mm and rad."""
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
    name: str,
    rig: ManipulatorRig,
    loadings: tuple[Loading, ...],
    hidden: Mapping[str, Mapping[str, float]],
    seed: int,
    noise: Noise = NOISE,
) -> Campaign:
    """The campaign that this manipulator with hidden effects (values by effect and parameter) gives, with noise; what
    has no sigma is not read.

    InputError for an effect that the frame at rest does not have.
    """
    if "bar_geometric_nonlinearity" in hidden:
        raise InputError("--effect: frame elements at rest do not show how bars stiffen or soften under load")
    paths = {path_of(name, p): value for name, own in hidden.items() for p, value in own.items()}
    errors = _errors(rig, paths)
    generator = np.random.default_rng(seed)
    rigs: dict[Vector, ManipulatorRig] = {}
    there = []
    for one in loadings:
        own = rigs.setdefault(one.point, replace(rig, at=one.point))
        machine = Machine(rig.manipulator, errors, _posture(own))
        there.append(np.hstack([machine.displacements(one.loads, _weight(rig)), one.loads]))
    tests = []
    for one, read in zip(loadings, as_read(there, paths), strict=True):
        own, way, loads = rigs[one.point], read[:, :6], read[:, 6:]
        data = Data(
            np.arange(len(one.loads)),
            way + generator.normal(size=way.shape) * noise.displacement,
            loads + generator.normal(size=way.shape) * noise.wrench,
            np.zeros((len(one.loads), 0)),
            None,
            np.zeros(len(one.loads), dtype=np.int64),
        )
        tests.append(Test(one.id, 0.0, one.role, ("force",) * 6, "nominal", own, data))
    return Campaign(name, rig, noise, (), tuple(tests))


def _weight(rig: ManipulatorRig) -> Array:
    return np.zeros(3) if rig.down is None else rig.platform_weight * rig.down


def _errors(rig: ManipulatorRig, paths: Mapping[str, float]) -> Errors:
    """What is hidden in the machine, in the truth's own record."""
    errors = Errors.of(as_frame(paths, rig))
    if said := refused(errors, bool(linkages(rig.manipulator))):
        raise InputError(f"--effect: the virtual bench cannot have it: {said}")
    return errors


def _posture(rig: ManipulatorRig) -> Postures:
    """The joints, where the drawing has them."""
    if not rig.posture.reached:
        raise InputError(
            f"the plan has a posture at {np.round(rig.posture.pose[:3], 1).tolist()} mm: {rig.posture.reason}"
        )
    return rig.posture
