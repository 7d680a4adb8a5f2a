"""campaign.toml: text in; rig, noise, gauges and the head of each test out."""

from pathlib import Path as FilePath
from typing import Any, TypeVar

from pydantic import BaseModel, TypeAdapter, ValidationError

from pipeline.campaign.control import WAYS, controls
from pipeline.campaign.head import Description, Draft, Head, SensorNoise
from pipeline.campaign.mapped.sources import Sources
from pipeline.campaign.model import Cells, Gauge, Rig, Vector
from pipeline.campaign.names import KEYS, TEMPERATURE, gauge_column, known_columns, wrong_column
from pipeline.campaign.rig import distinct
from pipeline.campaign.rig_table import RigTable
from pipeline.campaign.rigs import KINDS
from pipeline.campaign.tables import GaugeTable, NoiseTable, TestTable, Top
from pipeline.campaign.tolerance import tolerance, widest
from pipeline.errors import InputError
from pipeline.toml.complaints import Complaints, shown
from pipeline.toml.fields import Sigma, sentences
from pipeline.toml.lines import TomlLines, parsed

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
    known = None if rig is None else reader.tolerance(top.tolerance, distinct(rig, *(it.rig for it in heads)))
    sources = Sources(reader.raw, reader.gauge_names, reader.checked, reader.say).found()
    names = tuple(reader.gauge_names)
    if rig is None or complaints.found:
        return Draft(None, names, sources)
    asked = tuple(dict.fromkeys(reader.questions))
    told = Description(top.name, rig, noise, gauges, heads, sources, known, asked, top.table_checked)
    return Draft(told, names, sources)


