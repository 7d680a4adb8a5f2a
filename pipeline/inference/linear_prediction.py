"""LIN: what a constant stiffness predicts, virtual springs linearised without load."""

from __future__ import annotations

import numpy as np

from pipeline.inference.load_cases import INPUTS, Group, LoadCases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction, no_slides, no_stops, zeroed
from vjm.effects.thermal_expansion import DRIVE
from vjm.equilibrium import equilibrium
from vjm.reasons import Reason
from vjm.sensitivity import by_targets


def predict_linear(load_cases: LoadCases) -> Prediction:
    """Readings with the stiffness of the unloaded rig (K_p of Eq. 11, K_b of a bar), solved for its control.

    The platform's six displacements and loads obey F = K t about the state under the known weights alone; what the
    control prescribes is given and the rest is solved for, whatever the mixture. Gauges follow the shape that a
    uniform bar of this K_b bends to, which a lumped spring does not have. The tangent is the same everywhere:
    `by_inputs` of every step of a test is its constant one. `states` is empty.
    """
    rows, channels = load_cases.measured.shape
    values, by_inputs = np.zeros((rows, channels)), np.zeros((rows, channels, INPUTS))
    lost, reasons = np.zeros(rows, dtype=bool), dict[int, str]()
    for group in load_cases.groups:
        place, real = load_cases.rows_of(group), group.real
        predicted, tangent, why = _group(load_cases, group)
        values[place] = predicted[real]
        by_inputs[place, :, :6] = np.broadcast_to(tangent[:, None], (*real.shape, channels, 6))[real]
        for row, reason in zip(place, np.broadcast_to(why[:, None], real.shape)[real], strict=True):
            if reason:
                lost[row], reasons[int(row)] = True, str(reason)
    empty = np.zeros((rows, channels, 0)), np.zeros((rows, INPUTS)), no_stops(rows), no_slides(rows)
    plain = Prediction(values, by_inputs, *empty, lost, reasons, ())
    return zeroed(plain, load_cases)


def _group(load_cases: LoadCases, group: Group) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Readings (T, S, C), tangents (T, C, 6) and why there is none (T,)."""
    mechanism = Model().mechanism(group, load_cases.campaign.gauges)
    if load_cases.campaign.gauges:
        mechanism = mechanism.changed(mechanism.view.refined())
    nominal = group.nominal[:, 0]
    free = np.where(group.channels < 6, nominal, 0.0)
    inputs = group.inputs(mechanism)
    # At the reference temperature.
    drives = {name: value[:, 0] for name, value in inputs.items() if name != DRIVE}
    state = equilibrium(mechanism, free, group.channels, drives=drives)
    tangent = by_targets(state)
    change = group.targets - free[:, None]
    readings = state.readings[:, None] + np.einsum("tci,tsi->tsc", tangent.readings, change)
    readings[..., :6] -= nominal[:, None]
    held = state.converged & tangent.regular
    why = np.where(held, "", Reason.NOT_HELD).astype(object)
    return readings, tangent.readings, why
