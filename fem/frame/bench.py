"""The virtual bench: rigs, their hidden errors and load histories in, what the sensors would read without noise out.

    rig = Rig("parallelogram", 310.0, bar_stiffness, 80.0)
    errors = Errors.of({"joint_friction.torque_Nmm": 350.0})
    control = ("force", *["displacement"] * 5)
    readings = run(rig, errors, [Trial(q=0.3, control=control, values=steps_by_6)])

Every trial starts from the unloaded linkage as mounted and goes through its steps in order, with the memory of
friction and yielding. Errors of numbers outside what a frame can be are ValueErrors; an equilibrium that is not
found is a step with `converged` false and a `reason`, and NaN readings.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem.frame.control import DISPLACEMENT, FORCE, GAUGE
from fem.frame.errors import Errors
from fem.frame.history import Histories, Records
from fem.frame.history import run as follow
from fem.frame.linkages import ELEMENTS, Setup, model
from fem.frame.placed import Anchored, Placed
from fem.frame.rig import STEEPEST_DEG, Gauge, Rig, steep
from meshes.solid import Floats

NAMES = ("x", "y", "z", "rx", "ry", "rz")


@dataclass(frozen=True, eq=False)
class Trial:
    """One test: angle q of the bars, rad; what is prescribed at x y z rx ry rz; the steps.

    control: six of "displacement" (from the nominal unloaded pose; rotations as rotation vector; base frame), "force"
    (the reading of the load cell) or a gauge's name (the load on this coordinate is what brings the gauge there).
    values (S, 6): the prescribed quantity at each step, N, mm, rad, N mm; not read where a support of the rig holds
    the coordinate. temperature (S,) C, or None: reference temperature. rig: instead of the campaign's.
    """

    q: float
    control: tuple[str, ...]
    values: Floats
    temperature: Floats | None = None
    rig: Rig | None = None


@dataclass(frozen=True, eq=False)
class Followed:
    """What a placed law did: coordinate (S, n), mm or rad, and force (S, n), N or N mm, at its n places: bar 1 base,
    bar 1 tip, bar 2 base, ... as far as it acts there."""

    site: str
    coordinate: Floats
    force: Floats


@dataclass(frozen=True, eq=False)
class Readings:
    """What one trial's sensors read at each step, and how it was found.

    displacement (S, 6): platform point (bar: tip) from the nominal unloaded pose of the rig as drawn, mm, rad.
    wrench (S, 6): the cell's reading of all that acts on the platform from outside (reactions of a guided or pinned
    tip included, dead loads not), N, N mm. gauges (S, G) mm. All NaN where not converged.
    converged (S,); reason (S,): empty or why not; iterations (S,); residual (S,): over the allowed, 1 at most where
    converged; negative (S,): unstable directions with the controlled displacements and gauges held, 0 is stable.
    followed: of each placed law; no sensor reads it.
    """

    displacement: Floats
    wrench: Floats
    gauges: Floats
    converged: np.ndarray
    reason: tuple[str, ...]
    iterations: np.ndarray
    residual: Floats
    negative: np.ndarray
    followed: tuple[Followed, ...] = ()


def run(
    rig: Rig,
    errors: Errors,
    trials: Sequence[Trial],
    gauges: Sequence[Gauge] = (),
    elements: int = ELEMENTS,
    placed: Sequence[Placed] = (),
) -> list[Readings]:
    """Readings of every trial, in their order; trials are solved together, all with the placed laws.

    Raises ValueError for a trial that is no such thing, for errors and sites that the rig cannot have, and for what
    `Rig`, `Errors` and `section_of` refuse.
    """
    if not trials:
        return []
    setups = [Setup(t.rig or rig, t.q, errors) for t in trials]
    for trial, setup in zip(trials, setups, strict=True):
        _check(trial, setup.rig, [g.name for g in gauges])
    mechanism = np.array([[c in s.rig.mechanism for c in range(6)] for s in setups])
    frames = model(setups, gauges, elements, placed)
    records = follow(frames, _histories(trials, setups, gauges), mechanism)
    return [_readings(records, i, len(t.values), frames.joints.placed) for i, t in enumerate(trials)]


def _check(trial: Trial, rig: Rig, gauges: list[str]) -> None:
    allowed = ["displacement", "force", *gauges]
    if len(trial.control) != 6:
        raise ValueError(f"{len(trial.control)} controlled quantities, allowed are six")
    for name, kind in zip(NAMES, trial.control, strict=True):
        if kind not in allowed:
            raise ValueError(f"{name} is controlled by {kind!r}, allowed are {', '.join(allowed)}")
    shape = np.shape(trial.values)
    if len(shape) != 2 or shape[1] != 6:
        raise ValueError(f"the values of a trial have shape {shape}, allowed is (steps, 6)")
    free = [c for c in range(6) if c not in rig.held]
    if not np.isfinite(np.asarray(trial.values)[:, free]).all():
        raise ValueError("a prescribed value is not finite")
    if trial.temperature is not None and np.shape(trial.temperature) != shape[:1]:
        raise ValueError("a trial needs one temperature for each step")
    if rig.kind == "parallelogram" and steep(trial.q):
        raise ValueError(f"q is {trial.q:g} rad, allowed are {STEEPEST_DEG:g} degrees either way at most")


def _histories(trials: Sequence[Trial], setups: Sequence[Setup], gauges: Sequence[Gauge]) -> Histories:
    """The trials side by side, the shorter ones filled up."""
    codes = {"displacement": DISPLACEMENT, "force": FORCE}
    codes |= {g.name: GAUGE + i for i, g in enumerate(gauges)}
    steps = np.array([len(t.values) for t in trials])
    value = np.zeros((len(trials), int(steps.max()), 6))
    temperature = np.zeros(value.shape[:2])
    for i, (trial, setup) in enumerate(zip(trials, setups, strict=True)):
        held = [c in setup.rig.held for c in range(6)]
        value[i, : steps[i]] = np.where(held, 0.0, trial.values)
        warm = setup.rig.reference_temperature if trial.temperature is None else trial.temperature
        temperature[i, : steps[i]] = warm
    kind = np.array([[codes[c] for c in t.control] for t in trials])
    return Histories(kind, value, temperature, steps)


def _readings(records: Records, i: int, steps: int, laws: tuple[Anchored, ...]) -> Readings:
    return Readings(
        records.displacement[i, :steps],
        records.wrench[i, :steps],
        records.gauges[i, :steps],
        records.converged[i, :steps],
        tuple(str(r) for r in records.reason[i, :steps]),
        records.iterations[i, :steps],
        records.residual[i, :steps],
        records.negative[i, :steps],
        tuple(_followed(records.memory[i, :steps], it, i) for it in laws),
    )


def _followed(memory: Floats, it: Anchored, i: int) -> Followed:
    """What one law did in the trial of that number; memory (S, M)."""
    own = it.own(memory)
    if not it.of_base:
        own = own[:, it.at[i].ravel()]
    return Followed(it.placed.site, own[..., 0], own[..., 1])
