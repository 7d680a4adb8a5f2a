"""The catalogue of physical effects: every module beside this one that defines an effect belongs to it."""

from __future__ import annotations

import importlib
import importlib.util
import inspect
import pkgutil
import sys
import warnings
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType

from vjm.effects.base import Effect
from vjm.effects.checkout_names import ABOVE, install
from vjm.effects.sensor_fault import SensorFault

USERS = "user_effects_"
"""Begins the names of the modules that users' own files become."""


def catalogue() -> dict[str, Effect]:
    """All effects of this package by name, in alphabetical order."""
    names = sorted(info.name for info in pkgutil.iter_modules(__path__))
    modules = (importlib.import_module(f"{__name__}.{name}") for name in names)
    return {effect.name: effect for module in modules for effect in defined_in(module)}


def for_kind(kind: str) -> dict[str, Effect]:
    """Those that act on the mechanism of a rig of this kind, by name: no faults of sensors."""
    return {
        name: it for name, it in catalogue().items() if kind in it.kinds and not isinstance(it, SensorFault)
    }


def effect_of(name: str, known: Mapping[str, Effect]) -> Effect:
    """The effect of a name as in `effect_named`; KeyError for a name that is none."""
    found = effect_named(name, known)
    if found is None:
        raise KeyError(name)
    return found


def effect_named(name: str, known: Mapping[str, Effect]) -> Effect | None:
    """An effect by its name: of a sensor's fault with the sensor after an @, of one that acts on some parts alone with
    their tags. None for a name that is none."""
    kind, at, site = name.partition("@")
    effect = known.get(name) or known.get(kind)
    if effect is None or effect.name == name:
        return effect
    try:
        return effect.at(site) if at else None
    except ValueError:
        return None


def shipped(effect: Effect) -> bool:
    """Whether an effect belongs to this catalogue."""
    return type(effect).__module__.startswith(f"{__name__}.")


def from_file(path: Path) -> dict[str, Effect]:
    """Effects that a user's own file defines, by name.

    ValueError if the file cannot be run or defines none.
    """
    spec = importlib.util.spec_from_file_location(f"{USERS}{path.stem}", path)
    if spec is None or spec.loader is None:
        raise ValueError(f"{path}: not a Python file")
    module = importlib.util.module_from_spec(spec)
    # Dataclasses of the file look their own module up.
    sys.modules[module.__name__] = module
    elsewhere = install() if ABOVE else None
    try:
        spec.loader.exec_module(module)
        found = {effect.name: effect for effect in defined_in(module)}
    except Exception as error:
        del sys.modules[module.__name__]
        raise ValueError(f"{path}: {type(error).__name__}: {error}") from error
    if not found:
        raise ValueError(f"{path}: found no class that inherits from parastiff.Effect")
    if elsewhere and elsewhere.asked:
        elsewhere.asked = False
        said = f"{path}: imports from vjm, its name in a checkout; write: from parastiff import Effect, Parameter"
        warnings.warn(said, FutureWarning, stacklevel=2)
    return found


def defined_in(module: ModuleType) -> list[Effect]:
    """One instance of every concrete effect class that the module itself defines."""
    classes = [c for _, c in inspect.getmembers(module, inspect.isclass) if c.__module__ == module.__name__]
    return [c() for c in classes if issubclass(c, Effect) and not inspect.isabstract(c)]
