"""A table as a file has it: rows of cells, each row with its line, before anything is known of what they mean."""

from __future__ import annotations

from dataclasses import dataclass

Cell = str | float
"""Text as it stands in the file, or a number where the file itself says that it is one."""


@dataclass(frozen=True)
class Grid:
    """rows: of cells; they need not be alike in length. lines: where each stands in the file, counted from 1.
    name: of the sheet or the group of channels, "" where a file has one table only."""

    rows: tuple[tuple[Cell, ...], ...]
    lines: tuple[int, ...]
    name: str = ""


class BadTable(ValueError):
    """A file that is no table. line: where that shows, None for all of it."""

    def __init__(self, said: str, line: int | None = None) -> None:
        super().__init__(said)
        self.line = line
