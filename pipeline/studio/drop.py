"""Files that were dropped on the page, laid in a folder of their own: a campaign, or a table that is to become one."""

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
FOLDER, TABLES = RESULTS / "dropped", RESULTS / "tables"


def lay(files: Sequence[dict[str, Any]], below: Path = FOLDER) -> Path:
    """The folder with both files, named as the campaign. InputError where one is missing or another is there."""
    found = _contents(files)
    if set(found) != {DESCRIPTION, MEASUREMENTS}:
        names = ", ".join(sorted(found)) or "nothing"
        raise InputError(f"{names} was dropped, allowed are {DESCRIPTION} and {MEASUREMENTS} together")
    return placed(found, _name(found[DESCRIPTION]), below)


def table(files: Sequence[dict[str, Any]], below: Path) -> Path:
    """The one file of readings, in a folder. InputError for several."""
    found = _contents(files)
    if len(found) != 1:
        raise InputError(
            f"{', '.join(sorted(found)) or 'nothing'} was dropped, allowed is one file of readings"
        )
    ((name, content),) = found.items()
    place = below / Path(name).name
    write_bytes(place, content)
    return place


def placed(found: Mapping[str, bytes], name: str, below: Path) -> Path:
    """A folder of this name with these files. What is there already, and a model that was kept with it, stays as it is:
    the same files keep their folder, others get one with a number."""
    safe = "".join(c if c.isalnum() or c in "-_" else "_" for c in name)[:60] or "campaign"
    folders = (below / (safe if k == 1 else f"{safe}-{k}") for k in count(1))
    folder = next(place for place in folders if not place.exists() or _same(place, found))
    for file, content in found.items():
        write_bytes(folder / file, content)
    return folder


def _contents(files: Sequence[dict[str, Any]]) -> dict[str, bytes]:
    return {str(file["name"]): bytes(file["content"]) for file in files}


def _same(folder: Path, found: Mapping[str, bytes]) -> bool:
    paths = {name: folder / name for name in found}
    return all(path.is_file() and path.read_bytes() == found[name] for name, path in paths.items())


def _name(description: bytes) -> str:
    """The campaign's name; complaints about the file itself come when it is read."""
    try:
        return str(tomllib.loads(description.decode("utf-8-sig")).get("name", ""))
    except ValueError:
        return ""
