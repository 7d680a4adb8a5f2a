"""A terminal of 80 columns: how wide it is, how a long name folds, how a wide table breaks into blocks.

Widths are in cells: a Chinese character or an emoji takes two.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from shutil import get_terminal_size
from textwrap import wrap

from rich.box import SIMPLE_HEAD
from rich.cells import cell_len, chop_cells
from rich.console import Console
from rich.table import Table
from rich.text import Text

WIDTH, WIDEST = 80, 100
"""Columns that every table fits, and up to which a terminal that has more is used."""
BREAKS = " _.+-/"
"""After these a name is folded rather than elsewhere."""


def terminal(console: Console | None = None) -> Console:
    """The console, default that of standard output, as wide as is used; what is no terminal has 80 columns."""
    out = console or Console(highlight=False)
    out.width = min(max(out.width, WIDTH), WIDEST) if out.is_terminal else WIDTH
    return out


def wrapped(said: str, width: int = WIDTH) -> str:
    """Sentences, each on as many lines as it takes, further ones indented; no word is cut: a path stays whole."""
    lines = []
    for each in said.splitlines():
        lines += wrap(each, width, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)
    return "\n".join(lines)


def complain(said: str) -> None:
    """Print sentences to standard error: wrapped on a terminal, else a line each, as a search of a log needs them."""
    if sys.stderr.isatty():
        columns = get_terminal_size((WIDTH, 0)).columns
        said = wrapped(said, min(max(columns, 20), WIDEST))
    print(said, file=sys.stderr)


def one_line(*tries: str) -> str:
    """The first of these that fits one line of 80 columns, its blanks made single; the last is to fit always."""
    said = [" ".join(each.split()) for each in tries]
    return next((each for each in said if cell_len(each) <= WIDTH), said[-1])


def lean(*heads: str, title: str = "") -> Table:
    """A table without sides: names at the left, then columns of numbers. What does not fit a cell goes on below."""
    table = Table(
        title=Text(title) if title else None,
        title_justify="left",
        caption_justify="left",
        box=SIMPLE_HEAD,
        show_edge=False,
        padding=0,
    )
    for k, head in enumerate(heads):
        table.add_column(Text(head), justify="right" if k else "left", overflow="fold")
    return table


def cell(name: str, width: int, style: str = "") -> Text:
    """A name as a cell of a table: brackets in it are no markup."""
    return Text(folded(name, width), style=style)


def folded(name: str, width: int) -> str:
    """A name on as many lines as it takes, none wider than so many cells."""
    lines, line = [], ""
    for piece in _pieces(" ".join(name.split()), width):
        if line and cell_len(line + piece) > width:
            lines.append(line)
            line = ""
        line += piece
    return "\n".join([*lines, line])


def _pieces(name: str, width: int) -> Iterator[str]:
    """Parts that end where a name may be folded; one that is too long is cut anywhere."""
    start = 0
    for k, character in enumerate(name, 1):
        if character in BREAKS or k == len(name):
            yield from chop_cells(name[start:k], width)
            start = k


def blocks(widths: Sequence[int], room: int) -> list[range]:
    """Columns of so many cells each, as many side by side as there is room for, at least one."""
    out, start, used = [], 0, 0
    for k, width in enumerate(widths):
        if k > start and used + width > room:
            out.append(range(start, k))
            start, used = k, 0
        used += width
    return [*out, range(start, len(widths))] if len(widths) > start else out
