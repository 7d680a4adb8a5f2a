"""Reads model.toml: a model, or every complaint about the file as a sentence with its line."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, ValidationError

from pipeline.campaign import Rig
from pipeline.errors import InputError, unread
from pipeline.inference.model import Model, Term
from pipeline.inference.model_file import BASE, SCHEMA, ModelFile, Uncertainty
from pipeline.inference.suitable import Known, known_effects
from pipeline.parameter_names import path_of
from pipeline.toml.complaints import Complaints, shown
from pipeline.toml.fields import Table, sentences
from pipeline.toml.lines import TomlLines, parsed
from pipeline.toml.spelling import unknown_name
from vjm.effects import effect_named
from vjm.effects.base import Effect, Parameter
from vjm.tolerances import tolerances

Number = Annotated[float, Field(strict=True)]


class _Source(Table):
    campaign: str = ""
    """Name of the campaign."""
    commit: str = ""
    """Commit of the program."""
    versions: dict[str, str] = Field(default_factory=dict)
    """Versions of the program and its libraries."""


class _Error(Table):
    std: Number | None = None
    """Standard error."""
    low95: Number | None = None
    """Lower end of the 95 % interval."""
    high95: Number | None = None
    """Upper end of the 95 % interval."""


class _Effect(Table):
    name: str
    """Name of the effect, as in the catalogue."""
    values: dict[str, Any] = Field(default_factory=dict)
    """Value of each parameter, in its unit."""
    errors: dict[str, _Error] = Field(default_factory=dict)
    """What is known of each value; for information."""


class _Top(Table):
    schema_version: Annotated[int, Field(alias="schema", strict=True)]
    """Version of this format; it is 1."""
    base: Literal["vjm"]
    """What the effects are added to: the plain virtual-joint model."""
    effects_from: list[str] = Field(default_factory=list)
    """Python files with effects of the user's own, from the folder of this file."""
    fixed: list[str] = Field(default_factory=list)
    """Parameters effect.parameter that a fit leaves alone."""
    source: Annotated[_Source, Field(alias="from")] = _Source()
    """What made the file; for information."""
    nominals: dict[str, dict[str, Any]] = Field(default_factory=dict)
    """What was written about the rig, by tolerance and parameter, as it fits best beside these effects."""
    effects: list[dict[str, Any]] = Field(default_factory=list)
    """The effects, one table each, in order."""


Kind = Rig | type[Rig]


def read_model_file(path: Path, known: Known | None = None, rig: Kind | None = None) -> ModelFile:
    """The model in a file with what it says of itself. known: default the catalogue. rig: what it is for, or its class.

    BadCampaign, an InputError, names file, line and key, what was found and what is allowed, for every mistake.
    """
    return _Reader(_text(path), path, Complaints(str(path))).read(known, rig)


