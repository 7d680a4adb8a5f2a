"""What the doctor found, as lines of campaign.toml that mend it: only those that do what was looked at."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from pipeline.campaign import Campaign, read
from pipeline.campaign.edited import Change, changed, checked, same
from pipeline.campaign.reading import DESCRIPTION
from pipeline.errors import InputError
from pipeline.selection.doctor import Suspicion
from pipeline.selection.unknown_zeros import Zero

RIGHT = "the table was looked up and is right"
"""Then it may have what looks like a mistake, and what is left is looked for in the model."""


@dataclass(frozen=True)
class Mend:
    """words: what it looks like. lines: as they stand in the file then. text: campaign.toml with them."""

    words: str
    lines: tuple[str, ...]
    text: str


def mends(folder: Path, found: Sequence[Suspicion], zero: Zero | None) -> tuple[Mend, ...]:
    """Of what was found in a campaign's folder, and of a sensor that was not zeroed, those that its description can
    say. A line is none where the file, read with it, is not as the doctor has mended it: a load cell that is turned, a
    header that names another unit. Last, where a mistake was found, that the table is right. Nothing is written."""
    campaign, text = read(folder), (folder / DESCRIPTION).read_bytes().decode("utf-8-sig")
    return tuple(_mends(campaign, folder, text, found, zero))


def _mends(
    campaign: Campaign, folder: Path, text: str, found: Sequence[Suspicion], zero: Zero | None
) -> Iterator[Mend]:
    for mistake in (it.mistake for it in found):
        it = _tried(folder, text, mistake.words, mistake.changes)
        if it is not None and same(read(folder, it.text), mistake.mended(campaign)):
            yield it
    if zero is not None:
        fitted = [Change("tests", test, "zero", "fitted") for test in zero.tests]
        it = _tried(folder, text, zero.words.removesuffix(': zero = "fitted"?'), fitted)
        if it is not None:
            yield it
    if found:
        yield Mend(RIGHT, ("table_checked = true",), checked(text))


def _tried(folder: Path, text: str, words: str, changes: Sequence[Change]) -> Mend | None:
    """The text with the changes, where it can be read."""
    if not changes:
        return None
    new, lines = changed(text, changes)
    try:
        read(folder, new)
    except InputError:
        return None
    return Mend(words, lines, new)
