"""Measures a planned campaign on the frame finite elements: hidden errors, then the sensors' noise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from fem.frame import bench
from fem.frame.errors import Errors
from fem.frame.linkages import ELEMENTS
from fem.frame.placed import Placed
from fem.frame.rig import Rig as FrameRig
from fem.frame.section import Section, uniform
from pipeline.assessment.virtual import loaded_at
from pipeline.assessment.virtual.plan import PlannedTest
from pipeline.assessment.virtual.sensors import as_read, of_sensors
from pipeline.campaign import Campaign, Data, Gauge, Noise, Rig, RigOfBars, Test
from pipeline.campaign.model import Role
from pipeline.errors import InputError
from pipeline.parameter_names import parted

DISPLAYED = 20.0
"""Steps of a display in a sigma, at least: rounding then adds 1e-4 of the noise."""

YIELDING = 128
"""Elements of a bar that may yield: its plastic zones are shorter than the default elements. Where yield shows by 2 500
sigmas a model that interpolates forces is 13 sigmas off in a test of 24 steps with 64 elements, 2 with these."""


def measure(
    name: str,
    rig: RigOfBars,
    plan: Sequence[PlannedTest],
    noise: Noise,
    hidden: Mapping[str, float],
    seed: int,
    gauges: tuple[Gauge, ...] = (),
) -> Campaign:
    """A campaign as a bench with these hidden errors ("effect.parameter": value) would have measured it.

    The prescribed quantities are reached exactly and read with noise, as all others; displays show decimals down
    to a twentieth of a sigma or less. InputError for errors that the truth cannot have, RuntimeError where it finds
    no stable equilibrium.
    """
    return read_out(name, rig, plan, noise, seed, true_readings(rig, plan, hidden, gauges), gauges)


def true_readings(
    rig: RigOfBars,
    plan: Sequence[PlannedTest],
    hidden: Mapping[str, float],
    gauges: tuple[Gauge, ...] = (),
    placed: Sequence[Placed] = (),
) -> list[bench.Readings]:
    """What sensors without noise would read in each test, with the placed laws; errors as in `measure`."""
    try:
        errors = Errors.of(as_frame(hidden, rig))
        own = frame_rig(rig)
        trials = [bench.Trial(np.radians(t.q_deg), t.control, t.values, t.temperature, own) for t in plan]
        found = loaded_at.run(
            [rig] * len(plan), trials, gauges, errors, YIELDING if _yields(hidden) else ELEMENTS, placed
        )
    except ValueError as error:
        raise InputError(str(error)) from error
    for planned, readings in zip(plan, found, strict=True):
        if not readings.converged.all():
            step = int(np.argmin(readings.converged))
            raise RuntimeError(
                f"the bench finds no state: test {planned.id}, step {step}: {readings.reason[step]}"
            )
        if (readings.negative > 0).any():
            step = int(np.argmax(readings.negative > 0))
            raise RuntimeError(f"the bench has buckled: test {planned.id}, step {step}")
    there = [np.hstack([it.displacement, it.wrench, it.gauges]) for it in found]
    return [
        replace(it, displacement=one[:, :6], wrench=one[:, 6:12], gauges=one[:, 12:])
        for it, one in zip(found, as_read(there, hidden, gauges), strict=True)
    ]


def _yields(hidden: Mapping[str, float]) -> bool:
    return any(path.startswith("material_yield.") for path in hidden)


def read_out(
    name: str,
    rig: RigOfBars,
    plan: Sequence[PlannedTest],
    noise: Noise,
    seed: int | None,
    found: Sequence[bench.Readings],
    gauges: tuple[Gauge, ...] = (),
) -> Campaign:
    """The campaign of a plan from its true readings, with the sensors' noise of this seed; None: as they are."""
    generator = None if seed is None else np.random.default_rng(seed)
    tests = [_test(one, rig, readings, noise, generator) for one, readings in zip(plan, found, strict=True)]
    return Campaign(name, rig, replace(noise, gauges=noise.gauges[: len(gauges)]), gauges, tuple(tests))


def frame_rig(rig: RigOfBars) -> FrameRig:
    """The rig for the frame finite elements."""
    bar: Section | np.ndarray = rig.stiffness
    if rig.bar is not None:
        bar = uniform(EA=rig.bar.EA, EIy=rig.bar.EIy, EIz=rig.bar.EIz, GJ=rig.bar.GJ)
    base, tip = rig.ends
    more = {} if rig.reference_temperature is None else {"reference_temperature": rig.reference_temperature}
    return FrameRig(
        rig.kind,
        rig.length - rig.overhang,
        bar,
        rig.spread or 0.0,
        base,
        tip,
        rig.gravity or (0.0, 0.0, -1.0),
        rig.line_weight,
        rig.platform_weight,
        fibre_y=rig.fibre_y or 0.0,
        fibre_z=rig.fibre_z or 0.0,
        **more,
    )


def as_frame(hidden: Mapping[str, float], rig: Rig) -> dict[str, float]:
    """Names of the catalogue as the frame spells them: weights are vectors there, and sensors are no part of it."""
    down = np.array([0.0, 0.0, -1.0]) if rig.down is None else rig.down
    out: dict[str, float] = {}
    for name, value in hidden.items():
        effect, parameter = parted(name)
        if effect == "self_weight" and parameter == "line_N_per_mm":
            out |= {f"self_weight.line_{a}_N_per_mm": value * d for a, d in zip("xyz", down, strict=True)}
        elif effect == "self_weight" and parameter.startswith("platform_"):
            out[f"self_weight.f{parameter[9]}_N"] = value
        elif effect != "bar_geometric_nonlinearity" and name not in of_sensors(hidden):
            out[name] = value
    return out


def _test(
    planned: PlannedTest,
    rig: Rig,
    readings: bench.Readings,
    noise: Noise,
    generator: np.random.Generator | None,
) -> Test:
    def read(values: np.ndarray, sigma: np.ndarray) -> np.ndarray:
        if generator is None:
            return values
        noisy = np.asarray(values + generator.normal(size=values.shape) * sigma)
        for k, one in enumerate(sigma):
            noisy[:, k] = _displayed(noisy[:, k], one)
        return noisy

    steps = np.arange(len(planned.values))
    data = Data(
        steps,
        read(readings.displacement, noise.displacement),
        read(readings.wrench, noise.wrench),
        read(readings.gauges, noise.gauges[: readings.gauges.shape[1]]),
        read(planned.temperature[:, None], np.array([noise.temperature]))[:, 0],
        np.zeros(steps.size, dtype=np.int64),
    )
    role: Role = "holdout" if planned.holdout else "fit"
    return Test(planned.id, planned.q_deg, role, planned.control, "nominal", rig, data)


def _displayed(values: np.ndarray, sigma: float) -> np.ndarray:
    """Rounded to the decimals of a display."""
    return np.asarray(np.round(values, int(np.ceil(-np.log10(sigma / DISPLAYED)))))
