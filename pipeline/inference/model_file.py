"""model.toml: a model of a rig that is read, edited by hand and kept with the measurements.

    schema = 1
    base = "vjm"                             # plain virtual springs (Eq. 1)
    effects_from = ["../my_effect.py"]       # the user's own effects, relative to this file; run as Python
    fixed = ["joint_friction.presliding_rad"]  # what a fit leaves alone
    [from]                                   # information
    campaign = "bench-07"
    [nominals.section]                        # what was written about the rig, where it fitted best
    ea = 1.004
    [[effects]]                              # in the order in which they are applied
    name = "joint_friction"
    [effects.values]
    torque_Nmm = 352.0                       # N·mm, ...
    [effects.errors]                         # information: the fit's, left out by hand where no longer true
    torque_Nmm = { std = 11.0, low95 = 331.0, high95 = 374.0 }

Numbers are written in full: a file that is read and written again gives the same numbers to the last bit.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import tomlkit
from tomlkit.items import InlineTable, Table

from pipeline.inference.model import Model, Term
from pipeline.inference.suitable import Known
from pipeline.parameter_names import path_of
from pipeline.provenance import commit, versions
from pipeline.saving import put

NAME = "model.toml"
SCHEMA, BASE = 1, "vjm"
HEAD = """\
A model of a rig: plain virtual springs and the effects in the order in which they are applied.
Values may be edited; errors are information from the fit, no one reads them to compute.
N, mm, rad, MPa, N·mm."""


@dataclass(frozen=True)
class Uncertainty:
    """What a fit said of a value: standard error, 95 % interval; None where the data set no end."""

    std: float | None
    low95: float | None
    high95: float | None


@dataclass(frozen=True)
class ModelFile:
    """A model with where it comes from.

    uncertainty: by name effect.parameter. effects_from: absolute paths of the user's files with effects of the
    model. campaign: name of the one that it was fitted to. commit, versions: of what fitted it.
    """

    model: Model
    uncertainty: Mapping[str, Uncertainty] = field(default_factory=dict)
    effects_from: tuple[Path, ...] = ()
    campaign: str = ""
    commit: str = ""
    versions: Mapping[str, str] = field(default_factory=dict)


def fitted_now(
    model: Model, uncertainty: Mapping[str, Uncertainty], known: Known, campaign: str
) -> ModelFile:
    """Of a model that was fitted to a campaign of that name by this program."""
    return ModelFile(model, uncertainty, known.files_of(model.names), campaign, commit(), versions())


def write_model(path: Path, it: ModelFile) -> None:
    """Write whole or not at all. InputError where nothing can be written."""
    put(path, model_text(it, path.parent))


def model_text(it: ModelFile, folder: Path) -> str:
    """The file's text; paths of effects relative to its folder."""
    document = tomlkit.document()
    for line in HEAD.splitlines():
        document.add(tomlkit.comment(line))
    document.add(tomlkit.nl())
    document["schema"] = SCHEMA
    document["base"] = BASE
    if it.effects_from:
        document["effects_from"] = [_relative(file, folder) for file in it.effects_from]
    fixed = sorted(it.model.fixed)
    document["fixed"] = fixed
    document["fixed"].comment("effect.parameter that a fit leaves alone")
    source: dict[str, Any] = {"campaign": it.campaign, "commit": it.commit, "versions": dict(it.versions)}
    source = {key: value for key, value in source.items() if value}
    if source:
        if "versions" in source:
            source["versions"] = _inline(source["versions"])
        document["from"] = source
    if it.model.nominals:
        document["nominals"] = _nominals(it.model.nominals)
    if it.model.terms:
        effects = tomlkit.aot()
        for term in it.model.terms:
            effects.append(_effect_table(term, it.uncertainty))
        document["effects"] = effects
    return tomlkit.dumps(document)


def _nominals(terms: tuple[Term, ...]) -> Table:
    tables = tomlkit.table(is_super_table=True)
    for term in terms:
        values = tomlkit.table()
        for p in term.effect.parameters:
            values.add(p.name, float(term.values[p.name]))
            values[p.name].comment(_line(f"{p.unit}, {p.meaning}"))
        tables.add(term.effect.name, values)
    return tables


def _effect_table(term: Term, uncertainty: Mapping[str, Uncertainty]) -> Table:
    effect = term.effect
    table = tomlkit.table()
    table.add("name", tomlkit.string(effect.name))
    table["name"].comment(_line(effect.title))
    if not effect.parameters:
        return table
    values, errors = tomlkit.table(), tomlkit.table()
    for p in effect.parameters:
        values.add(p.name, float(term.values[p.name]))
        values[p.name].comment(_line(f"{p.unit}, {p.meaning}"))
        known = uncertainty.get(path_of(effect.name, p.name))
        if known is not None:
            named = {"std": known.std, "low95": known.low95, "high95": known.high95}
            errors.add(p.name, _inline({key: value for key, value in named.items() if value is not None}))
    table.add("values", values)
    if len(errors):
        table.add("errors", errors)
    return table


def _line(text: str) -> str:
    """A comment of one line, whatever a user's effect says."""
    return " ".join(text.split())


def _inline(values: Mapping[str, Any]) -> InlineTable:
    table = tomlkit.inline_table()
    table.update(values)
    return table


def _relative(file: Path, folder: Path) -> str:
    """Relative where there is a way, with slashes."""
    try:
        return Path(os.path.relpath(file, folder.resolve())).as_posix()
    except ValueError:
        return file.as_posix()
