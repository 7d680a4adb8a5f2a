"""A campaign that was dropped on the page: its two files, laid in a folder of their own."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from itertools import count
from pathlib import Path
from typing import Any

from pipeline.campaign.reading import DESCRIPTION, MEASUREMENTS
from pipeline.errors import InputError
from pipeline.page.command import RESULTS
from reports.files import write_bytes

Dropped = Sequence[dict[str, Any]] | None
FOLDER = RESULTS / "dropped"


def lay(files: Sequence[dict[str, Any]], below: Path = FOLDER) -> Path:
    """The folder with both files, named as the campaign. InputError where one is missing or another is there."""
    found = {str(file["name"]): bytes(file["content"]) for file in files}
    if set(found) != {DESCRIPTION, MEASUREMENTS}:
        names = ", ".join(sorted(found)) or "nothing"
        raise InputError(f"{names} was dropped, allowed are {DESCRIPTION} and {MEASUREMENTS} together")
    name = _name(found[DESCRIPTION])
    folders = (below / (name if k == 1 else f"{name}-{k}") for k in count(1))
    # What was dropped before, and a model that was kept with it, stays as it is.
    folder = next(place for place in folders if not place.exists() or _same(place, found))
    for file, content in found.items():
        write_bytes(folder / file, content)
    return folder


def _same(folder: Path, found: Mapping[str, bytes]) -> bool:
    paths = {name: folder / name for name in found}
    return all(path.is_file() and path.read_bytes() == found[name] for name, path in paths.items())


def _name(description: bytes) -> str:
    """The campaign's name as the name of a folder; complaints about the file itself come when it is read."""
    try:
        name = str(tomllib.loads(description.decode("utf-8-sig")).get("name", ""))
    except ValueError:
        name = ""
    return "".join(c if c.isalnum() or c in "-_" else "_" for c in name)[:60] or "campaign"
