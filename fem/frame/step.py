"""One step of Newton's method: what it is, and how a state moves along it."""

from dataclasses import dataclass, replace

import numpy as np

from fem.frame.base import base_coordinates
from fem.frame.condensation import inner_motion, solve
from fem.frame.control import Conditions
from fem.frame.model import BASE, Model, State
from fem.frame.placed import Anchored, advanced_base, advanced_joints
from fem.frame.so3 import apply, exp, hat
from fem.frame.system import BODIES, PLATFORM_ROWS, System, active
from meshes.solid import Floats

LARGEST_TURN = 0.6
"""Longest spin of a step, rad: a longer one is scaled down with the whole step."""


@dataclass(frozen=True, eq=False)
class Step:
    """Motion of the m unknowns (B, m) and of inner nodes (B, K, n - 1, 6) and change of the platform wrench
    (B, 6)."""

    outer: Floats
    inner: Floats
    wrench: Floats


def balance(state: State, system: System) -> Floats:
    """(B, m) out-of-balance force at bodies and joints."""
    force = system.raw.copy()
    force[:, PLATFORM_ROWS] -= state.F
    return force


def newton_step(model: Model, state: State, system: System, rows: Conditions) -> Step:
    """The step to where the linearised frame is in balance under the linearised conditions."""
    there = active(model)
    used = np.flatnonzero(there.any(0))
    size = len(used)
    matrix = np.zeros((len(there), size + 6, size + 6))
    inside = there[:, used]
    both = inside[:, :, None] & inside[:, None, :]
    matrix[:, :size, :size] = np.where(both, system.tangent[:, used[:, None], used], np.eye(size))
    platform = np.searchsorted(used, np.arange(PLATFORM_ROWS.start, PLATFORM_ROWS.stop))
    matrix[:, platform, size + np.arange(6)] = -1.0
    # The wrench keeps its direction: what turns is the spin that the inner moment is conjugate to.
    turns = platform[3:]
    matrix[:, turns[:, None], turns] -= 0.5 * hat(system.raw[:, PLATFORM_ROWS][:, 3:])
    matrix[:, size:, :size] = rows.on_unknowns[:, :, used]
    matrix[:, size:, size:] = rows.on_wrench
    load = system.load.copy()
    load[:, PLATFORM_ROWS] -= state.F
    right = np.concatenate((np.where(inside, -load[:, used], 0.0), rows.missing), axis=-1)
    found = solve(matrix, right[..., None])[..., 0]
    outer = np.zeros(there.shape)
    outer[:, used] = np.where(inside, found[:, :size], 0.0)
    inner = inner_motion(system.condensed, _ends(model, system, outer))
    spins = (outer[:, 3:6], outer[:, 9:12], inner[..., 3:].reshape(len(outer), -1))
    longest = np.abs(np.concatenate(spins, axis=-1)).max(-1)
    part = np.minimum(1.0, LARGEST_TURN / np.maximum(longest, 1e-300))[:, None]
    return Step(outer * part, inner * part[..., None, None], found[:, size:] * part)


def _ends(model: Model, system: System, outer: Floats) -> Floats:
    """(B, K, 12) motion of the ends of the bars."""
    count, bars = system.rates.shape[:2]
    slots = outer[:, BODIES:].reshape(count, bars, 2, -1)
    ends = np.empty((count, bars, 2, 6))
    for bar, bodies in enumerate(model.joints.bodies):
        for end, body in enumerate(bodies):
            own = np.concatenate((outer[:, 6 * body : 6 * body + 6], slots[:, bar, end]), axis=-1)
            ends[:, bar, end] = apply(system.rates[:, bar, end], own)
    return ends.reshape(count, bars, 12)


def moved(state: State, step: Step, laws: tuple[Anchored, ...] = ()) -> State:
    """The state at the end of a step; laws: those that are placed at sites."""
    body = step.outer[:, :BODIES].reshape(-1, 2, 6)
    out = replace(
        state,
        X=state.X + body[..., :3],
        R=exp(body[..., 3:]) @ state.R,
        x=state.x + step.inner[..., :3],
        r=exp(step.inner[..., 3:]) @ state.r,
        q=advanced_joints(laws, state.q, step.outer[:, BODIES:].reshape(state.q.shape)),
        F=state.F + step.wrench,
    )
    if not any(it.of_base for it in laws):
        return out
    before, after = (base_coordinates(it.X[:, BASE], it.R[:, BASE]) for it in (state, out))
    there = advanced_base(laws, before, after)
    out.X[:, BASE], out.R[:, BASE] = there[:, :3], exp(there[:, 3:])
    return out
