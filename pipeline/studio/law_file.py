"""Laws that were found as an effect file beside the campaign that they were found in."""

from __future__ import annotations

from itertools import count
from pathlib import Path

from pipeline.discover.effect_file import write_effect

NAME = "laws"


def write_laws(folder: Path, text: str) -> Path:
    """Write the file; returns where. A file that is there already stays: the same text is that file, another gets a
    number. InputError where it cannot be written."""
    places = (folder / f"{NAME}{'' if k == 1 else f'_{k}'}.py" for k in count(1))
    path = next(it for it in places if not it.exists() or _same(it, text))
    write_effect(path, text)
    return path


def _same(path: Path, text: str) -> bool:
    return path.is_file() and path.read_bytes() == text.encode()
