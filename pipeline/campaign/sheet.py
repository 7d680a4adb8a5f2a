"""measurements.csv: text in, a table of cells out that knows the line of each row."""

import csv
import io
import re
from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd

from pipeline.campaign.model import Array
from pipeline.campaign.names import KEYS, wrong_column
from pipeline.toml.complaints import Complaints, shown

LARGEST = 1e9
"""No sensor reads more, in any of the units."""
EACH = 5
"""So many bad cells of a column are named one by one."""
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,4})?", re.ASCII)
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?", re.ASCII)


def sheet(
    text: str,
    known: tuple[str, ...],
    complaints: Complaints,
    needed: tuple[str, ...] = KEYS,
    otherwise: str = "",
) -> pd.DataFrame:
    """Cells as text, one row a line, columns named by the header; the index is the line, the header being 1.

    known: the columns that may be there; needed: those that have to be. otherwise: what else can be done with a table
    whose header is not as it has to be. Rows that are not as wide as the header are
    left out with a complaint; BadCampaign where no table can be made.
    """
    source = csv.reader(io.StringIO(text, newline=""), strict=True, skipinitialspace=True)
    header: list[str] = []
    rows, lines = [], []
    start = 1
    try:
        for cells in source:
            if not header:
                names = [cell.strip() for cell in cells]
                header = _header(names, start, (known, needed), complaints, otherwise)
            elif len(cells) == len(header):
                rows.append(cells)
                lines.append(start)
            elif cells:
                said = f"has {len(cells)} cells, the header has {len(header)}"
                hint = "; is there a decimal comma or a comma too many?" if len(cells) > len(header) else ""
                complaints.add("", said + hint, start)
            start = source.line_num + 1
    except csv.Error as error:
        complaints.add("", f"cannot be split into cells: {error}", start)
        complaints.check()
    if not header:
        complaints.add("", "is empty, allowed is a header row and one row for each load step")
    elif not rows and not complaints.found:
        complaints.add("", "has a header but no rows, allowed is one row for each load step")
    if not header or not rows or len(set(header)) < len(header):
        complaints.check()
    return pd.DataFrame(rows, index=pd.Index(lines, name="line"), columns=header, dtype=object)


def _header(
    names: list[str],
    line: int,
    allowed: tuple[tuple[str, ...], tuple[str, ...]],
    complaints: Complaints,
    otherwise: str,
) -> list[str]:
    """The header as it is; complaints about every name in it that is not allowed. allowed: names that may be there, and
    those that have to be. otherwise: the last of them. BadCampaign for other separators, or where no name is known."""
    known, needed = allowed
    if not any(names):
        return []
    before = len(complaints.found)
    stranger = _no_header(names, line, known, complaints)
    if not stranger:
        _names(names, line, known, needed, complaints)
    if otherwise and len(complaints.found) > before:
        complaints.add("", otherwise, line)
    if stranger:
        complaints.check()
    return names


def _names(
    names: list[str], line: int, known: tuple[str, ...], needed: tuple[str, ...], complaints: Complaints
) -> None:
    for k, name in enumerate(names):
        if not name:
            complaints.add("", f"column {k + 1} has no name", line)
        elif name in names[:k]:
            complaints.add(f"column {shown(name)[1:-1]}", "is there twice", line)
        elif name not in known:
            complaints.add(f"column {shown(name)[1:-1]}", wrong_column(name, known), line)
    for key in needed:
        if key not in names:
            complaints.add(f"column {key}", "is missing", line)


def _no_header(names: list[str], line: int, known: tuple[str, ...], complaints: Complaints) -> bool:
    """Whether cells are separated by something else, or no name is known; that is said."""
    if len(names) <= 2:
        for mark, called in ((";", "semicolons"), ("\t", "tabs")):
            if mark in "".join(names):
                said = f"cells are separated by {called}, allowed are commas, with a point in decimal numbers"
                complaints.add("", said, line)
                return True
    if not set(names) & set(known):
        said = f"is no header: it has none of the column names {', '.join(known)}"
        complaints.add("", said, line)
        return True
    return False


def numbers(frame: pd.DataFrame, column: str, complaints: Complaints) -> Array:
    """A column (N,) as numbers, NaN where the cell is empty or there is no such column; complaints about others."""
    values = np.full(len(frame), np.nan)
    if column not in frame.columns:
        return values
    bad: list[tuple[int, str]] = []
    for k, (line, cell) in enumerate(zip(frame.index, frame[column], strict=True)):
        text = cell.strip()
        if not text:
            continue
        if _NUMBER.fullmatch(text) and abs(number := float(text)) <= LARGEST:
            values[k] = number
        else:
            bad.append((int(line), text))
    told(column, bad, _why, complaints)
    return values


def told(
    column: str, bad: Sequence[tuple[int, str]], why: Callable[[str], str], complaints: Complaints
) -> None:
    """Complaints about the cells of a column that hold no number, the first few one by one."""
    for line, text in bad[:EACH]:
        complaints.add(f"column {column}", f"holds {shown(text)}, {why(text)}", line)
    if more := bad[EACH:]:
        complaints.add(f"column {column}", f"{len(more)} more such cells below", more[0][0])


def _why(text: str) -> str:
    if _DECIMAL_COMMA.fullmatch(text):
        return "a decimal comma, allowed is a decimal point"
    if _NUMBER.fullmatch(text):
        return f"allowed is a magnitude up to {LARGEST:g}"
    if text.lower().lstrip("+-") in ("nan", "inf", "infinity", "na", "n/a", "null", "none", "-"):
        return "allowed is a finite number, or an empty cell where nothing was measured"
    return "allowed is a number, or an empty cell where nothing was measured"
