"""Which effects can be added to the model of a campaign: names, files of the user's own, and what the rig allows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from pipeline.campaign import Campaign
from pipeline.campaign.names import channel_columns
from pipeline.errors import InputError
from pipeline.inference.model import Model
from pipeline.toml.spelling import unknown_name
from vjm.effects import catalogue, effect_named, from_file
from vjm.effects.base import Effect
from vjm.effects.sensor_fault import SensorFault
from vjm.effects.sized import Scale, all_sized, sized
from vjm.effects.thermal_expansion import DRIVE
from vjm.lagrangian import layout


def scale_for(campaign: Campaign) -> Scale:
    """By what typical sizes of effects differ from those of the catalogue on the rig of a campaign."""
    return campaign.rig.scale


def sized_model(model: Model, campaign: Campaign) -> Model:
    """A model whose effects have the typical sizes and bounds of a campaign's rig; its values stay."""
    scale = scale_for(campaign)
    return replace(model, terms=tuple(replace(t, effect=sized(t.effect, scale)) for t in model.terms))


@dataclass(frozen=True)
class Known:
    """Effects by name, and the file of each that is the user's own."""

    effects: Mapping[str, Effect]
    files: Mapping[str, Path]

    def sized(self, campaign: Campaign) -> Known:
        """The same effects with the typical sizes and bounds of a campaign's rig."""
        return Known(all_sized(self.effects, scale_for(campaign)), self.files)

    def files_of(self, names: Iterable[str]) -> tuple[Path, ...]:
        """The user's files that define any of these effects, at whatever parts."""
        of = (name.partition("@")[0] for name in names)
        return tuple(dict.fromkeys(self.files[name] for name in of if name in self.files))


def known_effects(files: Iterable[Path] = (), beside: Known | None = None) -> Known:
    """The catalogue, or what is known already, and the effects of the user's files. A file is run as Python.

    InputError for a file that defines none, or one of a name that is taken.
    """
    known = beside or Known(catalogue(), {})
    for path in dict.fromkeys(Path(file).resolve() for file in files):
        if path in known.files.values():
            continue
        found = _user_effects(path, known)
        known = Known({**known.effects, **found}, {**known.files, **dict.fromkeys(found, path)})
    return known


def _user_effects(path: Path, known: Known) -> dict[str, Effect]:
    if not path.is_file():
        raise InputError(f"{path}: is no file, allowed is a Python file with a class of an effect")
    try:
        found = from_file(path)
    except ValueError as error:
        raise InputError(str(error)) from error
    for name in found:
        if name in known.effects:
            raise InputError(f"{path}: defines {name}, which is taken, allowed is a name of its own")
    return found


def named_effects(names: Sequence[str], known: Mapping[str, Effect]) -> list[Effect]:
    """The effects of these names, in order; InputError for one that is unknown or named twice."""
    for k, name in enumerate(names):
        if effect_named(name, known) is None:
            raise InputError(f"effect {name!r} is unknown, {unknown_name(name, known)}")
        if name in names[:k]:
            raise InputError(f"effect {name} is named twice, allowed is each once")
    every = (effect_named(name, known) for name in names)
    return [effect for effect in every if effect is not None]


def columns_read(campaign: Campaign) -> tuple[str, ...]:
    """Columns of which there are readings, in the order of the channels."""
    there: set[int] = set()
    for test in campaign.tests:
        there |= set(np.flatnonzero(np.isfinite(test.data.readings).any(axis=0)).tolist())
    return tuple(name for k, name in enumerate(channel_columns(campaign.gauges)) if k in there)


def check_suitable(effects: Iterable[Effect], campaign: Campaign) -> None:
    """InputError for an effect that a rig of the campaign cannot have, or whose input was never measured."""
    warm = any(test.data.temperature is not None for test in campaign.tests)
    read = columns_read(campaign)
    for effect in effects:
        if isinstance(effect, SensorFault) and not set(effect.columns) <= set(read):
            site = effect.example
            raise InputError(
                f"{campaign.name}: {effect.name} needs a sensor that was read, write {effect.kind}@{site} with any of "
                f"{', '.join(read)}"
            )
        for rig in {id(test.rig): test.rig for test in campaign.tests}.values():
            plain = rig.mechanism(campaign.gauges)
            try:
                # A mechanism may build its bars only when they are asked for.
                drives = layout(effect.apply(plain, effect.typicals)).drives
                refusal = effect.refusal(plain.view)
            except ValueError as error:
                raise InputError(f"{campaign.name}: {error}") from error
            except Exception as error:
                # A user's own effect may fail in any way: that is bad input, not a failure of the program.
                said = f"{type(error).__name__}: {error}"
                raise InputError(f"{effect.name} cannot be applied to the rig: {said}") from error
            if refusal:
                raise InputError(f"{campaign.name}: {refusal}")
            if not warm and DRIVE in drives:
                raise InputError(
                    f"{campaign.name}: {effect.name} needs temperatures, none was measured, "
                    "allowed with the column temperature_C"
                )
