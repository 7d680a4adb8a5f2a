"""A chain of one-dimensional joint coordinates between a rigid body and the end of a bar.

The chain starts in a frame fixed in the body; each coordinate shifts along, or turns about, an axis of the frame that
the coordinates before it have moved. Rates and second derivatives follow from the order alone: with a the axis of
a turn (zero for a shift) and v the velocity of the end, D_i v_j = a_i x v_j and D_i a_j = a_i x a_j for i before j.
"""

from dataclasses import dataclass

import numpy as np

from fem.frame.so3 import IDENTITY, apply, cross, dot, exp, hat, transpose
from meshes.solid import Floats

SLOTS = {
    "radial_x": ("shift", 0),
    "radial_z": ("shift", 2),
    "tilt_x": ("turn", 0),
    "tilt_z": ("turn", 2),
    "hinge": ("turn", 1),
    "play": ("shift", 0),
    "contact": ("shift", 0),
}
"""Joint coordinates in their order from body to bar: kind and axis. Those after the hinge follow the bar."""
SERIES = {
    "along": ("shift", 0),
    "across": ("shift", 2),
    "out_of_plane": ("shift", 1),
    "tilt_x": ("turn", 0),
    "tilt_z": ("turn", 2),
}
"""Coordinates of placed laws, after all others: kind and axis of the bar. Each law has its own: kind, #, number."""
NUMBERED = "#"


def motion_of(slot: str) -> tuple[str, int]:
    """Kind ("shift" or "turn") and axis of a joint coordinate: a key of SLOTS, or of SERIES with a number."""
    kind, numbered, _ = slot.partition(NUMBERED)
    return SERIES[kind] if numbered else SLOTS[kind]


@dataclass(frozen=True, eq=False)
class End:
    """Where a chain ends: position x (..., 3), triad R (..., 3, 3), and (..., 6, 6 + S) rates for body and slots."""

    x: Floats
    R: Floats
    rates: Floats


def end_of(X: Floats, R: Floats, place: Floats, frame: Floats, q: Floats, slots: tuple[str, ...]) -> End:
    """Ends of chains on bodies at X (..., 3), R (..., 3, 3), starting at `place` (..., 3) mm and `frame` in the body.

    q: (..., S) mm and rad, in the order of `slots` (`motion_of`).
    """
    here, now = X + apply(R, place), R @ frame
    axes, centres = [], []
    for j, slot in enumerate(slots):
        kind, axis = motion_of(slot)
        direction = now[..., :, axis]
        axes.append(direction)
        centres.append(here)
        if kind == "shift":
            here = here + q[..., j, None] * direction
        else:
            now = now @ exp(q[..., j, None] * IDENTITY[axis])
    rates = np.zeros((*q.shape[:-1], 6, 6 + len(slots)))
    rates[..., :3, :3] = rates[..., 3:, 3:6] = IDENTITY
    rates[..., :3, 3:6] = -hat(here - X)
    for j, slot in enumerate(slots):
        turns = motion_of(slot)[0] == "turn"
        rates[..., :3, 6 + j] = cross(axes[j], here - centres[j]) if turns else axes[j]
        if turns:
            rates[..., 3:, 6 + j] = axes[j]
    return End(here, now, rates)


def geometric(rates: Floats, load: Floats) -> Floats:
    """(..., 6 + S, 6 + S) symmetric second derivative of load·(x, w) for body and slots; load (..., 6) at the end.

    It is what the chain adds to a Hessian that is taken along exp(w) at the end of the bar and at the body.
    """
    v, a = rates[..., :3, :], rates[..., 3:, :]
    # The first three columns shift the body: they turn nothing.
    work = -hat(load[..., :3]) @ v - 0.5 * hat(load[..., 3:]) @ a
    m = transpose(a) @ work
    body = m[..., 3:6, 3:6]
    m[..., 3:6, 3:6] = 0.5 * (body + transpose(body))
    upper = np.triu(m)
    return np.asarray(upper + transpose(np.triu(m, 1)))


def work_rate(rates: Floats, load: Floats) -> Floats:
    """(..., 6 + S) generalised forces of a load (..., 6) at the end."""
    return dot(transpose(rates), load[..., None, :])
