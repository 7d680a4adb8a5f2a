"""What is prescribed at the platform: six conditions, each on a displacement, a reading of the load cell or a gauge."""

from dataclasses import dataclass

import numpy as np

from fem.frame.batch import Bools, Ints
from fem.frame.model import PLATFORM, Model, State
from fem.frame.so3 import apply, log, log_rate, transpose
from fem.frame.system import PLATFORM_ROWS, System
from meshes.solid import Floats

DISPLACEMENT, FORCE, GAUGE = 0, 1, 2
"""Kinds of condition; GAUGE + g is gauge g."""


@dataclass(frozen=True, eq=False)
class Targets:
    """Kinds (B, 6) and values (B, 6) of the six conditions."""

    kind: Ints
    value: Floats


@dataclass(frozen=True, eq=False)
class Conditions:
    """Linearised conditions: on the unknowns (B, 6, m) and on the wrench (B, 6, 6), with what is missing (B, 6)."""

    on_unknowns: Floats
    on_wrench: Floats
    missing: Floats
    geometric: Bools
    """(B, 6) whether a condition holds the frame in place: a displacement or a gauge."""


def displacement(model: Model, state: State) -> Floats:
    """(B, 6) platform displacement from the nominal unloaded pose, rotation vector, base frame."""
    return np.concatenate((state.X[:, PLATFORM] - model.nominal, log(state.R[:, PLATFORM])), axis=-1)


def reading(model: Model, state: State) -> Floats:
    """(B, 6) what the load cell reads."""
    return apply(model.cell, state.F)


def measured(model: Model, state: State, gauge: Floats, kind: Ints) -> Floats:
    """(B, 6) present value of the quantity that each condition is about; gauge (B, G) readings."""
    moved = displacement(model, state)
    values = np.where(kind == FORCE, reading(model, state), moved)
    for g in range(gauge.shape[-1]):
        values = np.where(kind == GAUGE + g, gauge[:, g, None], values)
    return np.where(model.held, 0.0, values)


def conditions(model: Model, state: State, system: System, zero: Floats, targets: Targets) -> Conditions:
    """Linearise the conditions at a state; zero (B, G): gauge coordinates in the unloaded state."""
    count, size = system.load.shape
    kind, held = targets.kind, model.held
    gauge = system.gauge - zero
    rows = np.zeros((count, 6, size))
    pose = np.zeros((count, 6, 6))
    pose[:, :3, :3] = np.eye(3)
    turn = log(state.R[:, PLATFORM])
    pose[:, 3:, 3:] = log_rate(turn)
    missing = targets.value - measured(model, state, gauge, kind)
    if held.any():
        back = transpose(model.mount)
        mounted = np.zeros_like(pose)
        own = log(back @ state.R[:, PLATFORM])
        mounted[:, :3, :3], mounted[:, 3:, 3:] = back, log_rate(own) @ back
        pose = np.where(held[..., None], mounted, pose)
        shift = apply(back, state.X[:, PLATFORM]) - model.nominal
        missing = np.where(held, -np.concatenate((shift, own), axis=-1), missing)
    geometric = held | (kind != FORCE)
    rows[..., PLATFORM_ROWS] = np.where((held | (kind == DISPLACEMENT))[..., None], pose, 0.0)
    for g in range(gauge.shape[-1]):
        chosen = (kind == GAUGE + g) & ~held
        rows = np.where(chosen[..., None], system.gauge_rates[:, g, None], rows)
        missing = np.where(chosen, missing - system.gauge_shift[:, g, None], missing)
    on_wrench = np.where(geometric[..., None], 0.0, model.cell)
    return Conditions(rows, on_wrench, missing, geometric)
