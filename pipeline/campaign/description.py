"""campaign.toml: text in; rig, noise, gauges and the head of each test out."""

import tomllib
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, TypeAdapter, ValidationError

from pipeline.campaign.control import controls
from pipeline.campaign.head import Description, Draft, Head
from pipeline.campaign.manipulator_table import ManipulatorTable, reached
from pipeline.campaign.mapped.sources import Sources
from pipeline.campaign.model import Gauge, Rig, Vector
from pipeline.campaign.names import (
    DISPLACEMENT,
    FORCE,
    KEYS,
    SUPPORT,
    gauge_column,
    known_columns,
    wrong_column,
)
from pipeline.campaign.tables import GaugeTable, RigTable, TestTable, Top
from pipeline.errors import InputError
from pipeline.toml.complaints import Complaints, shown
from pipeline.toml.fields import Sigma, sentences
from pipeline.toml.lines import TomlLines
from vjm.mechanisms.bar import Tip

Raw = dict[str, Any]
Model = TypeVar("Model", bound=BaseModel)
Path = tuple[str | int, ...]


def describe(text: str, complaints: Complaints, folder: FilePath | None = None) -> Draft:
    """What a TOML text says, with every complaint about it. folder: of files that it names.

    BadCampaign for a text of which nothing can be said.
    """
    reader = _Reader(text, complaints, folder)
    top = reader.top()
    rig = reader.rig(top.rig)
    gauges = reader.gauges(top.gauges, rig)
    noise = reader.noise(top.noise)
    heads = reader.heads(top.tests, top.rig, rig)
    sources = Sources(reader.raw, reader.gauge_names, reader.checked, reader.say).found()
    names = tuple(reader.gauge_names)
    if rig is None or complaints.found:
        return Draft(None, names, sources)
    return Draft(Description(top.name, rig, noise, gauges, heads, sources), names, sources)


