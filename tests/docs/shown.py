"""Compares what a page shows with what came out: words as they are, numbers to their last digit, `...` for anything."""

from __future__ import annotations

import re

WILD = "..."
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?", re.IGNORECASE)
UNITS_OF_LAST_DIGIT = 1.0
"""By which a number may differ: libraries of linear algebra differ beyond what is printed."""


def difference(shown: str, printed: str) -> str:
    """What differs, in words; empty where nothing does. Blanks and ends of lines count as one blank."""
    parts = [part.split() for part in re.split(r"(?:^|\s)\.\.\.(?=\s|$)", shown)]
    words = printed.split()
    if len(parts) == 1:
        return _differs(parts[0], words)
    first, *middle, last = parts
    if said := _differs(first, words[: len(first)]):
        return said
    place = len(first)
    for part in middle:
        found = _found(part, words, place)
        if found is None:
            return (
                f"{' '.join(part)!r} did not come out behind {' '.join(words[max(0, place - 5) : place])!r}"
            )
        place = found + len(part)
    end = len(words) - len(last)
    return "too little came out" if end < place else _differs(last, words[end:])


def _found(part: list[str], words: list[str], start: int) -> int | None:
    places = range(start, len(words) - len(part) + 1)
    return next((k for k in places if not _differs(part, words[k : k + len(part)])), None)


def _differs(shown: list[str], printed: list[str]) -> str:
    for one, other in zip(shown, printed, strict=False):
        if not _alike(one, other):
            return f"{one!r} is shown, {other!r} came out"
    if len(shown) != len(printed):
        return f"{len(shown)} words are shown, {len(printed)} came out"
    return ""


def _alike(shown: str, printed: str) -> bool:
    """Whether two words are the same but for numbers in them, which may differ by their last digit."""
    if shown == printed:
        return True
    if _NUMBER.sub("#", shown) != _NUMBER.sub("#", printed):
        return False
    pairs = zip(_NUMBER.findall(shown), _NUMBER.findall(printed), strict=True)
    return all(
        abs(float(a) - float(b)) <= UNITS_OF_LAST_DIGIT * _last_digit(a) * (1 + 1e-9) for a, b in pairs
    )


def _last_digit(number: str) -> float:
    """Size of one unit of the last digit that is written."""
    mantissa, _, power = number.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return float(10.0 ** (int(power or 0) - decimals)) if decimals or power else 0.0
