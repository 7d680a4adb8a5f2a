"""Files that a user asked for, written whole or not at all."""

from __future__ import annotations

from pathlib import Path

from meshes.files import replacing
from pipeline.errors import InputError


def put(path: Path, content: str | bytes) -> None:
    """Write a file, text as UTF-8. InputError where it cannot be written; what was there before stays then."""
    try:
        with replacing(path) as part:
            part.write_bytes(content.encode() if isinstance(content, str) else content)
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror}") from error
