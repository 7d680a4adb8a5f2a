"""What a report is made of: sections of blocks. The page and the Markdown twin print the same ones."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Column:
    """A column's title and unit; `numeric` columns are aligned on the decimal point."""

    title: str
    unit: str = ""
    numeric: bool = True


@dataclass(frozen=True)
class Cell:
    """A cell's text, a small remark after it, and the name that a program knows it by, smaller still."""

    text: str
    mark: str = ""
    code: str = ""

    @property
    def whole(self) -> str:
        """What stands left of the decimal point."""
        return self.text[: self._cut()]

    @property
    def fraction(self) -> str:
        """The decimal point and what follows, or the power of ten."""
        return self.text[self._cut() :]

    def _cut(self) -> int:
        cut = self.text.find(".")
        return cut if cut >= 0 else len(self.text)


@dataclass(frozen=True)
class Table:
    """A table; a row whose first cell is empty continues the group above it."""

    caption: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[Cell]]
    notes: Sequence[str] = ()

    def fraction_width(self, column: int) -> int:
        """Characters right of the point that the column reserves; none beside a power of ten, its digits are narrow."""
        its = [row[column].fraction for row in self.rows]
        return 0 if any("×" in it for it in its) else max(map(len, its), default=0)


def table(
    caption: str, columns: Sequence[Column], rows: Sequence[Sequence[str | Cell]], *notes: str
) -> Table:
    """A table whose cells may be given as plain text."""
    cells = [[c if isinstance(c, Cell) else Cell(c) for c in row] for row in rows]
    return Table(caption, columns, cells, notes)


@dataclass(frozen=True)
class Tables:
    """Small tables that may stand side by side."""

    tables: Sequence[Table]


@dataclass(frozen=True)
class Text:
    """A paragraph."""

    text: str


@dataclass(frozen=True)
class Bullets:
    """A list of sentences."""

    items: Sequence[str]


@dataclass(frozen=True)
class Code:
    """Commands, one a line."""

    text: str


@dataclass(frozen=True)
class Figure:
    """A figure: the page prefers the plot, then the drawing, then the picture; Markdown takes the picture."""

    name: str
    caption: str
    plot: Any = None
    svg: str = ""
    png: bytes = field(default=b"", repr=False)


@dataclass(frozen=True)
class Gallery:
    """Figures that may stand side by side."""

    figures: Sequence[Figure]


@dataclass(frozen=True)
class Lead:
    """The sentence that a reader is to take away."""

    text: str


@dataclass(frozen=True)
class Explorer:
    """Many plots of which one is shown, chosen by two lists; Markdown takes `pictures`.

    choices: what the lists are called. plots: as plotly.js reads them, by the entries of both. first: shown at first.
    linked: id of a heat map whose cells choose as well, with the entries of both as their customdata.
    """

    name: str
    caption: str
    choices: tuple[str, str]
    plots: Mapping[tuple[str, str], Any]
    first: tuple[str, str]
    linked: str = ""
    pictures: Sequence[Figure] = ()


@dataclass(frozen=True)
class Bar:
    """A row of `Bars`. code: the name that a program knows it by. values: one for each of the series; None: none."""

    label: str
    code: str
    values: Sequence[float | None]


@dataclass(frozen=True)
class Bars:
    """Errors in sigmas as bars on a logarithmic scale; the line at 1 is noise. series: their names."""

    series: Sequence[str]
    rows: Sequence[Bar]


@dataclass(frozen=True)
class Heading:
    """A heading inside a section."""

    text: str


@dataclass(frozen=True)
class Columns:
    """Blocks side by side where there is room, else below each other."""

    left: Sequence["Block"]
    right: Sequence["Block"]


@dataclass(frozen=True)
class Details:
    """What is opened by those who want to know; Markdown has it in full."""

    title: str
    blocks: Sequence["Block"]


Block = (
    Tables
    | Text
    | Bullets
    | Code
    | Figure
    | Gallery
    | Table
    | Lead
    | Explorer
    | Bars
    | Heading
    | Columns
    | Details
)


@dataclass(frozen=True)
class Section:
    """A headed part of the report."""

    anchor: str
    title: str
    blocks: Sequence[Block]
