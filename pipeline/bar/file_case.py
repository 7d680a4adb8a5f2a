"""A case whose bar is a file, from TOML or from options of the command line."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from pipeline.bar.tables import FileCase
from pipeline.errors import InputError
from pipeline.toml.complaints import Complaints
from pipeline.toml.lines import TomlLines, parsed
from pipeline.validation.case import complaint

STEEL = "E_MPa = 210000.0, nu = 0.3"


def names_a_file(path: Path) -> bool:
    """Whether a case's bar is a file; a text that is no TOML is not, and is told about where cases are read."""
    try:
        raw = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, RecursionError):
        return False
    return isinstance(raw.get("bar"), dict) and "file" in raw["bar"]


def file_case(path: Path) -> FileCase:
    """The case in a TOML file; InputError says all that is wrong, with lines."""
    text = path.read_text(encoding="utf-8-sig")
    return _checked(parsed(text), str(path), TomlLines(text.replace("\r\n", "\n")))


def case_of_options(path: Path, options: Mapping[str, Any]) -> FileCase:
    """The case that options describe: unit, base, tip, y, tie, E, nu, size; InputError where one cannot be."""
    given = {key: value for key, value in options.items() if value is not None}
    if not {"E", "nu"} <= set(given):
        raise InputError(
            f"{path}: its material is not said; add --E and --nu, or write a case with "
            f'[material] {STEEL} and [bar] file = "{path.name}"'
        )
    bar: dict[str, Any] = {"file": path.name, "tie": given.get("tie", "rigid")}
    bar |= {"unit": given["unit"]} if "unit" in given else {}
    for key in ("base", "tip", "y"):
        if key in given:
            try:
                bar[key] = tomllib.loads(f"it = {given[key]}")["it"]
            except tomllib.TOMLDecodeError as error:
                raise InputError(f"--{key} is {given[key]!r}, allowed is a line as it is listed") from error
    name = "".join(c if c.isalnum() and c.isascii() else "-" for c in path.stem).strip("-") or "bar"
    raw = {
        "schema": 1,
        "name": name,
        "title": path.name,
        "material": {"E_MPa": given["E"], "nu": given["nu"], "source": "command line"},
        "bar": bar,
        "mesh": {"size_mm": given["size"]} if "size" in given else {},
    }
    return _checked(raw, str(path), TomlLines(""))


def _checked(raw: dict[str, Any], named: str, lines: TomlLines) -> FileCase:
    complaints = Complaints(named)
    try:
        return FileCase.model_validate(raw)
    except ValidationError as error:
        for mistake in error.errors():
            place = tuple(mistake["loc"])
            complaints.add("", complaint(mistake, FileCase), _line(lines, place))
    complaints.check()
    raise AssertionError("a case that cannot be used has raised a complaint")


def _line(lines: TomlLines, place: tuple[str | int, ...]) -> int | None:
    return lines.of(*place[:2]) if place else None
