"""Newton's method on many frames at once; those that are done are left alone."""

from dataclasses import dataclass, replace

import numpy as np

from fem.frame.batch import Bools, Ints, put, take
from fem.frame.chain import motion_of
from fem.frame.control import Conditions, Targets, conditions
from fem.frame.model import Model, State, Unloaded
from fem.frame.so3 import orthonormal
from fem.frame.stability import negative_eigenvalues
from fem.frame.step import balance, moved, newton_step
from fem.frame.system import System, active, evaluate
from meshes.solid import Floats

ITERATIONS = 16
AXIAL_SHARE, BENDING_SHARE = 1e-12, 1e-9
"""Out-of-balance force allowed, over EA (rounding of a node's place) and over EI / L² (the softest load)."""
ROUNDED = float(np.finfo(float).eps)
"""Lengths of a bar by which rounding moves two neighbours apart: short elements answer across, with 12 EI / h³."""
MISSED = 1e-9
"""Distance allowed to a prescribed mm or rad; a reading may miss as much force or moment as any node."""
RUNAWAY = 1e15

CONVERGED, SINGULAR, TOO_MANY, TURNED = 0, 1, 2, 3
REASONS = {
    CONVERGED: "",
    SINGULAR: "the tangent is singular: the prescribed quantities do not hold the linkage",
    TOO_MANY: f"no equilibrium within {ITERATIONS} iterations",
    TURNED: "an element has turned over: bars bend too sharply for so few elements",
}


@dataclass(frozen=True, eq=False)
class Outcome:
    """States and how they were found: code (B,) (a key of REASONS), iterations (B,), residual (B,) of the allowed
    out-of-balance, negative (B,) eigenvalues, gauge (B, G) coordinates."""

    state: State
    code: Ints
    iterations: Ints
    residual: Floats
    negative: Ints
    gauge: Floats


def equilibrium(
    model: Model, unloaded: Unloaded, start: State, targets: Targets, dead: Floats, zero: Floats
) -> Outcome:
    """Equilibria of all tests under their targets, from `start`; memories move on where one is found.

    dead (B,): share of the dead loads. zero (B, G): gauge coordinates in the unloaded state.
    """
    count = len(dead)
    out = Outcome(
        start,
        np.full(count, TOO_MANY),
        np.zeros(count, int),
        np.full(count, np.inf),
        np.zeros(count, int),
        np.zeros(zero.shape),
    )
    parts = (model, unloaded, start, targets, dead, zero)
    index = np.arange(count)
    for iteration in range(ITERATIONS + 1):
        some_model, some_unloaded, state, some_targets, some_dead, some_zero = parts
        with np.errstate(all="ignore"):
            system = evaluate(some_model, some_unloaded, state, some_dead)
            rows = conditions(some_model, state, system, some_zero, some_targets)
            error = _error(some_model, some_unloaded, state, system, rows)
        done, lost = error <= 1.0, ~(error < RUNAWAY)
        out = _recorded(out, index, iteration, error, parts, system, rows, done, lost)
        keep = np.flatnonzero(~(done | lost))
        if not len(keep) or iteration == ITERATIONS:
            break
        if len(keep) < len(index):
            parts, system, rows, index = take((parts, system, rows, index), keep)
        with np.errstate(all="ignore"):
            state = moved(parts[2], newton_step(parts[0], parts[2], system, rows), parts[0].joints.placed)
        parts = (*parts[:2], state, *parts[3:])
    return out


def _error(model: Model, unloaded: Unloaded, state: State, system: System, rows: Conditions) -> Floats:
    """(B,) worst out-of-balance over the allowed one; inf where the numbers are not finite."""
    length = model.length.max(1)
    force = AXIAL_SHARE * model.bars.EA.max(1) + BENDING_SHARE * model.bars.EI.min((1, 2)) / length**2
    moment = force * length
    noise = ROUNDED * length[:, None, None] * unloaded.elements.bend[..., 1, 1].max(-1)
    force, moment = force + noise.max((1, 2)), moment + (noise * unloaded.elements.h).max((1, 2))
    shifts, turns = _kinds(model)
    out_of_balance = np.where(active(model), np.abs(balance(state, system)), 0.0)
    missing = np.abs(rows.missing)
    allowed = np.where(rows.geometric, MISSED, np.repeat(np.stack((force, moment), -1), 3, axis=-1))
    worst = np.stack(
        (
            np.where(shifts, out_of_balance, 0.0).max(-1) / force,
            np.where(turns, out_of_balance, 0.0).max(-1) / moment,
            np.abs(system.inner[..., :3]).max((1, 2, 3)) / force,
            np.abs(system.inner[..., 3:]).max((1, 2, 3)) / moment,
            (missing / allowed).max(-1),
        )
    ).max(0)
    return np.where(np.isfinite(worst), worst, np.inf)


def _kinds(model: Model) -> tuple[Bools, Bools]:
    """Which unknowns are shifts and which are turns, (m,) each."""
    bodies = [True] * 3 + [False] * 3
    ends = 2 * model.length.shape[1]
    shifts = np.array(2 * bodies + ends * [motion_of(s)[0] == "shift" for s in model.joints.slots])
    return shifts, ~shifts


def _recorded(
    out: Outcome,
    index: Ints,
    iteration: int,
    error: Floats,
    parts: tuple[Model, Unloaded, State, Targets, Floats, Floats],
    system: System,
    rows: Conditions,
    done: Bools,
    lost: Bools,
) -> Outcome:
    """The outcome with what is known after an iteration; states are written where they are equilibria."""
    out.iterations[index] = iteration
    out.residual[index] = error
    out.code[index[lost]] = SINGULAR
    out.code[index[done & system.turned]] = TURNED
    ready = np.flatnonzero(done & ~system.turned)
    if not len(ready):
        return out
    model, _, state, *_ = parts
    found, some_system, some_rows = take((state, system, rows), ready)
    found = replace(
        found,
        R=orthonormal(found.R),
        r=orthonormal(found.r),
        slider=some_system.slider,
        plastic=some_system.plastic,
        memory=some_system.memory,
    )
    where = index[ready]
    out.code[where] = CONVERGED
    out.negative[where] = negative_eigenvalues(some_system, some_rows, active(model)[ready])
    out.gauge[where] = some_system.gauge
    return replace(out, state=put(out.state, where, found))
