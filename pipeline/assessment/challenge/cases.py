"""The cases by number: what is hidden on which bench. The same number is the same case, on any machine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from pipeline.assessment.challenge.benches import (
    AXIAL,
    FAIR,
    POOR,
    RICH,
    Bench,
    drawn_noise,
    drawn_plan,
    drawn_rig,
    whole_plan,
)
from pipeline.assessment.challenge.faults import FAULTS
from pipeline.assessment.coverage.cases import is_size
from pipeline.assessment.virtual.plan import SENSORS
from pipeline.parameter_names import parted, path_of
from pipeline.simulate import bench_rig, scaled
from vjm.effects import catalogue

Kind = Literal["clean", "single", "pair", "outside", "untold"]
SEED = 20_261_123
ROUND: tuple[Kind, ...] = (
    *("clean", "single", "single", "outside"),
    *("clean", "single", "pair", "untold"),
    *("clean", "single", "single", "outside"),
    *("clean", "single", "pair", "untold"),
    *("clean", "single", "single", "outside"),
)
"""Kinds of the cases of a round: of 600, 150 are clean."""
HIDDEN = (
    *("axis_flexibility", "bar_initial_bow", "bar_length_mismatch", "bar_stiffness_asymmetry"),
    *("base_compliance", "contact_stiffening", "dimension_error", "joint_clearance", "joint_friction"),
    *("joint_torsional_stiffness", "load_misalignment", "load_offset", "material_yield", "modulus_error"),
    *("mounting_tilt", "self_weight", "thermal_expansion"),
)
"""What may be hidden, in this order: a number stays the same case whatever joins the catalogue. Bars bend on every
bench, so that is nothing that could be hidden."""
ALWAYS = "bar_geometric_nonlinearity"
"""On every bench."""
SMALLEST, LARGEST = 0.05, 5.0
"""Sizes of what is hidden, in typical sizes."""
WITHIN: Mapping[str, Mapping[str, tuple[float, float]]] = {"material_yield": {"strain": (0.93, 1.11)}}
"""Smallest and largest of what else would nearly always be out of sight or at its bound: bars yield from strains of
0.1 to 0.4 % on."""
STEPS = (8, 10, 12)


@dataclass(frozen=True, eq=False)
class Case:
    """hidden: "effect.parameter" to value. fault: what no effect explains, with its size. seed: of the noise."""

    number: int
    kind: str
    bench: Bench
    hidden: Mapping[str, float]
    fault: tuple[str, float] | None
    seed: int

    @property
    def effects(self) -> tuple[str, ...]:
        """Names of what is hidden."""
        return tuple(dict.fromkeys(parted(path)[0] for path in self.hidden))


def case(number: int, share: float = 1.0) -> Case:
    """The case of a number; share: of the loads, less than one where the bench did not bear them."""
    generator = np.random.default_rng([SEED, number])
    kind, steps = ROUND[number % len(ROUND)], int(generator.choice(STEPS))
    seed = int(generator.integers(2**62))
    if kind == "untold":
        return _untold(number, generator, steps, seed, share)
    rig, noise = drawn_rig(generator), drawn_noise(generator)
    label = str(generator.choice((RICH, FAIR, POOR), p=(0.4, 0.4, 0.2)))
    plan = scaled(drawn_plan(generator, label, steps), rig, share)
    hidden: dict[str, float] = {}
    fault = None
    if kind == "outside":
        fault = str(generator.choice(list(FAULTS))), _size(generator)
    elif kind != "clean":
        names = list(HIDDEN)
        for name in generator.choice(names, 2 if kind == "pair" else 1, replace=False):
            hidden |= drawn(str(name), generator)
    return Case(number, kind, Bench(rig, noise, plan, label), hidden, fault, seed)


def drawn(name: str, generator: np.random.Generator) -> dict[str, float]:
    """An effect of some size: every number that makes it present a share of it, of either sign where both mean."""
    effect, size = catalogue()[name], _size(generator)
    out: dict[str, float] = {}
    for p in effect.parameters:
        if is_size(name, p.name):
            sign = 1.0 if p.one_sided else float(generator.choice((-1.0, 1.0)))
            part = size * float(generator.uniform(0.3, 1.0))
            if p.name in WITHIN.get(name, ()):
                part = float(np.interp(np.log(part), np.log((SMALLEST, LARGEST)), WITHIN[name][p.name]))
            move = sign * part * p.typical
            # Towards a bound it stays on this side of it.
            out[path_of(name, p.name)] = float(np.clip(p.null + move, *_within(p.null, p.low, p.high)))
        else:
            out[path_of(name, p.name)] = p.null
    return out


def _within(null: float, low: float, high: float) -> tuple[float, float]:
    return null + 0.95 * (low - null), null + 0.95 * (high - null)


def _size(generator: np.random.Generator) -> float:
    return float(np.exp(generator.uniform(np.log(SMALLEST), np.log(LARGEST))))


UNTOLD: Mapping[str, tuple[tuple[str, ...], Mapping[str, tuple[float, float]]]] = {
    "axial, q = 0": (
        ("axial_held_q+0",),
        {
            "modulus_error.scale": (-2.0, -0.5),
            "axis_flexibility.radial_mm_per_N": (0.5, 2.0),
            "base_compliance.x_mm_per_N": (0.5, 2.0),
        },
    ),
    "axial, three angles": (
        AXIAL,
        {"modulus_error.scale": (-2.0, -0.5), "axis_flexibility.radial_mm_per_N": (0.5, 2.0)},
    ),
    "one temperature": (
        (*AXIAL, "lateral_q+0", "swing_q+0", "lateral_q+30", "swing_q+30"),
        # A longer bar is softer as well: from some hundred sigmas on that tells.
        {"thermal_expansion.alpha_per_K": (0.01, 0.06), "dimension_error.length_mm": (0.01, 0.06)},
    ),
}
"""Plans that cannot tell: tests, and what they confuse, with its sizes in typical ones. Bars are softer, never stiffer:
no rival stiffens."""
WARM = 30.0
"""°C, of all tests where the temperature is one."""


def _untold(number: int, generator: np.random.Generator, steps: int, seed: int, share: float) -> Case:
    label = str(generator.choice(list(UNTOLD)))
    ids, sizes = UNTOLD[label]
    path = str(generator.choice(list(sizes)))
    name, parameter = parted(path)
    effect = catalogue()[name]
    (p,) = [each for each in effect.parameters if each.name == parameter]
    value = p.null + float(generator.uniform(*sizes[path])) * p.typical
    every = [test for test in whole_plan(steps) if test.id in ids or test.holdout]
    if label == "one temperature":
        every = [replace(test, temperature=np.full(len(test.values), WARM)) for test in every]
    else:
        every = [test for test in every if not test.holdout]
    rig = bench_rig()
    plan = scaled(every, rig, share)
    hidden = {path_of(name, each.name): each.null for each in effect.parameters} | {path: value}
    return Case(number, "untold", Bench(rig, SENSORS, plan, label), hidden, None, seed)