def _text(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8-sig").replace("\r\n", "\n")
    except OSError as error:
        raise InputError(f"{path}: {unread(error)}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: is no UTF-8, allowed is text in UTF-8") from error


class _Reader:
    """Checks one effect after the other, so that a mistake in one hides none in another."""

    def __init__(self, text: str, path: Path, complaints: Complaints) -> None:
        self.text, self.path, self.complaints, self.lines = text, path, complaints, TomlLines(text)
        try:
            self.raw: dict[str, Any] = parsed(text)
        except ValueError as error:
            complaints.add("", f"is no TOML: {error}")
            complaints.check()

    def read(self, known: Known | None, rig: Kind | None) -> ModelFile:
        top = self.top()
        folder = self.path.parent
        known = known_effects((folder / file for file in top.effects_from), known)
        terms: list[Term] = []
        uncertainty: dict[str, Uncertainty] = {}
        for k, entry in enumerate(top.effects):
            if (table := self.effect_table(entry, k)) is None:
                continue
            effect = self.effect(table.name, k, known, [t.effect.name for t in terms], rig)
            if effect is None:
                continue
            values = {p.name: self.value(effect, p, table, k) for p in effect.parameters}
            self.strangers(effect, table, k)
            terms.append(Term(effect, values))
            for name, it in table.errors.items():
                uncertainty[path_of(effect.name, name)] = Uncertainty(it.std, it.low95, it.high95)
        fixed = self.fixed(top.fixed, terms)
        nominals = tuple(self.nominals(top.nominals))
        self.complaints.check()
        model, source = Model(tuple(terms), fixed, nominals), top.source
        files = known.files_of(model.names)
        return ModelFile(model, uncertainty, files, source.campaign, source.commit, source.versions)

    def top(self) -> _Top:
        version = self.raw.get("schema")
        if type(version) is int and version != SCHEMA:
            self.say(("schema",), "schema", f"is {shown(version)}, allowed is {SCHEMA}")
            self.complaints.check()
        try:
            return _Top.model_validate(self.raw)
        except ValidationError as error:
            for loc, said in sentences(error, _Top):
                self.say(loc, ".".join(map(str, loc)), said)
        self.complaints.check()
        raise AssertionError(f"a table that is not {BASE} has raised a complaint")

    def effect_table(self, entry: dict[str, Any], k: int) -> _Effect | None:
        try:
            return _Effect.model_validate(entry)
        except ValidationError as error:
            for loc, said in sentences(error, _Effect):
                self.say(("effects", k, *loc), f"{_place(entry, k)}, {'.'.join(map(str, loc))}", said)
        return None

    def effect(self, name: str, k: int, known: Known, before: list[str], rig: Kind | None) -> Effect | None:
        effect, said = effect_named(name, known.effects), ""
        if effect is None:
            said = f"is unknown, {unknown_name(name, known.effects)}"
        elif name in before:
            said = "is there twice, allowed is each effect once"
        elif rig is not None and not {rig.acted_on, rig.kind} & set(effect.kinds):
            said = f"needs a rig of kind {' or '.join(effect.kinds)}, not {rig.kind}"
        if said:
            self.say(("effects", k, "name"), f"effect {shown(name)}", said)
            return None
        return effect

    def value(self, effect: Effect, p: Parameter, table: _Effect, k: int) -> float:
        """The value of a parameter; its null where there is a complaint."""
        place = f"effect {effect.name}, {p.name}"
        if p.name not in table.values:
            self.say(("effects", k, "name"), place, f"is missing, allowed is a number in {p.unit}")
            return p.null
        found = table.values[p.name]
        if not _is_number(found):
            said = f"is {shown(found)}, allowed is a number in {p.unit}"
        elif not p.low <= found <= p.high:
            said = f"is {found:g} {p.unit}, allowed is {p.low:g} to {p.high:g}"
        else:
            return float(found)
        self.complaints.add(place, said, self.line(k, p.name))
        return p.null

    def strangers(self, effect: Effect, table: _Effect, k: int) -> None:
        """Complaints about names that are no parameters of the effect."""
        names = [p.name for p in effect.parameters]
        for part, found in (("values", table.values), ("errors", table.errors)):
            for name in found:
                if name not in names:
                    said = f"is no parameter of {effect.name}, {unknown_name(name, names)}"
                    self.complaints.add(f"effect {effect.name}, {part}.{name}", said, self.line(k, name))

    def nominals(self, tables: Mapping[str, Mapping[str, Any]]) -> Iterator[Term]:
        """What was written about the rig, where it fitted best."""
        known = {it.name: it for it in tolerances()}
        for name, table in tables.items():
            if name not in known:
                said = f"is unknown, {unknown_name(name, known)}"
                self.say(("nominals", name), f"nominals.{name}", said)
                continue
            values = known[name].nulls
            for key, found in table.items():
                p = next((p for p in known[name].parameters if p.name == key), None)
                said = ""
                if p is None:
                    said = f"is unknown, {unknown_name(key, values)}"
                elif not _is_number(found) or not p.low <= found <= p.high:
                    said = f"is {shown(found)}, allowed is {p.low:g} to {p.high:g} {p.unit}"
                if said:
                    self.say(("nominals", name, key), f"nominals.{name}, {key}", said)
                else:
                    values[key] = float(found)
            yield Term(known[name], values)

    def fixed(self, found: list[str], terms: list[Term]) -> frozenset[str]:
        names = [path_of(term.effect.name, p.name) for term in terms for p in term.effect.parameters]
        # Where an effect has been refused its parameters are not judged as well.
        refused = len(terms) < len(self.raw.get("effects", []))
        for name in found if not refused else []:
            if name not in names:
                self.say(("fixed",), f"fixed, {shown(name)}", f"is unknown, {unknown_name(name, names)}")
        return frozenset(found)

    def say(self, path: tuple[str | int, ...], place: str, said: str) -> None:
        self.complaints.add(place, said, self.lines.of(*path))

    def line(self, k: int, name: str) -> int | None:
        """Of a parameter of effect k, where it is written in the plain way, else of the effect."""
        start = self.lines.of("effects", k)
        key = re.compile(rf"\s*{re.escape(name)}\s*=")
        below = self.text.split("\n")[start or 0 :]
        return next((n for n, line in enumerate(below, (start or 0) + 1) if key.match(line)), start)


def _is_number(found: object) -> bool:
    return isinstance(found, int | float) and not isinstance(found, bool) and bool(np.isfinite(found))


def _place(entry: dict[str, Any], k: int) -> str:
    name = entry.get("name")
    return f"effect {shown(name)}" if isinstance(name, str) else f"effects.{k}"
