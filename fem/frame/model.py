"""What a frame is and where it stands: frozen records of many tests at once (leading axis B)."""

from dataclasses import dataclass

import numpy as np

from fem.frame.batch import Bools
from fem.frame.fibres import Fibres
from fem.frame.joints import Joints
from fem.frame.local import Reference
from fem.frame.placed import memory_size
from fem.frame.reference import Bars
from fem.frame.so3 import IDENTITY, apply
from meshes.solid import Floats

BASE, PLATFORM = 0, 1


@dataclass(frozen=True, eq=False)
class Gauges:
    """G displacement gauges: bar of each, from 0; station (B, G) from 0 to 1, direction (B, G, 3) in the base frame.

    A gauge without a bar is on the platform, at offset (B, G, 3) mm from its point as drawn.
    """

    bar: tuple[int | None, ...]
    station: Floats
    direction: Floats
    offset: Floats


@dataclass(frozen=True, eq=False)
class Model:
    """A frame of K bars between rigid bodies: body 0 is the base, body 1 the platform.

    length (B, K): bar lengths at the reference temperature, mm; expansion (B,) 1/K; reference_temperature (B,) C.
    nominal (B, 3): platform point of the nominal unloaded rig, mm; mount (B, 3, 3): rotation of the linkage as mounted.
    base_active (B, 6), base_stiffness (B, 6): springs of the base body, fixed where not active.
    platform_force (B, 3) N and line_load (B, 3) N/mm: dead loads, base frame.
    cell (B, 6, 6): reading = cell @ wrench at the platform point.
    held (B, 6): platform coordinates that a support of the linkage holds, in the frame as mounted.
    """

    bars: Bars
    length: Floats
    expansion: Floats
    reference_temperature: Floats
    joints: Joints
    nominal: Floats
    mount: Floats
    base_active: Bools
    base_stiffness: Floats
    platform_force: Floats
    line_load: Floats
    cell: Floats
    held: Bools
    gauges: Gauges
    fibres: Fibres | None

    def warmed(self, temperature: Floats) -> Floats:
        """(B, K) unloaded lengths at a temperature (B,)."""
        return self.length * (1.0 + self.expansion * (temperature - self.reference_temperature))[:, None]


@dataclass(frozen=True, eq=False)
class State:
    """Bodies X (B, 2, 3), R (B, 2, 3, 3); inner bar nodes x (B, K, n - 1, 3) and r (..., 3, 3); joint coordinates q
    (B, K, 2, S); platform wrench F (B, 6); memories: sliders (B, K, 2), plastic strains (B, K, n, 3, fibres) and those
    of placed laws (B, M)."""

    X: Floats
    R: Floats
    x: Floats
    r: Floats
    q: Floats
    F: Floats
    slider: Floats
    plastic: Floats
    memory: Floats


@dataclass(frozen=True, eq=False)
class Unloaded:
    """Bars without load at one temperature: their elements and their end triads (B, K, 2, 3, 3) in the bar frame."""

    elements: Reference
    triads: Floats


def at_rest(model: Model, x: Floats, r: Floats) -> State:
    """Everything as mounted: bodies at rest, bars of the unloaded shape x (B, K, n + 1, 3), r (bar frame), joints zero.

    Each bar is placed by the joint at its base.
    """
    j = model.joints
    count, bars = x.shape[:2]
    X, R = np.zeros((count, 2, 3)), np.zeros((count, 2, 3, 3))
    R[:, BASE] = IDENTITY
    R[:, PLATFORM] = model.mount
    X[:, PLATFORM] = apply(model.mount, model.nominal)
    frame = j.frame[:, :, 0, None]
    inner = apply(frame, x[:, :, 1:-1]) + j.place[:, :, 0, None]
    zero = np.zeros((count, bars, 2))
    fibres = 0 if model.fibres is None else model.fibres.y.shape[-1]
    plastic = np.zeros((count, bars, x.shape[2] - 1, 3, fibres))
    q, memory = np.zeros(j.active.shape), np.zeros((count, memory_size(j.placed)))
    return State(X, R, inner, frame @ r[:, :, 1:-1], q, np.zeros((count, 6)), zero, plastic, memory)
