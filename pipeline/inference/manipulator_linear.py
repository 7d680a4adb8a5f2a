"""A manipulator as a constant 6x6 at each posture: of virtual springs (LIN), or of frame elements at rest (FEA)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.prediction import Prediction, no_slides, no_stops, zeroed
from pipeline.inference.program import INPUTS, Group, Program
from pipeline.manipulator.frame import frame_stiffness
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest

Array = NDArray[np.float64]
Stiffness = Callable[[Manipulator, Array], Array]
"""(6, 6) of a manipulator as drawn at a pose (6,). ValueError where there is none."""


def by_springs(manipulator: Manipulator, pose: Array) -> Array:
    """Of virtual springs at rest."""
    found = stiffness_at_rest(manipulator, postures(manipulator, pose))
    if not found.found:
        raise ValueError(str(found.reason))
    return found.total


def by_frame(manipulator: Manipulator, pose: Array) -> Array:
    """Of frame elements at rest."""
    at = postures(manipulator, pose)
    if not at.reached:
        raise ValueError(str(at.reason))
    return frame_stiffness(manipulator, at.pose, at.coordinates)


def predict_constant(program: Program, stiffness: Stiffness) -> Prediction:
    """Readings if F = K t at every posture, K that of the drawing and known weights in place, solved for the control.

    ValueError where there is no stiffness, and for what the frame refuses. `states` is empty.
    """
    rows, channels = program.measured.shape
    values, by_inputs = np.zeros((rows, channels)), np.zeros((rows, channels, INPUTS))
    for group in program.groups:
        assert group.rig.manipulator is not None
        place, real = program.rows_of(group), group.real
        predicted, tangent = solved(group, stiffness(group.rig.manipulator, group.nominal[0, 0]))
        values[place] = predicted[real]
        by_inputs[place, :, :6] = np.broadcast_to(tangent[:, None], (*real.shape, channels, 6))[real]
    empty = np.zeros((rows, channels, 0)), np.zeros((rows, INPUTS)), no_stops(rows), no_slides(rows)
    return zeroed(Prediction(values, by_inputs, *empty, np.zeros(rows, dtype=bool), {}, ()), program)


def solved(group: Group, stiffness: Array) -> tuple[Array, Array]:
    """Readings (T, S, 12), displacements and forces, and their derivative (T, 12, 6) by what is prescribed.

    Of each coordinate one of the two is given; the manipulator carries the force read and the known weight.
    """
    weight = np.zeros(6)
    if group.rig.down is not None:
        weight[:3] = group.rig.platform_weight * group.rig.down
    given = group.targets - np.where(group.channels < 6, group.nominal[:, 0], 0.0)[:, None]
    tangent = np.zeros((len(group.numbers), 12, 6))
    constant = np.zeros((len(group.numbers), 12))
    for test, channels in enumerate(group.channels):
        held, free = np.flatnonzero(channels < 6), np.flatnonzero(channels >= 6)
        moved = tangent[test, :6]
        moved[held, held] = 1.0
        inner = stiffness[np.ix_(free, free)]
        moved[free[:, None], free] = np.linalg.inv(inner)
        moved[free[:, None], held] = -np.linalg.solve(inner, stiffness[np.ix_(free, held)])
        tangent[test, 6:] = stiffness @ moved
        constant[test, free] = np.linalg.solve(inner, weight[free])
        constant[test, 6:] = stiffness @ constant[test, :6] - weight
    return np.einsum("tci,tsi->tsc", tangent, given) + constant[:, None], tangent
