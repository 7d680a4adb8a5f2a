"""Formats of files: every module beside this one that says its suffixes is one, and is found by itself."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from types import ModuleType

from pipeline.campaign.mapped.grid import BadTable, Grid
from pipeline.campaign.mapped.schema import FileTable


def by_suffix() -> dict[str, ModuleType]:
    """The module of each suffix, in small letters; each has `SUFFIXES` and `read`."""
    modules = (import_module(f"{__name__}.{info.name}") for info in iter_modules(__path__))
    return {suffix: module for module in modules for suffix in module.SUFFIXES}


def grids(path: Path, how: FileTable) -> tuple[Grid, ...]:
    """The tables in a file. BadTable where it cannot be read as one, OSError where it is not there."""
    known = by_suffix()
    module = known.get(path.suffix.lower())
    if module is None:
        raise BadTable(f"has the ending {path.suffix or 'none'}, allowed are {', '.join(sorted(known))}")
    # A format's own library says in its own words that there is no file, if it says it at all.
    path.stat()
    found: tuple[Grid, ...] = module.read(path, how)
    return found
