"""The tables of campaign.toml that say how a file is to be read: `[file]`, `[columns]`, `[cell]` and `[derived]`."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from pipeline.toml.fields import Number, Place, Table, Text

Row = Annotated[int, Field(strict=True, ge=1, le=10_000_000)]
Name = Annotated[str, Field(min_length=1, max_length=200)]
Turn = Annotated[Number, Field(ge=-360.0, le=360.0)]
Sign = Annotated[int, Field(strict=True)] | str


class FileTable(Table):
    """`[file]`: where the readings are, and how the file is laid out. Lines and columns are counted from 1."""

    path: Name | None = None
    """The file beside campaign.toml, or a pattern of several such as raw/*.csv. Text, workbook or TDMS."""
    sheet: Name | Row | None = None
    """Sheet of a workbook, or group of a TDMS file: its name, or its number from 1."""
    separator: Literal[",", ";", "tab", "space"] | None = None
    """What stands between the cells of a text. Left out: found, where all rows allow one reading only."""
    decimal: Literal[".", ","] | None = None
    """Decimal mark. Left out: found, where all rows allow one reading only."""
    thousands: Literal[".", ",", " ", "'"] | None = None
    """Mark between groups of digits."""
    encoding: Name = "utf-8"
    """Encoding of a text, as Python names it."""
    header_row: Annotated[int, Field(strict=True, ge=0, le=10_000_000)] = 1
    """Line of the column names; 0: there are none, and the columns are #1, #2 and so on."""
    units_row: Row | None = None
    """Line of the units, where they have one of their own."""
    skip: Annotated[int, Field(strict=True, ge=0, le=10_000_000)] = 0
    """Rows to leave out after the header and the units."""
    last_row: Row | None = None
    """Line after which nothing is read."""
    comment: Annotated[str, Field(min_length=1, max_length=10)] | None = None
    """Lines that begin with this are left out."""
    missing: tuple[Name, ...] = ()
    """Words for a reading that is missing; an empty cell and NaN always are."""
    fill_down: tuple[Name, ...] = ()
    """Columns whose empty cells repeat the one above, as merged cells of a workbook do."""
    every: Row = 1
    """Of so many rows one is read. First and last rows and those where the load turns are kept."""
    test_column: Name | None = None
    """Column with the id of the test of each row."""
    test_from: Literal["file", "sheet", "blank_row"] | None = None
    """What the id of a test is taken from where no column has it: the file's name, the sheet's name, or a blank
    row between one test and the next, in the order of [[tests]]."""
    time_column: Name | None = None
    """Column of the time; a time that goes back is refused, since rows are in the order of the loading."""

    @model_validator(mode="after")
    def marks(self) -> FileTable:
        """A mark of fractions is none of groups."""
        if self.thousands is not None and self.thousands == self.decimal:
            raise ValueError("thousands is the decimal mark, allowed is another one")
        return self


class ColumnTable(Table):
    """An entry of `[columns]`: what a column is. value = sign * (reading - zero), then in the unit of the contract."""

    what: Annotated[Text, Field(alias="is")]
    """What the column is: x, y, z, rx, ry, rz, fx, fy, fz, mx, my, mz, the name of a gauge, temperature, time,
    test, step, at_x, at_y, at_z, "ignore", or "?" where it is not decided yet."""
    unit: Text | None = None
    """Unit of the column. May be left out where the file says it. See the list of units."""
    sign: Sign = 1
    """1, or -1 where the column grows against the axis; "?" where it is not decided yet."""
    zero: Number | str = 0.0
    """Reading that is zero, in the unit of the file; "first_row": that of the first row of each test. Its
    noise is then in all others, and no constant of the column is compared."""


class CellTable(Table):
    """`[cell]`: where the load cell reads, how it is turned (a rotation vector), and its sign."""

    at_mm: tuple[Place, Place, Place] = (0.0, 0.0, 0.0)
    """Point at which the cell reads, from the platform point, base frame, in the nominal pose."""
    turned_deg: tuple[Turn, Turn, Turn] = (0.0, 0.0, 0.0)
    """Rotation vector by which the cell's frame is turned against the base frame."""
    sign: Literal[1, -1] = 1
    """-1 for a cell that reads what the platform exerts on it."""


class DerivedTable(Table):
    """An entry of `[derived]`: a coordinate that is a weighted sum of columns, or the angle that it spans."""

    of: dict[str, Number]
    """Weight of each column that enters, by its name in the file."""
    unit: Text
    """Unit of the columns that enter."""
    over_mm: Annotated[Number, Field(gt=0.0, le=1e6)] | None = None
    """Distance of two dials, for an angle: atan(sum / over_mm). Left out: the weighted sum itself."""
