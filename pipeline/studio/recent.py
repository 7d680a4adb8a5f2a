"""Campaigns that were opened here lately, and the shipped one to try all of it with."""

from __future__ import annotations

import json
from pathlib import Path

from pipeline.campaign.reading import DESCRIPTION, MEASUREMENTS
from pipeline.command import WORKSHOP
from pipeline.demo import SHIPPED
from pipeline.page.command import RESULTS
from pipeline.studio.drop import placed
from reports.files import write_bytes

FILE = WORKSHOP / "recent.json"
MOST = 6


def recent(file: Path = FILE) -> list[str]:
    """Folders, the last one first; those that are gone left out."""
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return []
    folders = [it for it in found if isinstance(it, str)] if isinstance(found, list) else []
    return [it for it in folders if (Path(it) / DESCRIPTION).is_file()][:MOST]


def remember(folder: Path, file: Path = FILE) -> None:
    """Put a folder first. Where nothing can be written nothing is remembered."""
    kept = [str(folder), *(it for it in recent(file) if it != str(folder))][:MOST]
    try:
        write_bytes(file, (json.dumps(kept, indent=1) + "\n").encode())
    except OSError:
        return


def example(below: Path = RESULTS) -> Path:
    """A copy of the shipped campaign, so that the shipped one stays as it is."""
    files = {name: (SHIPPED / name).read_bytes() for name in (DESCRIPTION, MEASUREMENTS)}
    return placed(files, "example", below)
