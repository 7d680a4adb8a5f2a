"""The line of a key in a TOML text, as far as it can be told at a glance."""

import re
import tomllib
from typing import Any

_HEADER = re.compile(r"\s*(\[\[?)\s*([A-Za-z0-9_.\"' -]+?)\s*\]\]?\s*(#.*)?$")
_AT = re.compile(r"\(at line (\d+), column \d+\)$")
_COMMA = re.compile(r"=\s*([+-]?\d[\d_]*),(\d+)(?=\s*(?:[,}#]|$))")
_KEY = re.compile(r'\s*(?:([A-Za-z0-9_-]+)|"((?:[^"\\]|\\.)*)")\s*[=.]')


class TomlLines:
    """Looks up lines; None where a key is not written in the plain way."""

    def __init__(self, text: str) -> None:
        self._lines: dict[tuple[str | int, ...], int] = {}
        # Inside a string of several lines anything may look like a key.
        if '"""' in text or "'''" in text:
            return
        table: tuple[str | int, ...] = ()
        counts: dict[str, int] = {}
        for number, line in enumerate(text.split("\n"), start=1):
            if header := _HEADER.match(line):
                name = header[2]
                table = (name,)
                if header[1] == "[[":
                    counts[name] = counts.get(name, -1) + 1
                    table = (name, counts[name])
                self._lines.setdefault(table, number)
            elif key := _KEY.match(line):
                self._lines.setdefault((*table, key[1] or _unescaped(key[2])), number)

    def of(self, *path: str | int) -> int | None:
        """Line, counted from 1, of the innermost part of the path that can be found."""
        for length in range(len(path), 0, -1):
            if (line := self._lines.get(path[:length])) is not None:
                return line
        return None


def _unescaped(text: str) -> str:
    """A quoted key without its backslashes, as far as these are those of quotes."""
    return text.replace('\\"', '"').replace("\\\\", "\\")


def parsed(text: str) -> dict[str, Any]:
    """The tables of a TOML text. ValueError says in one sentence why it is none, and names a decimal comma as such."""
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        raise ValueError("too deeply nested") from error
    except ValueError as error:
        raise ValueError(_decimal_comma(text, str(error)) or str(error)) from error


def _decimal_comma(text: str, said: str) -> str:
    """What to say where the line of a complaint has a number with a comma; empty where it has none."""
    place = _AT.search(said)
    if place is None:
        return ""
    number = int(place[1])
    lines = text.split("\n")
    found = _COMMA.search(lines[number - 1]) if number <= len(lines) else None
    if found is None:
        return ""
    whole, part = found.groups()
    return f"{whole},{part} has a decimal comma, allowed is a decimal point: {whole}.{part} {place[0]}"
