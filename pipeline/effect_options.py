"""An effect as a command line asks for it, NAME[.PARAMETER][=VALUE]: its parameter and its number, or a complaint."""

from __future__ import annotations

from math import isfinite

import numpy as np

from pipeline.errors import InputError
from pipeline.toml.spelling import unknown_name
from vjm.effects.base import Effect, Parameter


def parameter_asked(text: str, effect: Effect, name: str) -> Parameter:
    """The parameter of that name, the first for no name. text: the whole option. InputError for what is none."""
    names = [p.name for p in effect.parameters]
    if not names:
        raise InputError(f"--effect {text}: {effect.name} is there or not, allowed is its name alone")
    if name and name not in names:
        raise InputError(f"--effect {text}: {effect.name} has no {name!r}, {unknown_name(name, names)}")
    return effect.parameters[names.index(name) if name else 0]


def number_asked(text: str, value: str, parameter: Parameter) -> float:
    """The value of a parameter. text: the whole option. InputError for what is no number or out of bounds."""
    try:
        number = float(value)
    except ValueError:
        number = np.nan
    if not isfinite(number) or not parameter.low <= number <= parameter.high:
        unit = "" if parameter.unit == "1" else f" {parameter.unit}"
        raise InputError(
            f"--effect {text}: {parameter.name} is {value.strip() or 'empty'}, "
            f"allowed are numbers from {parameter.low:g} to {parameter.high:g}{unit}"
        )
    return number
