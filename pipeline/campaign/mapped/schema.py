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
    sheet: Name | Row | None = None
    separator: Literal[",", ";", "tab", "space"] | None = None
    decimal: Literal[".", ","] | None = None
    thousands: Literal[".", ",", " ", "'"] | None = None
    encoding: Name = "utf-8"
    header_row: Annotated[int, Field(strict=True, ge=0, le=10_000_000)] = 1
    units_row: Row | None = None
    skip: Annotated[int, Field(strict=True, ge=0, le=10_000_000)] = 0
    last_row: Row | None = None
    comment: Annotated[str, Field(min_length=1, max_length=10)] | None = None
    missing: tuple[Name, ...] = ()
    fill_down: tuple[Name, ...] = ()
    every: Row = 1
    test_column: Name | None = None
    test_from: Literal["file", "sheet", "blank_row"] | None = None
    time_column: Name | None = None

    @model_validator(mode="after")
    def marks(self) -> FileTable:
        """A mark of fractions is none of groups."""
        if self.thousands is not None and self.thousands == self.decimal:
            raise ValueError("thousands is the decimal mark, allowed is another one")
        return self


class ColumnTable(Table):
    """An entry of `[columns]`: what a column is. value = sign * (reading - zero), then in the unit of the contract."""

    what: Annotated[Text, Field(alias="is")]
    unit: Text | None = None
    sign: Sign = 1
    zero: Number | str = 0.0


class CellTable(Table):
    """`[cell]`: where the load cell reads, how it is turned (a rotation vector), and its sign."""

    at_mm: tuple[Place, Place, Place] = (0.0, 0.0, 0.0)
    turned_deg: tuple[Turn, Turn, Turn] = (0.0, 0.0, 0.0)
    sign: Literal[1, -1] = 1


class DerivedTable(Table):
    """An entry of `[derived]`: a coordinate that is a weighted sum of columns, or the angle that it spans."""

    of: dict[str, Number]
    unit: Text
    over_mm: Annotated[Number, Field(gt=0.0, le=1e6)] | None = None
