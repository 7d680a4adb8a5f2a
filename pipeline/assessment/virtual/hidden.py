"""What a virtual bench hides: effects as they are asked for, NAME, NAME=VALUE or NAME.PARAMETER=VALUE, as numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from fem.frame.errors import Errors
from pipeline.assessment.virtual.bench import as_frame
from pipeline.campaign import Rig
from pipeline.effect_options import number_asked, parameter_asked
from pipeline.errors import InputError
from pipeline.parameter_names import parted, path_of
from pipeline.toml.spelling import unknown_name
from vjm.effects import effect_named
from vjm.effects.base import Effect
from vjm.effects.sensor_fault import SensorFault

FACTOR = 2.0
"""An effect without a value is up to so many times larger or smaller than its typical size."""


def hidden(
    asked: Iterable[str], known: Mapping[str, Effect], rig: Rig, generator: np.random.Generator
) -> dict[str, dict[str, float]]:
    """Values of all parameters, by effect and parameter.

    NAME=VALUE sets the effect's first parameter, NAME.PARAMETER=VALUE any; the rest stay absent. NAME draws every
    size of the effect: typical, times a factor between 1/2 and 2, of either sign where both have a meaning.
    InputError for what is no effect, no parameter, no number, out of bounds, or not to be had on this bench.
    """
    given: dict[str, dict[str, float]] = {}
    for text in asked:
        left, equals, value = text.partition("=")
        name, parameter = parted(left.strip())
        effect = effect_named(name, known)
        if effect is None:
            raise InputError(f"--effect {text}: effect {name!r} is unknown, {unknown_name(name, known)}")
        _simulable(text, effect, rig)
        new = name not in given
        own = given.setdefault(name, dict(effect.nulls))
        if not equals and "." in left:
            raise InputError(f"--effect {text}: has no value, allowed is {left}=VALUE")
        if equals:
            chosen = parameter_asked(text, effect, parameter)
            own[chosen.name] = number_asked(text, value, chosen)
        elif new:
            own |= _drawn(effect, rig, generator)
        else:
            raise InputError(f"--effect {text}: {name} is given twice, allowed is once")
    return given


def _simulable(text: str, effect: Effect, rig: Rig) -> None:
    paths = {path_of(effect.name, p.name): p.null for p in effect.parameters}
    if isinstance(effect, SensorFault) and not effect.column:
        example = f"{effect.name}@{effect.example}"
        raise InputError(f"--effect {text}: {effect.name} needs a sensor, allowed is {example}, such as fy_N")
    if effect.tags:
        kind = type(effect).name
        raise InputError(
            f"--effect {text}: the virtual bench has {kind} at all its parts alike, "
            f"allowed is {kind} without @{effect.tags}"
        )
    try:
        Errors.of(as_frame(paths, rig))
        effect.apply(rig.mechanism(()), effect.typicals)
    except ValueError as error:
        raise InputError(f"--effect {text}: the virtual bench cannot have {effect.name}: {error}") from error


def _drawn(effect: Effect, rig: Rig, generator: np.random.Generator) -> dict[str, float]:
    out = {}
    mechanism = rig.mechanism(())
    for p in effect.parameters:
        size = p.typical * FACTOR ** generator.uniform(-1.0, 1.0)
        sign = 1.0 if p.one_sided else generator.choice([-1.0, 1.0])
        alone = effect.nulls | {p.name: p.null + p.typical}
        # A parameter that is no size of the effect, such as a presliding angle, changes nothing alone.
        of_sensor = isinstance(effect, SensorFault) and not effect.absent(alone)
        if of_sensor or effect.apply(mechanism, alone) is not mechanism:
            out[p.name] = float(np.clip(p.null + sign * size, p.low, p.high))
    return out
