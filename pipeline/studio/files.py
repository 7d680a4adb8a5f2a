"""The files of a campaign: edits by others are seen, what buttons write can be taken back, laws stand beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import count
from pathlib import Path

from pipeline.campaign import read
from pipeline.campaign.reading import DESCRIPTION, MEASUREMENTS
from pipeline.discover.effect_file import write_effect
from pipeline.errors import InputError
from pipeline.inference.model_file import NAME
from pipeline.saving import put

LAWS = "laws"
"""Name of an effect file of laws."""


def stamps(folder: Path) -> tuple[int, ...]:
    """When the files of a campaign were last changed; 0 for one that is missing."""
    out = []
    for name in (DESCRIPTION, MEASUREMENTS, NAME):
        try:
            out.append((folder / name).stat().st_mtime_ns)
        except OSError:
            out.append(0)
    return tuple(out)


def content(path: Path) -> bytes | None:
    """Of a file; None where it cannot be read."""
    try:
        return path.read_bytes()
    except OSError:
        return None


@dataclass(frozen=True)
class Edit:
    """One change. words: what was written. before, after: the file."""

    path: Path
    words: str
    before: bytes
    after: bytes


def edited(folder: Path, change: Callable[[str], str], words: str) -> Edit:
    """Write campaign.toml anew, whole or not at all; its line ends stay. InputError where that cannot be
    done, and for a campaign that could not be read then."""
    path = folder / DESCRIPTION
    try:
        before = path.read_bytes()
        text = before.decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path} cannot be read: {error}") from error
    new = change(text)
    read(folder, new)
    it = Edit(path, words, before, new.encode())
    put(path, it.after)
    return it


def undone(it: Edit) -> None:
    """Write the file as it was before. InputError where it has been edited since, or cannot be written."""
    if content(it.path) != it.after:
        raise InputError(f"{it.path} was edited since, so that it is not written back")
    put(it.path, it.before)


def write_laws(folder: Path, text: str) -> Path:
    """Write the file; returns where. A file that is there already stays: the same text is that file, another gets a
    number. InputError where it cannot be written."""
    places = (folder / f"{LAWS}{'' if k == 1 else f'_{k}'}.py" for k in count(1))
    path = next(it for it in places if not it.exists() or content(it) == text.encode())
    write_effect(path, text)
    return path
