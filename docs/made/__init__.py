"""What of the documentation is generated: a mark `<!-- made: NAME -->` in a page is replaced by the text of that name.

A line that says that a page is a source, for those who read it as one, is left out.

Every module beside this one that has `PIECES` belongs to it: texts in MyST Markdown by the names in the marks.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

Piece = Callable[[], str]
_MARK = re.compile(r"<!-- made: (?P<name>.+?) -->")
_SOURCE = re.compile(r"^> This is the source of a page.*\n(>.*\n)*\n", re.MULTILINE)


@cache
def pieces() -> Mapping[str, Piece]:
    """Every text that can be made, by its name. ValueError for a name that two modules have."""
    out: dict[str, Piece] = {}
    for info in iter_modules(__path__):
        for name, piece in getattr(import_module(f"{__name__}.{info.name}"), "PIECES", {}).items():
            if name in out:
                raise ValueError(f"{name!r} is made twice, allowed is one module for each name")
            out[name] = piece
    return out


def expanded(page: str) -> str:
    """A page with its marks replaced. ValueError for a name that no module makes."""
    return _MARK.sub(_made, _SOURCE.sub("", page))


def _made(mark: re.Match[str]) -> str:
    piece = pieces().get(mark["name"])
    if piece is None:
        raise ValueError(f"nothing is made for {mark['name']!r}, allowed are {', '.join(sorted(pieces()))}")
    return piece()


def _on_source_read(app: Any, page: str, source: list[str]) -> None:
    source[0] = expanded(source[0])


def setup(app: Any) -> dict[str, bool]:
    """As Sphinx calls an extension."""
    app.connect("source-read", _on_source_read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
