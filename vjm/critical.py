"""Critical load of a platform driven along x: where the primary equilibrium path loses stability."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.optimize import brentq

from vjm import lagrangian
from vjm.equilibrium import Equilibrium, equilibrium, unloaded
from vjm.frames import Array
from vjm.mechanism import Mechanism
from vjm.problem import held_mask
from vjm.stability import negative_eigenvalues, reduced_modes

_SINGULAR = 1e-9
# Of the lowest eigenvalue at rest. Equal bars agree to 1e-9 of it; another plane that buckles one per cent later
# still keeps a few per cent.
_TOGETHER = 1e-3


@dataclass(frozen=True, eq=False)
class CriticalLoad:
    """First instability on a path, or the news that there is none.

    found: whether one was met. load: Fx on the platform, N, compression negative; nan if none.
    displacement: of the platform along x, mm; nan if none. searched_load: Fx where the search ended, N.
    held: held coordinates, x included. state: the critical equilibrium, or the last one searched.
    direction: (N,) buckling direction in the unknowns' units (see `stability.Modes`), or None.
    unstable: number of directions that turn unstable at this load. reason: a sentence.
    """

    found: bool
    load: float
    displacement: float
    searched_load: float
    held: tuple[str, ...]
    state: Equilibrium
    direction: Array | None
    unstable: int
    reason: str


def driven(mechanism: Mechanism, displacement: float) -> Array:
    """(6,) pose of the platform moved along x by `displacement`, mm, from the unloaded one."""
    return mechanism.unloaded_pose + np.array([displacement, 0.0, 0.0, 0.0, 0.0, 0.0])


def drive(
    mechanism: Mechanism, displacement: float, held: Collection[str], start: Equilibrium | None = None
) -> Equilibrium:
    """Equilibrium at a driven x, on the branch of the start; the coordinates not `held` are free of load."""
    target = np.where(held_mask(held), driven(mechanism, displacement), 0.0)
    return equilibrium(mechanism, target, held, start, follow=True)


def critical_load(
    mechanism: Mechanism,
    held: Collection[str],
    sign: Literal[-1, 1] = -1,
    max_strain: float = 0.02,
    steps: int = 40,
) -> CriticalLoad:
    """First loss of stability while the platform is driven along x, the coordinates `held` (x apart) held.

    sign: -1 compression, +1 tension. The search ends at max_strain x length. The path is followed in
    equal steps; the count of negative eigenvalues (`stability`) brackets the instability, the root of
    the eigenvalue that changes sign refines it to 1e-12 of the travel. x is driven, so a limit point of the
    load alone is no instability here.
    ValueError where the unloaded mechanism already moves without load (z not held).
    """
    if sign not in (-1, 1):
        raise ValueError(f"sign must be -1 (compression) or +1 (tension), got {sign}")
    held = tuple(dict.fromkeys(["x", *held]))
    state = unloaded(mechanism)
    values = reduced_modes(state, held).values
    if values[0] < _SINGULAR * values[-1]:
        raise ValueError(f"the unloaded mechanism moves freely with {held} held; hold z as well")
    travel = sign * max_strain * mechanism.length
    before = 0.0
    for after in np.linspace(0.0, travel, steps + 1)[1:]:
        following = drive(mechanism, after, held, state)
        if not following.converged:
            return _none(state, held, f"no equilibrium found beyond x displacement {before:.6g} mm")
        if negative_eigenvalues(following, held) > 0:
            return _refine(state, before, float(after), held, _TOGETHER * float(values[0]))
        state, before = following, float(after)
    return _none(state, held, f"none found up to load {state.load[0]:.6g} N")


def _refine(
    start: Equilibrium, before: float, after: float, held: tuple[str, ...], together: float
) -> CriticalLoad:
    """The root between two displacements; eigenvalues below `together` vanish with it."""

    mechanism = start.mechanism

    def lowest(displacement: float) -> float:
        return float(reduced_modes(drive(mechanism, displacement, held, start), held).values[0])

    root = float(brentq(lowest, before, after, xtol=1e-12 * abs(after), rtol=1e-14))
    state = drive(mechanism, root, held, start)
    modes = reduced_modes(state, held)
    unstable = max(1, int(np.sum(modes.values < together)))
    direction = in_phase(modes.vectors[:, :unstable], lagrangian.layout(mechanism))
    load = float(state.load[0])
    reason = f"{unstable} direction(s) turn unstable at load {load:.6g} N"
    return CriticalLoad(True, load, root, load, held, state, direction, unstable, reason)


def in_phase(vectors: Array, place: lagrangian.Layout) -> Array:
    """Of the directions (N, k) that turn unstable together, the one in which the chains move most alike.

    It maximises the part that survives averaging over the chains, so two bars that buckle at one load buckle
    to the same side.
    """
    scaled = vectors / place.scale[:, None]
    averaged = scaled.copy()
    sizes = {x.stop - x.start for x in place.coordinates}
    if len(sizes) == 1:
        mean = np.mean([scaled[x] for x in place.coordinates], axis=0)
        for x in place.coordinates:
            averaged[x] = mean
    best = scaled @ np.linalg.eigh(scaled.T @ averaged)[1][:, -1]
    best = best * np.sign(best[np.argmax(np.abs(best))])
    return best * place.scale


def _none(state: Equilibrium, held: tuple[str, ...], reason: str) -> CriticalLoad:
    nan = float("nan")
    return CriticalLoad(False, nan, nan, float(state.load[0]), held, state, None, 0, reason)
