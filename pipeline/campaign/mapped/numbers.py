"""Cells as numbers: by the marks that were declared, or by those that all cells of a file allow."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from pipeline.campaign.mapped.grid import Cell

EMPTY = ("", "nan")
"""What stands for no reading everywhere, in small letters."""
_EXPONENT = r"(?:[eE][+-]?\d{1,4})?"
_TYPESET = str.maketrans({"\u00a0": " ", "\u202f": " ", "\u2009": " ", "\u2019": "'", "\u2212": "-"})
_BARE = re.compile(rf"[+-]?\d+{_EXPONENT}")
_ONE_MARK = re.compile(r"[+-]?(\d*)([.,])(\d*)([eE][+-]?\d{1,4})?")
_GROUPED = re.compile(r"[+-]?\d{1,3}(?:([.,' ])\d{3})+(?:([.,])\d*)?")


@dataclass(frozen=True)
class Marks:
    """How numbers are written. decimal: before the fraction. thousands: between groups of three digits, "" for none."""

    decimal: str
    thousands: str = ""

    def number(self, text: str) -> float | None:
        """The number; None where the text is none in this writing."""
        text = plain(text)
        point, group = re.escape(self.decimal), re.escape(self.thousands)
        whole = rf"\d{{1,3}}(?:{group}\d{{3}})+|\d+" if self.thousands else r"\d+"
        if not re.fullmatch(rf"[+-]?(?:(?:{whole})(?:{point}\d*)?|{point}\d+){_EXPONENT}", text):
            return None
        bare = text.replace(self.thousands, "") if self.thousands else text
        return float(bare.replace(self.decimal, "."))


def plain(text: str) -> str:
    """With the blanks and apostrophes of a keyboard in the place of those of typesetting."""
    return text.strip().translate(_TYPESET)


def is_empty(cell: Cell) -> bool:
    """Whether a cell holds nothing, or NaN."""
    return cell != cell if isinstance(cell, float) else cell.strip().lower() in EMPTY


def is_word(cell: Cell, words: Iterable[str]) -> bool:
    """Whether a cell holds one of the words that stand for no reading; a number may be one, however it is written."""
    if isinstance(cell, str) and cell.strip() in words:
        return True
    for each in words:
        try:
            if float(each) == (cell if isinstance(cell, float) else float(cell.replace(",", "."))):
                return True
        except ValueError:
            continue
    return False


def decimal_of(cells: Iterable[str], declared: str | None, thousands: str | None) -> Marks | str:
    """The marks of a file's numbers, or the question that they raise.

    What was declared holds. Else the cells decide: a mark that is followed by other than three digits, or stands there
    with another one, can only be read in one way. A file whose numbers allow two readings is not read.
    """
    if declared is not None:
        return Marks(declared, thousands or "")
    # A mark of groups is not that of fractions.
    seen = {"." if thousands == "," else ","} if thousands in (".", ",") else set[str]()
    doubtful = ""
    for cell in cells:
        text = plain(cell)
        if _BARE.fullmatch(text):
            continue
        if one := _ONE_MARK.fullmatch(text):
            before, mark, after, exponent = one.groups()
            if len(after) == 3 and 0 < len(before) <= 3 and before.lstrip("0") and not exponent:
                doubtful = doubtful or text
            else:
                seen.add(mark)
        elif grouped := _GROUPED.fullmatch(text):
            group, point = grouped.groups()
            # A blank or an apostrophe between groups says nothing of the fraction.
            if point or group in ".,":
                seen.add(point or ("," if group == "." else "."))
    if len(seen) == 2:
        return 'numbers have a decimal point and a decimal comma, write decimal = "." or "," under [file]'
    if not seen and doubtful:
        low, high = doubtful.replace(",", "."), re.sub(r"[.,]", "", doubtful)
        return f'{doubtful} may be {low} or {high}, write decimal = "." or "," under [file]'
    return Marks(next(iter(seen), "."), thousands or "")