class _Reader:
    """Checks one section after the other, so that a mistake in one hides none in another."""

    def __init__(self, text: str, complaints: Complaints, folder: FilePath | None) -> None:
        self.complaints, self.folder = complaints, folder
        self.lines = TomlLines(text.replace("\r\n", "\n"))
        try:
            self.raw: Raw = tomllib.loads(text)
        except (ValueError, RecursionError) as error:
            said = str(error) or "too deeply nested"
            complaints.add("", f"is no TOML: {said}")
            complaints.check()
        self.gauge_names: list[str] = []
        self.postures: dict[Vector, Rig] = {}

    def top(self) -> Top:
        version = self.raw.get("schema", 1)
        if type(version) is int and version != 1:
            self.say(("schema",), f"is {shown(version)}, allowed is 1")
            self.complaints.check()
        top = self.checked(Top, self.raw, (), "")
        if top is None:
            self.complaints.check()
            raise AssertionError("a table that cannot be used has raised a complaint")
        return top

    def rig(self, raw: Raw) -> Rig | None:
        if raw.get("kind") == "manipulator":
            return self._manipulator(raw)
        table = self.checked(RigTable, raw, ("rig",), "rig")
        return None if table is None else table.rig()

    def _manipulator(self, raw: Raw) -> Rig | None:
        described = self.checked(ManipulatorTable, raw, ("rig",), "rig")
        try:
            return None if described is None else described.rig(self.folder)
        except InputError as error:
            for said in str(error).splitlines():
                self.say(("rig", "file"), said, "rig.file")
        return None

    def gauges(self, raw: list[Raw], rig: Rig | None) -> tuple[Gauge, ...]:
        gauges: list[Gauge] = []
        # A gauge that is refused for another reason still has its name and its column.
        self.gauge_names = list(dict.fromkeys(str(g["name"]) for g in raw if isinstance(g.get("name"), str)))
        for k, entry in enumerate(raw):
            name = entry.get("name")
            place = f"gauge {shown(name)}" if isinstance(name, str) else f"gauges.{k}"
            table = self.checked(GaugeTable, entry, ("gauges", k), place)
            if table is None:
                continue
            if table.name in (gauge.name for gauge in gauges):
                self.say(("gauges", k, "name"), "is there twice, allowed is each name once", place)
            elif gauge_column(table.name) in known_columns(()) or table.name in (
                DISPLACEMENT,
                FORCE,
                SUPPORT,
            ):
                self.say(("gauges", k, "name"), "is taken, allowed is a name of its own", place)
            elif rig is not None and rig.kind == "manipulator":
                self.say(("gauges", k), "is on a manipulator, whose campaigns have no gauges yet", place)
            elif rig is not None and rig.kind == "bar" and table.bar == 2:
                self.say(("gauges", k, "bar"), f"bar is {table.bar}, a rig of one bar allows 1", place)
            else:
                gauges.append(table.gauge())
        return tuple(gauges)

    def noise(self, raw: Raw) -> dict[str, float]:
        known = known_columns(self.gauge_names)
        adapter: TypeAdapter[float] = TypeAdapter(Sigma)
        noise = {}
        for column, value in raw.items():
            path = ("noise", column)
            if column not in known or column in KEYS:
                self.say(path, wrong_column(column, known), f"noise.{shown(column)[1:-1]}")
                continue
            try:
                noise[column] = adapter.validate_python(value)
            except ValidationError as error:
                for _, said in sentences(error, Top):
                    self.say(path, said, f"noise.{column}")
        return noise

    def heads(self, raw: list[Raw], base: Raw, rig: Rig | None) -> tuple[Head, ...]:
        heads: list[Head] = []
        seen: set[str] = set()
        for k, entry in enumerate(raw):
            name = entry.get("id")
            place = f"test {shown(name)}" if isinstance(name, str) else f"tests.{k}"
            if isinstance(name, str) and name in seen:
                self.say(("tests", k, "id"), "is there twice, allowed is each id once", place)
            seen.add(str(name))
            table = self.checked(TestTable, entry, ("tests", k), place)
            if table is None:
                continue
            own = _stand_in(base) if rig is None else self._own_rig(table, base, rig, ("tests", k), place)
            if own is not None:
                heads.append(self._head(table, own, ("tests", k), place))
        if all(entry.get("role") == "holdout" for entry in raw):
            self.say(("tests", 0), 'no test has role = "fit", allowed are one or more', "tests")
        return tuple(heads)

    def _head(self, table: TestTable, rig: Rig, path: Path, place: str) -> Head:
        if rig.kind == "parallelogram" and table.q_deg is None:
            self.say(path, "q_deg is missing, a parallelogram needs it", place)
        rig = self._posture(table, rig, path, place)
        if rig.kind == "bar" and table.q_deg:
            said = f"q_deg is {shown(table.q_deg)}, a bar lies along x and allows 0"
            self.say((*path, "q_deg"), said, place)
        held, mistakes = controls(table.control, rig, self.gauge_names)
        for said in mistakes:
            self.say((*path, "control"), said, f"{place}, control")
        line = self.lines.of(*path)
        return Head(table.id, table.q_deg or 0.0, table.role, held, table.zero, rig, line)

    def _posture(self, table: TestTable, rig: Rig, path: Path, place: str) -> Rig:
        """The rig with its manipulator at the point of the test; the same object for tests at the same point."""
        if rig.kind != "manipulator":
            if table.at_mm is not None:
                self.say((*path, "at_mm"), 'at_mm is given, allowed only with kind = "manipulator"', place)
            return rig
        if table.q_deg is not None:
            self.say((*path, "q_deg"), "q_deg is given, a manipulator has at_mm instead", place)
        if table.at_mm is None:
            # The table may have it as columns.
            return rig
        if rig.manipulator is not None and (why := reached(rig, table.at_mm)):
            self.say((*path, "at_mm"), f"is {list(table.at_mm)}: {why}", f"{place}, at_mm")
        return self.postures.setdefault(table.at_mm, replace(rig, point=table.at_mm))

    def _own_rig(self, table: TestTable, base: Raw, rig: Rig, path: Path, place: str) -> Rig | None:
        """The rig of the campaign with the values of this test."""
        own = table.rig
        if not own:
            return rig
        if rig.kind == "manipulator":
            said = "is given, tests of a manipulator differ in at_mm only"
            self.say((*path, "rig"), said, f"{place}, rig")
            return None
        where, place = (*path, "rig"), f"{place}, rig"
        if own.get("kind", rig.kind) != rig.kind:
            self.say(where, f"kind is {shown(own['kind'])}, a test keeps that of the campaign", place)
            return None
        raw = dict(base)
        if {"bar", "bar_stiffness", "section"} & set(own):
            for key in ("bar", "bar_stiffness", "section", *(() if "section" in own else ("material",))):
                raw.pop(key, None)
        raw |= own
        stretched = own.get("length_mm", rig.length) != rig.length
        if stretched and "bar_stiffness" in raw and "bar_stiffness" not in own:
            said = "length_mm is overridden, allowed only where the bar is given by bar: a 6x6 has its length"
            self.say(where, said, place)
            return None
        merged = self.checked(RigTable, raw, where, place)
        return None if merged is None else merged.rig()

    def checked(self, model: type[Model], raw: Raw, path: Path, place: str) -> Model | None:
        """The table; None, with complaints, where it is none."""
        try:
            return model.model_validate(raw)
        except ValidationError as error:
            for loc, said in sentences(error, model):
                key = ".".join(shown(step)[1:-1] if isinstance(step, str) else str(step) for step in loc)
                dot = "." if place == "rig" or place.startswith(("gauges.", "tests.")) else ", "
                self.say((*path, *loc), said, dot.join(filter(None, [place, key])))
        return None

    def say(self, path: Path, said: str, place: str | None = None) -> None:
        """A complaint about a key. place: how it is named, default the key itself."""
        where = ".".join(map(str, path)) if place is None else place
        self.complaints.add(where, said, self.lines.of(*path))


def _stand_in(raw: Raw) -> Rig:
    """A rig to judge the control of a test by, where that of the campaign has mistakes of its own."""
    if raw.get("kind") == "manipulator":
        return Rig("manipulator", 1.0)
    if raw.get("kind") != "bar":
        return Rig("parallelogram", 1.0)
    tips: dict[str, Tip] = {tip: tip for tip in get_args(Tip)}
    return Rig("bar", 1.0, tip=tips.get(str(raw.get("tip")), "free"))
