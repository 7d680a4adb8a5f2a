"""`init` from the command line: a folder with campaign.toml to fill in, and the readings beside it."""

from __future__ import annotations

import shutil
from pathlib import Path

from pipeline.campaign.mapped.grid import BadTable
from pipeline.campaign.names import known_columns
from pipeline.campaign.reading import DESCRIPTION, MEASUREMENTS
from pipeline.campaign.rigs import KINDS
from pipeline.command import usable
from pipeline.errors import InputError, unread
from pipeline.init.campaign_file import campaign_text, plain_header
from pipeline.init.found import Found, looked
from pipeline.init.known_bar import known_bar
from pipeline.typed import command


def init(folder: Path, file: Path | None, kind: str, known: str | None = None) -> None:
    """Write the campaign. known: case or result that has the bar. InputError where there is a campaign, for a file that
    holds no table, or for no such bar."""
    if kind not in KINDS:
        raise InputError(f"--kind is {kind!r}, allowed are {', '.join(KINDS)}")
    if (folder / DESCRIPTION).exists():
        raise InputError(f"{folder / DESCRIPTION} is there already, allowed is a folder without one")
    usable(folder, f"the folder {folder}")
    if known is not None and "bar" not in KINDS[kind].model_fields:
        raise InputError(
            f"--from is the bar of a bar or a parallelogram, a {kind} is described in its own file"
        )
    bar = None if known is None else known_bar(known)
    found = None if file is None else found_in(file)
    folder.mkdir(parents=True, exist_ok=True)
    if file is not None and found is not None:
        _beside(file, folder)
        text = campaign_text(file.stem, kind, file.name, found, bar)
    else:
        text = campaign_text(folder.resolve().name, kind, bar=bar)
        if not (folder / MEASUREMENTS).exists():
            (folder / MEASUREMENTS).write_text(plain_header(known_columns(())), encoding="utf-8")
    if bar is not None and bar.file is not None:
        _beside(bar.file, folder)
    (folder / DESCRIPTION).write_text(text, encoding="utf-8")
    print(f"{folder / DESCRIPTION}: written; fill in what is a question mark")
    if found is not None and found.question:
        print(f"{file}: {found.question}")
    print(f"next: {command('check', folder)}")


def _beside(file: Path, folder: Path) -> None:
    """Copy a file into the campaign's folder, where it is not there yet."""
    copy = folder / file.name
    if copy.exists() and copy.read_bytes() != file.read_bytes():
        raise InputError(f"{copy} is there already and is another file, allowed is a folder without it")
    if not copy.exists():
        shutil.copyfile(file, copy)


def found_in(file: Path) -> Found:
    """What a file says by itself. InputError for one that cannot be read."""
    try:
        return looked(file)
    except FileNotFoundError:
        raise InputError(f"{file} is missing, allowed is a file of readings") from None
    except BadTable as error:
        raise InputError(f"{file}{f' line {error.line}' if error.line else ''}: {error}") from error
    except OSError as error:
        raise InputError(f"{file} {unread(error)}") from error
