"""Tolerances as somebody types them, and the campaign's file with them: the one thing that is written there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import tomlkit
from tomlkit.exceptions import TOMLKitError

from meshes.files import replacing
from pipeline.campaign.reading import DESCRIPTION
from pipeline.campaign.tolerance import EXACT, table, tolerance
from pipeline.errors import InputError
from pipeline.page.record import TolerancePage

Known = tuple[tuple[str, float], ...]


def typed(texts: Mapping[str, str], shown: Sequence[TolerancePage]) -> Known:
    """Standard deviations by key, as [tolerance] allows them. InputError names the first that it does not."""
    written = tuple(it.key for it in shown)
    values = {it.key: _number(it.words, texts.get(it.key, "")) for it in shown}
    known = {key: value for key, value in values.items() if value}
    complaints: list[str] = []

    def say(path: tuple[str, ...], said: str) -> None:
        words = next((it.words for it in shown if it.key == path[-1]), path[-1])
        complaints.append(f"{words}: {said}")

    found = tolerance(table(known, written), written, say)
    if complaints:
        raise InputError(complaints[0])
    return tuple(found.items())


def _number(words: str, text: str) -> float:
    said = text.strip().replace(",", ".")
    if said in ("", "0", EXACT):
        return 0.0
    try:
        return float(said)
    except ValueError:
        raise InputError(f'{words}: is {text!r}, allowed is a number or "{EXACT}"') from None


def write(folder: Path, known: Known, shown: Sequence[TolerancePage]) -> None:
    """Put the table [tolerance] in campaign.toml in the place of what stands there; all else stays, comments too.

    InputError where it cannot be written.
    """
    path = folder / DESCRIPTION
    try:
        document = tomlkit.parse(path.read_text(encoding="utf-8"))
        new = tomlkit.table()
        for key, value in table(dict(known), tuple(it.key for it in shown)).items():
            new[key] = _inline(value) if isinstance(value, dict) else value
        document["tolerance"] = new
        with replacing(path) as part:
            part.write_text(tomlkit.dumps(document), encoding="utf-8", newline="")
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror}") from error
    except TOMLKitError as error:
        raise InputError(f"{path} is no TOML: {error}") from error


def _inline(values: Mapping[str, object]) -> tomlkit.items.InlineTable:
    it = tomlkit.inline_table()
    for key, value in values.items():
        it[key] = value
    return it
