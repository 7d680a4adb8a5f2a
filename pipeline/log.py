"""The log of a command: what was fitted, step by step, for whoever wants to know why a fit ended where it did."""

from __future__ import annotations

import logging
from pathlib import Path

from pipeline.errors import InputError

ROOT = logging.getLogger("pipeline")
FORMAT = "%(asctime)s %(process)d %(name)s: %(message)s"


def log_to(path: Path) -> None:
    """All that the program says of its work, from now on, at the end of this file; of its forks too, told apart by the
    number of the process. InputError for a file that cannot be written."""
    try:
        handler = logging.FileHandler(path, encoding="utf-8")
    except OSError as error:
        raise InputError(
            f"--log {path}: cannot be written: {error.strerror}, allowed is a file in a folder"
        ) from error
    handler.setFormatter(logging.Formatter(FORMAT))
    ROOT.addHandler(handler)
    ROOT.setLevel(logging.DEBUG)
