"""The question of a sweep as a command line asks it: --wrench, --effect, --rise."""

from collections.abc import Mapping, Sequence
from math import isfinite
from pathlib import Path

import numpy as np

from pipeline.effect_options import number_asked, parameter_asked
from pipeline.errors import InputError
from pipeline.inference.suitable import known_effects
from pipeline.manipulator.box import numbers
from pipeline.manipulator.loaded import with_true_moments
from pipeline.manipulator.question import Question
from pipeline.parameter_names import parted
from pipeline.toml.spelling import unknown_name
from vjm.effects.base import Effect
from vjm.effects.thermal_expansion import DRIVE
from vjm.lagrangian import layout
from vjm.manipulator.effects import with_effect
from vjm.manipulator.machine import machine
from vjm.manipulator.parts import Manipulator

Sizes = dict[str, dict[str, float]]
"""Values of all parameters, by effect and parameter."""


def question_of(
    manipulator: Manipulator,
    effects: Sequence[str] = (),
    wrench: str | None = None,
    rise: float | None = None,
    effects_from: Sequence[Path] = (),
) -> Question:
    """The question; effects: "NAME[.PARAMETER][=VALUE]", without a value of typical size, applied in turn.

    wrench: "FX,FY,FZ" or six numbers, N and N·mm. rise: of the temperature, K. InputError for what is no effect, no
    parameter, no number or out of bounds, and for an effect that the manipulator cannot have.
    """
    known = known_effects(effects_from).effects
    sizes = sizes_of(effects, known)
    load = None
    if wrench is not None:
        given = numbers("--wrench", wrench, 3 if wrench.count(",") < 3 else 6)
        load = np.array([*given, *[0.0] * (6 - len(given))])
        if not load.any():
            raise InputError("--wrench is zero, allowed is a load")
    changed = _changed(manipulator, sizes, known) if sizes else None
    inputs = {} if rise is None else {DRIVE: rise}
    _check_inputs(changed, rise)
    said = {
        "wrench": None if load is None else load.tolist(),
        "effects": sizes,
        "inputs": inputs,
    }
    return Question(load, changed, inputs, {name: value for name, value in said.items() if value})


def sizes_of(asked: Sequence[str], known: Mapping[str, Effect]) -> Sizes:
    """NAME has every typical size, NAME=VALUE its first parameter, NAME.PARAMETER=VALUE any, the rest at null."""
    out: Sizes = {}
    for text in asked:
        left, equals, value = text.partition("=")
        name, wanted = parted(left.strip())
        if name not in known:
            raise InputError(f"--effect {text}: effect {name!r} is unknown, {unknown_name(name, known)}")
        effect = known[name]
        if not equals:
            if "." in left or name in out:
                why = f"has no value, allowed is {left}=VALUE" if "." in left else f"{name} is given twice"
                raise InputError(f"--effect {text}: {why}")
            out[name] = effect.typicals
            continue
        parameter = parameter_asked(text, effect, wanted)
        own = out.setdefault(name, dict(effect.nulls))
        own[parameter.name] = number_asked(text, value, parameter)
    return out


def _changed(manipulator: Manipulator, sizes: Sizes, known: Mapping[str, Effect]) -> Manipulator:
    it = with_true_moments(manipulator)
    for name, values in sizes.items():
        try:
            it = with_effect(it, known[name], values)
            _ = machine(it).chains
        except ValueError as error:
            raise InputError(f"--effect {name}: {error}") from None
        except Exception as error:
            # A user's own effect may fail in any way: that is bad input, not a failure of the program.
            raise InputError(f"--effect {name}: {type(error).__name__}: {error}") from error
    return it


def _check_inputs(changed: Manipulator | None, rise: float | None) -> None:
    followed = changed is not None and DRIVE in layout(machine(changed)).drives
    if rise is not None and not isfinite(rise):
        raise InputError(f"--rise is {rise}, allowed is a number of kelvin")
    if followed and rise is None:
        raise InputError("bars that grow with temperature need --rise, the kelvin above the reference")
    if rise is not None and not followed:
        raise InputError("--rise is given, allowed with an effect of the temperature")
