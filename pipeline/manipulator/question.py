"""What a sweep may ask beside stiffness at rest and critical force: a wrench, and effects."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from vjm.manipulator.parts import Manipulator

Array = NDArray[np.float64]

REST = (
    "x_mm",
    "y_mm",
    "z_mm",
    "state",
    "K_tran_min",
    "K_tran_max",
    "K_rot_min",
    "K_rot_max",
    "critical_N",
    "leg",
    "K_tran_mean",
    "K_rot_mean",
    "reason",
)
"""Columns of every sweep. state: one of `FOUND` .. `LOST`. critical_N: smallest force on the platform, of any
direction, that makes a leg buckle; inf: none buckles; NaN: it cannot be found; leg: its number, -1 if it is NaN.
K_tran_mean, K_rot_mean: load over the displacement along it, averaged over all directions, which is the harmonic mean
of the three principal stiffnesses. reason: why numbers of the point are missing, the place of a sentence in the list
`reasons` of sweep.json; 0: none is missing."""
LOADED = (
    "critical_factor",
    "shift_mm",
    "turn_rad",
    "K_tran_loaded_min",
    "K_tran_loaded_max",
    "K_rot_loaded_min",
    "K_rot_loaded_max",
)
"""Columns under a wrench. critical_factor: of the wrench that makes a leg buckle, inf: none, NaN: it
cannot be found. shift, turn: of the
platform. The stiffness is that of the loaded state."""
CHANGED = ("K_tran_error", "K_rot_error", "offset_mm")
"""Columns of an effect: relative change of K_tran_min and K_rot_min without load, and how far it moves the unloaded
platform."""
GIVING = ("displacement_error",)
"""Column of an effect under a wrench: relative change of the displacement along the wrench (of its work)."""
FOUND, UNREACHED, SINGULAR, LOST = 0.0, 1.0, 2.0, 3.0
"""A stiffness is found; the posture is not reached; it has no stiffness; at rest it has, but no stable equilibrium is
found under the wrench or with the effect. Columns of these others that have no number are zero."""


@dataclass(frozen=True, eq=False)
class Question:
    """wrench: (6,) on the platform, true moments. changed: the manipulator with effects. inputs: of the effects, by
    name. said: all of it as the head of a sweep names it."""

    wrench: Array | None = None
    changed: Manipulator | None = None
    inputs: Mapping[str, float] = field(default_factory=dict)
    said: Mapping[str, object] = field(default_factory=dict)

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of all columns of a sweep, in order."""
        loaded = LOADED if self.wrench is not None else ()
        changed = CHANGED if self.changed is not None else ()
        return (*REST, *loaded, *changed, *(GIVING if loaded and changed else ()))
