"""Formats of exported files: every module beside this one is one, under its own name, and is found by itself.

Each has `UNITS`, a sentence; `ONE`, whether it holds the bar or one linkage, not all at once; `files`, from what is
exported and the path that was asked for to the bytes of every file; `lost`, what it cannot hold, a sentence each.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import TYPE_CHECKING, Protocol, cast

if TYPE_CHECKING:
    # The command line asks for the names alone; numpy is not needed for that.
    from pipeline.export.content import Export


class Format(Protocol):
    """What a module of a format has."""

    UNITS: str
    ONE: bool

    def files(self, it: Export, out: Path) -> dict[Path, bytes]:
        """The bytes of every file."""
        ...

    def lost(self, it: Export) -> tuple[str, ...]:
        """What the format cannot hold."""
        ...


def names() -> tuple[str, ...]:
    """Names of all formats; none of them is imported."""
    return tuple(sorted(info.name for info in iter_modules(__path__)))


def module_of(name: str) -> Format:
    """The module of a format."""
    return cast(Format, import_module(f"{__name__}.{name}"))
