"""A validation case: TOML in, frozen Case out; all complaints at once, each with file, line, key, found and allowed."""

from copy import deepcopy
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from meshes.resolution import Resolution
from meshes.workable import require_workable
from pipeline.errors import InputError
from pipeline.toml.complaints import Complaints
from pipeline.toml.lines import TomlLines, parsed
from pipeline.toml.nested import unknown_key
from pipeline.validation.case_tables import BarChoice, Case, LinkageSize, MeshSize
from pipeline.validation.geometry import bar_of, contradictions, height_of, overlapping

__all__ = ["SHIPPED", "Case", "load_case", "shipped_cases"]

SHIPPED = Path(__file__).parent / "cases"
TOML_NAMES: dict[type, str] = {dict: "table", list: "list", tuple: "list"}
TAGS = ("i_section", "rectangle", "round", "tube")
"""What pydantic puts into the place of a mistake in a section beside its keys."""

Table = TypeVar("Table", bound=BaseModel)


def shipped_cases() -> list[str]:
    """Names of the cases that come with the project."""
    return sorted(path.stem for path in SHIPPED.glob("*.toml"))


def load_case(name: str, finest: int = 1) -> Case:
    """The shipped case of this name, or the case in the TOML file at this path; InputError says all that is wrong.

    `finest` is the level of the finest mesh that will be made of it.
    """
    path = SHIPPED / f"{name}.toml" if name in shipped_cases() else Path(name)
    if path.is_dir():
        raise InputError(f"case {name!r} is a folder, allowed is the path of a .toml file")
    if path.suffix != ".toml" or not path.is_file():
        allowed = ", ".join(shipped_cases())
        raise InputError(f"case {name!r} is unknown, allowed are {allowed} or the path of a .toml file")
    try:
        text = path.read_text(encoding="utf-8-sig")
        raw = parsed(text)
    except (ValueError, OSError) as error:
        raise InputError(f"{path}: not a readable TOML file: {error}") from error
    if isinstance(raw.get("bar"), dict) and "file" in raw["bar"]:
        raise InputError(
            f"{path}: its bar is a file, which the command bar takes; allowed here is a bar with a section"
        )
    reader = _Reader(raw, text, Complaints(str(path)))
    case = reader.case()
    reader.together(finest)
    reader.complaints.check()
    if case is None:
        raise AssertionError("a case that cannot be used has raised a complaint")
    return case


class _Reader:
    """Checks every table, and then what has to go together of those that are right by themselves."""

    def __init__(self, raw: dict[str, Any], text: str, complaints: Complaints) -> None:
        self.raw, self.complaints = raw, complaints
        self.lines = TomlLines(text.replace("\r\n", "\n"))

    def case(self) -> Case | None:
        """The case, or None after a complaint."""
        try:
            return Case.model_validate(self.raw)
        except ValidationError as error:
            for mistake in error.errors():
                path = tuple(step for step in mistake["loc"] if step not in TAGS)
                self._say(path, complaint(mistake, Case))
        return None

    def together(self, finest: int) -> None:
        """Complaints about dimensions that contradict each other, and about a mesh that cannot be made of them."""
        linkage, bar = self._table(LinkageSize, "linkage"), self._table(BarChoice, "bar")
        if linkage is None or bar is None or bar.section is None:
            return
        mistakes = contradictions(bar, linkage.length_mm)
        for key, said in mistakes:
            self._say(("bar", key), said)
        if said := overlapping(linkage.width_mm, linkage.angles_deg, height_of(bar)):
            self._say(("linkage", "width_mm"), said)
        mesh = self._table(MeshSize, "mesh")
        if mistakes or mesh is None:
            return
        try:
            require_workable(bar_of(bar, linkage.length_mm), Resolution(mesh.size_mm, finest))
        except ValueError as error:
            self._say(("mesh", "size_mm"), f"mesh: {error}")

    def _table(self, kind: type[Table], name: str) -> Table | None:
        """A table without its unknown keys, of which `case` complains; None where anything else is wrong with it."""
        raw = deepcopy(self.raw.get(name, {}))
        try:
            return kind.model_validate(raw)
        except ValidationError as error:
            mistakes = error.errors()
        if any(mistake["type"] != "extra_forbidden" for mistake in mistakes):
            return None
        for mistake in mistakes:
            *above, key = (step for step in mistake["loc"] if step not in TAGS)
            table = raw
            for step in above:
                table = table[step]
            del table[key]
        try:
            return kind.model_validate(raw)
        except ValidationError:
            return None

    def _say(self, path: tuple[str | int, ...], said: str) -> None:
        self.complaints.add("", said, self._line(path))

    def _line(self, path: tuple[str | int, ...]) -> int | None:
        """Line of a key, whether its table has a header of its own, [bar.section], or stands in a line."""
        for length in range(len(path), 0, -1):
            header = ".".join(map(str, path[:length]))
            if (line := self.lines.of(header, *path[length:])) is not None:
                return line
        return None


def complaint(error: Any, model: type[BaseModel]) -> str:
    """One of pydantic's complaints about a model as place, what was found, what is allowed."""
    place = ".".join(str(step) for step in error["loc"] if step not in TAGS)
    kind = error["type"]
    if kind == "missing":
        return f"{place} is missing"
    if kind == "extra_forbidden":
        return f"{place} {unknown_key(model, error['loc'])}"
    message = error["msg"].removeprefix("Value error, ")
    found = error["input"]
    shown = (
        repr(found) if isinstance(found, int | float | str) else f"a {TOML_NAMES.get(type(found), 'value')}"
    )
    if kind == "union_tag_invalid":
        return f"{place}.kind is {error['ctx']['tag']!r}, allowed are: {error['ctx']['expected_tags']}"
    wanted = message[0].lower() + message[1:]
    if kind == "string_pattern_mismatch":
        wanted = "a name of letters, digits, - and _ that begins with a letter or a digit"
    if kind == "value_error":
        return f"{place}: {wanted}" if place else wanted
    wanted = wanted.removeprefix("input should be ")
    return f"{place} is {shown}, allowed is: {wanted}"