class _Reader:
    """Checks one section after the other, so that a mistake in one hides none in another."""

    def __init__(self, text: str, complaints: Complaints, folder: FilePath | None) -> None:
        self.complaints, self.folder = complaints, folder
        self.lines = TomlLines(text.replace("\r\n", "\n"))
        try:
            self.raw: Raw = parsed(text)
        except ValueError as error:
            complaints.add("", f"is no TOML: {error}")
            complaints.check()
        self.gauge_names: list[str] = []
        self.postures: dict[Vector, Rig] = {}
        self.questions: list[str] = []

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
        table = self._table(raw)
        described = None if table is None else self.checked(table, raw, ("rig",), "rig")
        return None if described is None else self._made(described, raw, ("rig",), "rig")

    def _made(self, table: RigTable, raw: Raw, path: Path, place: str) -> Rig | None:
        """The rig; None, with complaints, where a file that it names cannot be used."""
        self.questions += [f"{place}.{said}" for said in table.questions()]
        try:
            return table.rig(self.folder)
        except InputError as error:
            key = "bar_from" if "bar_from" in raw else "file"
            for said in str(error).splitlines():
                self.say((*path, key), said, f"{place}.{key}")
        return None

    def _table(self, raw: Raw) -> type[RigTable] | None:
        """The table of the kind that a rig names."""
        kind = raw.get("kind")
        if isinstance(kind, str) and kind in KINDS:
            return KINDS[kind]
        *others, last = map(repr, KINDS)
        allowed = f"allowed is: {', '.join(others)} or {last}"
        said = "is missing" if "kind" not in raw else f"is {shown(kind)}"
        self.say(("rig", "kind"), f"{said}, {allowed}", "rig.kind")
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
            elif gauge_column(table.name) in known_columns(()) or table.name in WAYS:
                self.say(("gauges", k, "name"), "is taken, allowed is a name of its own", place)
            elif rig is not None and (wrong := rig.refused(table.gauge())):
                self.say(("gauges", k, *filter(None, wrong[:1])), wrong[1], place)
            else:
                gauges.append(table.gauge())
        return tuple(gauges)

    def noise(self, raw: Raw) -> dict[str, SensorNoise]:
        known = known_columns(self.gauge_names)
        adapter: TypeAdapter[float] = TypeAdapter(Sigma)
        noise: dict[str, SensorNoise] = {}
        for column, value in raw.items():
            path = ("noise", column)
            if column not in known or column in KEYS:
                self.say(path, wrong_column(column, known), f"noise.{shown(column)[1:-1]}")
                continue
            if isinstance(value, dict) and column != TEMPERATURE:
                table = self.checked(NoiseTable, value, path, f"noise.{column}")
                noise |= {} if table is None else {column: table.noise}
                continue
            try:
                noise[column] = SensorNoise(adapter.validate_python(value))
            except ValidationError as error:
                for _, said in sentences(error, Top):
                    self.say(path, said, f"noise.{column}")
        return noise

    def tolerance(self, raw: Raw | None, rigs: tuple[Rig, ...]) -> dict[str, float] | None:
        if raw is None:
            return None
        usual = widest(rig.usual_tolerance for rig in rigs)
        return tolerance(raw, rigs[0].written, self._say_of_tolerance, usual)

    def _say_of_tolerance(self, path: tuple[str, ...], said: str) -> None:
        self.say(("tolerance", *path), said)

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
            own = (
                self._stand_in(base) if rig is None else self._own_rig(table, base, rig, ("tests", k), place)
            )
            if own is not None:
                heads.append(self._head(table, own, ("tests", k), place))
        if all(entry.get("role") == "holdout" for entry in raw):
            self.say(("tests", 0), 'no test has role = "fit", allowed are one or more', "tests")
        return tuple(heads)

    def _head(self, table: TestTable, rig: Rig, path: Path, place: str) -> Head:
        placed, mistakes = rig.placed(table.q_deg, table.at_mm)
        for key, said in mistakes:
            self.say((*path, *filter(None, [key])), said, place)
        if placed.point is not None:
            # The same object for tests at the same point.
            placed = self.postures.setdefault(placed.point, placed)
        held, wrong = controls(table.control, placed, self.gauge_names)
        for said in wrong:
            self.say((*path, "control"), said, f"{place}, control")
        line = self.lines.of(*path)
        aside, keep = (_cells(each) for each in (table.set_aside, table.keep))
        return Head(table.id, table.q_deg or 0.0, table.role, held, table.zero, placed, line, aside, keep)

    def _own_rig(self, table: TestTable, base: Raw, rig: Rig, path: Path, place: str) -> Rig | None:
        """The rig of the campaign with the values of this test."""
        own = table.rig
        if not own:
            return rig
        kind, where, place = KINDS[rig.kind], (*path, "rig"), f"{place}, rig"
        if own.get("kind", rig.kind) != rig.kind:
            self.say(where, f"kind is {shown(own['kind'])}, a test keeps that of the campaign", place)
            return None
        try:
            merged = self.checked(kind, kind.merged(base, own), where, place)
        except ValueError as error:
            self.say(where, str(error), place)
            return None
        return None if merged is None else self._made(merged, own, where, place)

    def _stand_in(self, raw: Raw) -> Rig:
        """A rig to judge the control of a test by, where that of the campaign has mistakes of its own."""
        kind = raw.get("kind")
        known = isinstance(kind, str) and kind in KINDS
        return KINDS[str(kind) if known else "parallelogram"].stand_in(raw)

    def checked(self, model: type[Model], raw: Raw, path: Path, place: str) -> Model | None:
        """The table; None, with complaints, where it is none."""
        try:
            return model.model_validate(raw)
        except ValidationError as error:
            for loc, said in sentences(error, model):
                if len(loc) == 1 and (kinds := _of_others(str(loc[0]), model)):
                    said = f"{loc[0]} is given, allowed only with kind = {kinds}"
                key = ".".join(shown(step)[1:-1] if isinstance(step, str) else str(step) for step in loc)
                dot = "." if place == "rig" or place.startswith(("gauges.", "tests.")) else ", "
                self.say((*path, *loc), said, dot.join(filter(None, [place, key])))
        return None

    def say(self, path: Path, said: str, place: str | None = None) -> None:
        """A complaint about a key. place: how it is named, default the key itself."""
        where = ".".join(map(str, path)) if place is None else place
        self.complaints.add(where, said, self.lines.of(*path))


def _cells(said: dict[str, list[int]]) -> Cells:
    return tuple((step, column) for column, steps in said.items() for step in steps)


def _of_others(key: str, model: type[BaseModel]) -> str:
    """The kinds of rig that have this key, where a table of rigs is of another that has not; else empty."""
    if model not in KINDS.values() or key in model.model_fields:
        return ""
    return " or ".join(f'"{kind}"' for kind, table in KINDS.items() if key in table.model_fields)
