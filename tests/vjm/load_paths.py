"""Equilibria along a history, one after another."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from vjm.equilibrium import Drives, Equilibrium, equilibrium, stack
from vjm.frames import POSE_NAMES
from vjm.mechanism import Mechanism
from vjm.problem import Held, channel_numbers


def load_path(
    mechanism: Mechanism,
    targets: ArrayLike,
    held: Held = POSE_NAMES,
    start: Equilibrium | None = None,
    follow: bool = False,
    drives: Drives | None = None,
) -> Equilibrium:
    """Equilibria along a history: targets (steps, ..., 6) as in `equilibrium`, each started at the last.

    held: names, or a control for all steps (..., 6), or one for each step (steps, ..., 6). drives: (steps, ...).
    """
    targets = np.asarray(targets, dtype=float)
    numbers = channel_numbers(held, len(mechanism.gauges))
    numbers = np.broadcast_to(numbers, np.broadcast_shapes(numbers.shape, targets.shape))
    inputs = {name: np.asarray(value, dtype=float) for name, value in (drives or {}).items()}
    inputs = {name: np.broadcast_to(value, targets.shape[:-1]) for name, value in inputs.items()}
    states = []
    for k, (target, control) in enumerate(zip(targets, numbers, strict=True)):
        now = {name: value[k] for name, value in inputs.items()}
        start = equilibrium(mechanism, target, control, start, follow=follow, drives=now)
        states.append(start)
    return stack(states)
