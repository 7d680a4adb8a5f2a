"""`export` from the command line: a campaign or a result in, files of another program out."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from pathlib import Path

from rich.markup import escape

from meshes.files import replacing
from pipeline.command import usable
from pipeline.errors import InputError
from pipeline.export.content import Export
from pipeline.export.formats import module_of, names
from pipeline.export.source import Sources, exported
from pipeline.terminal import terminal


def export(asked: Sources, to: str, out: Path, quiet: bool = False) -> tuple[Path, ...]:
    """Write, and say what was written, in which units, and what the format cannot hold; returns the files.

    InputError for a source, a format or a place that cannot be used; nothing is written then.
    """
    files, it = written(asked, to, out)
    form = module_of(to)
    console = terminal()
    for path in files:
        console.print(escape(f"{path}: written"))
    if not quiet:
        springs = it.springs if form.ONE else (*it.bars, *(each.whole for each in it.linkages))
        for said in (*(each.what for each in springs), form.UNITS, *form.lost(it)):
            console.print(escape(f"- {said}"))
        if form.ONE and it.linkages and not it.chosen:
            console.print("- --q DEG writes the parallelogram at this angle instead of its bar.")
    return tuple(files)


def written(asked: Sources, to: str, out: Path) -> tuple[Mapping[Path, bytes], Export]:
    """Write, and nothing else; returns the files and what is in them. InputError as of `export`."""
    if to not in names():
        near = difflib.get_close_matches(to, names(), 1)
        hint = f"; did you mean {near[0]}?" if near else ""
        raise InputError(f"--to is {to!r}, allowed are {', '.join(names())}{hint}")
    usable(out.parent, f"the folder of {out}")
    if out.is_dir():
        raise InputError(f"{out} is a folder, allowed is the name of a file")
    it = exported(asked)
    files = module_of(to).files(it, out)
    _spared(files)
    for path, content in files.items():
        with replacing(path) as part:
            part.write_bytes(content)
    return files, it


def _spared(files: Mapping[Path, bytes]) -> None:
    """InputError for a file that is there already and holds something else."""
    for path, content in files.items():
        if path.exists() and (path.is_dir() or path.read_bytes() != content):
            raise InputError(f"{path} is there already and holds something else, allowed is a new name")
