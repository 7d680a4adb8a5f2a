"""FEA: what finite elements of the rig as drawn predict, driven with the measured inputs."""

from __future__ import annotations

from collections.abc import Callable
from functools import singledispatch

import numpy as np
from numpy.typing import NDArray

from fem.frame import bench
from fem.frame.errors import Errors
from fem.frame.history import AFTER_FAILURE
from fem.frame.newton import REASONS, SINGULAR
from pipeline.assessment.virtual import loaded_at
from pipeline.assessment.virtual.bench import frame_rig
from pipeline.campaign import ManipulatorRig, Rig, RigOfBars
from pipeline.campaign.names import DISPLACEMENT, SUPPORT
from pipeline.inference.load_cases import INPUTS, Group, LoadCases
from pipeline.inference.predicted import Prediction, moved_along, no_slides, no_stops, zeroed
from pipeline.manipulator.frame import frame_stiffness
from vjm.reasons import Reason

Array = NDArray[np.float64]
_SAID = {AFTER_FAILURE: Reason.ENDED, REASONS[SINGULAR]: Reason.NOT_HELD}
"""What the frame says, in the words of all models; the rest is its solver's affair."""


def predict_frame(
    load_cases: LoadCases, tangent: Callable[[], Prediction], shift: Array | None = None
) -> Prediction:
    """Readings of geometrically exact frame elements without any error of the bench.

    tangent: makes that of another model of the same rig, in whose place the frame has none of its own. shift: (R, 7)
    added to the measured inputs. ValueError for a rig that the frame refuses. `states` is empty. Of a whole manipulator
    the frame is linear, at rest.
    """
    moved = np.zeros((len(load_cases.test), INPUTS)) if shift is None else shift
    return zeroed(by_elements(load_cases.campaign.rig, load_cases, tangent, moved), load_cases)


@singledispatch
def by_elements(
    rig: Rig, load_cases: LoadCases, tangent: Callable[[], Prediction], moved: Array
) -> Prediction:
    """Readings of finite elements of this kind of rig, zeros not yet taken out; moved (R, 7) as shift of
    `predict_frame`. ValueError where there are none."""
    raise ValueError(f"finite elements of a {rig.kind} are not to be had")


@by_elements.register
def _of_bars(
    rig: RigOfBars, load_cases: LoadCases, tangent: Callable[[], Prediction], moved: Array
) -> Prediction:
    campaign = load_cases.campaign
    trials, rigs = [], []
    for number, test in enumerate(campaign.tests):
        assert isinstance(test.rig, RigOfBars)
        trials.append(
            bench.Trial(
                test.q,
                tuple(DISPLACEMENT if by == SUPPORT else by for by in test.control),
                test.inputs(campaign.gauges) + moved[load_cases.test == number, :6],
                None,
                frame_rig(test.rig),
            )
        )
        rigs.append(test.rig)
    found = loaded_at.run(rigs, trials, campaign.gauges, Errors())
    values = np.concatenate([np.hstack([r.displacement, r.wrench, r.gauges]) for r in found])
    converged = np.concatenate([r.converged for r in found])
    buckled = np.concatenate([r.negative for r in found]) > 0
    said = [reason for r in found for reason in r.reason]
    lost = ~converged | buckled
    reasons: dict[int, str] = {
        int(k): Reason.UNSTABLE if converged[k] else _SAID.get(said[k], Reason.NOT_CONVERGED)
        for k in np.flatnonzero(lost)
    }
    return Prediction(
        np.where(lost[:, None], 0.0, values),
        tangent().by_inputs,
        np.zeros((*values.shape, 0)),
        moved,
        no_stops(len(values)),
        no_slides(len(values)),
        lost,
        reasons,
        (),
    )


@by_elements.register
def _of_a_manipulator(
    rig: ManipulatorRig, load_cases: LoadCases, tangent: Callable[[], Prediction], moved: Array
) -> Prediction:
    """F = K t at every posture, K of frame elements at rest and known weights in place, solved for the control."""
    rows, channels = load_cases.measured.shape
    values, by_inputs = np.zeros((rows, channels)), np.zeros((rows, channels, INPUTS))
    for group in load_cases.groups:
        place, real = load_cases.rows_of(group), group.real
        each = {rig: _stiffness(rig) for rig in dict.fromkeys(group.rigs)}
        predicted, own = _constant(group, np.stack([each[rig] for rig in group.rigs]))
        values[place] = predicted[real]
        by_inputs[place, :, :6] = np.broadcast_to(own[:, None], (*real.shape, channels, 6))[real]
    empty = np.zeros((rows, channels, 0)), np.zeros((rows, INPUTS)), no_stops(rows), no_slides(rows)
    return moved_along(Prediction(values, by_inputs, *empty, np.zeros(rows, dtype=bool), {}, ()), moved)


def _stiffness(rig: Rig) -> Array:
    """(6, 6) of a manipulator at its posture. ValueError where it does not stand there."""
    assert isinstance(rig, ManipulatorRig)
    if not rig.posture.reached:
        raise ValueError(str(rig.posture.reason))
    return frame_stiffness(rig.manipulator, rig.posture.pose, rig.posture.coordinates)


def _constant(group: Group, stiffness: Array) -> tuple[Array, Array]:
    """Readings (T, S, 12), displacements and forces, and their derivative (T, 12, 6) by what is prescribed.

    Of each coordinate one of the two is given; the manipulator carries the force read and the known weight.
    stiffness: (T, 6, 6).
    """
    weight = np.zeros(6)
    if group.rig.down is not None:
        weight[:3] = group.rig.platform_weight * group.rig.down
    given = group.targets - np.where(group.channels < 6, group.nominal[:, 0], 0.0)[:, None]
    tangent = np.zeros((len(group.numbers), 12, 6))
    constant = np.zeros((len(group.numbers), 12))
    for test, (channels, own) in enumerate(zip(group.channels, stiffness, strict=True)):
        held, free = np.flatnonzero(channels < 6), np.flatnonzero(channels >= 6)
        moved = tangent[test, :6]
        moved[held, held] = 1.0
        inner = own[np.ix_(free, free)]
        moved[free[:, None], free] = np.linalg.inv(inner)
        moved[free[:, None], held] = -np.linalg.solve(inner, own[np.ix_(free, held)])
        tangent[test, 6:] = own @ moved
        constant[test, free] = np.linalg.solve(inner, weight[free])
        constant[test, 6:] = own @ constant[test, :6] - weight
    return np.einsum("tci,tsi->tsc", tangent, given) + constant[:, None], tangent
