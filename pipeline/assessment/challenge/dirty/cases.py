"""Cases of the dirty programme by number: a clean case's draw of rig, sensors and tests, what is hidden, and dirt."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from pipeline.assessment.challenge.benches import FAIR, RICH, Bench, drawn_noise, drawn_plan, drawn_rig
from pipeline.assessment.challenge.cases import HIDDEN, STEPS, Case, drawn
from pipeline.assessment.challenge.dirty.dirt import Dirt, drawn_dirt
from pipeline.assessment.challenge.faults import FAULTS
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.campaign.names import channel_columns
from pipeline.parameter_names import path_of
from pipeline.simulate import scaled
from vjm.effects import catalogue, effect_of

SEED = 20_261_127
ROUND = (
    *("clean", "single", "sensor", "single"),
    *("clean", "pair", "single", "outside"),
    *("clean", "single", "sensor", "single"),
    *("clean", "triple", "single", "sensor"),
    *("clean", "single", "pair", "outside"),
)
"""Kinds of the cases of a round."""
SENSOR_SIZES = (0.3, 5.0)
"""Of faults of sensors, in typical ones."""
SHAPES: Mapping[str, tuple[float, float]] = {"steps": (1.0, 5.0), "start": (-1.0, 1.0)}
"""Numbers of faults that are no sizes: how fast one settles, and where in its gap a sensor stands."""
LARGEST_SHARE: Mapping[str, float] = {"sensor_gain": 0.05, "sensor_lag": 0.4, "sensor_cross_talk": 0.2}
"""Beyond what certificates allow: a gain within them is dirt, and no fault."""


@dataclass(frozen=True, eq=False)
class DirtyCase(Case):
    """dirt: what its bench has besides the physics."""

    dirt: Dirt


def dirty_case(number: int, share: float = 1.0) -> DirtyCase:
    """The case of a number; share: of the loads, less than one where the bench did not bear them."""
    generator = np.random.default_rng([SEED, number])
    kind, steps = ROUND[number % len(ROUND)], int(generator.choice(STEPS))
    seed = int(generator.integers(2**62))
    rig, noise = drawn_rig(generator), drawn_noise(generator)
    label = str(generator.choice((RICH, FAIR)))
    plan = scaled(drawn_plan(generator, label, steps), rig, share)
    dirt = drawn_dirt(generator, 12 + len(GAUGES))
    hidden: dict[str, float] = {}
    fault = None
    if kind == "outside":
        fault = str(generator.choice(list(FAULTS))), float(np.exp(generator.uniform(-1.0, 1.6)))
    elif kind == "sensor":
        hidden = _of_sensor(generator)
    elif kind != "clean":
        count = {"single": 1, "pair": 2, "triple": 3}[kind]
        for name in generator.choice(list(HIDDEN), count, replace=False):
            hidden |= drawn(str(name), generator)
    return DirtyCase(number, kind, Bench(rig, noise, plan, label), hidden, fault, seed, dirt)


def _of_sensor(generator: np.random.Generator) -> dict[str, float]:
    """One fault of one sensor, of a kind and a size."""
    kinds = sorted(name for name in catalogue() if name.startswith("sensor_"))
    kind = str(generator.choice(kinds))
    columns = channel_columns(GAUGES)
    read = [columns[k] for k in (0, 1, 6, 7, 8, 11, 12)]
    one, other = (
        str(name) for name in generator.choice(read[2:6] if kind == "sensor_cross_talk" else read, 2, False)
    )
    name = f"{kind}@{one}" + (f"<{other}" if kind == "sensor_cross_talk" else "")
    size = float(np.exp(generator.uniform(*np.log(SENSOR_SIZES))))
    out = {}
    for p in effect_of(name, catalogue()).parameters:
        sign = 1.0 if p.one_sided else float(generator.choice((-1.0, 1.0)))
        value = p.null + sign * size * p.typical
        if p.name in SHAPES:
            value = float(generator.uniform(*SHAPES[p.name]))
        if kind in LARGEST_SHARE:
            value = float(np.clip(value, -LARGEST_SHARE[kind], LARGEST_SHARE[kind]))
            value = sign * max(abs(value), 0.02) if kind == "sensor_gain" else value
        out[path_of(name, p.name)] = value
    return out
