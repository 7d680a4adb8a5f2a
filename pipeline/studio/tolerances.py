"""Tolerances as somebody types them, and the campaign's file with them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import tomlkit

from pipeline.campaign.edited import parsed
from pipeline.campaign.tolerance import EXACT, table, tolerance
from pipeline.campaign.writing import inline
from pipeline.errors import InputError
from pipeline.page.record import Page, TolerancePage
from reports.formats import number

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


def with_tolerances(text: str, known: Known, shown: Sequence[TolerancePage]) -> str:
    """campaign.toml with the table [tolerance] in the place of what stands there; all else stays, comments too.

    InputError for what is no TOML.
    """
    document = parsed(text)
    new = tomlkit.table()
    for key, value in table(dict(known), tuple(it.key for it in shown)).items():
        new[key] = inline(value) if isinstance(value, dict) else value
    document["tolerance"] = new
    return tomlkit.dumps(document)


def rows(page: Page, changed: Known | None) -> list[dict[str, str]]:
    """For the page: as written, or as typed and not written yet; with what a diagnosis found beside them."""
    own = None if changed is None else dict(changed)
    found = {it.name: it for it in page.nominals if it.seen}
    out = []
    for it in page.tolerances:
        value = it.value if own is None else own.get(it.key, 0.0)
        mine = found.get(it.key)
        out.append(
            {
                "key": it.key,
                "words": it.words,
                "unit": it.unit,
                "value": f"{value:g}" if value else "exact",
                "found": "" if mine is None else f"{number(mine.value, 4)} ± {number(mine.std, 2)}",
                "pull": "" if mine is None else f"{mine.pull:+.1f}",
            }
        )
    return out
