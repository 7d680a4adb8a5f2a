"""Types of the values of a file, the table that all tables are, and what its schema says of a mistake."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fem.frame.rig import STEEPEST_DEG
from pipeline.toml.complaints import shown
from pipeline.toml.nested import tables_at, unknown_key

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
# The bounds keep every product of three such numbers far from what a float can hold.
Length = Annotated[Number, Field(ge=1e-3, le=1e6)]
Rigidity = Annotated[Number, Field(ge=1e-3, le=1e15)]
Entry = Annotated[Number, Field(ge=-1e15, le=1e15)]
Weight = Annotated[Number, Field(ge=0.0, le=1e9)]
Sigma = Annotated[Number, Field(ge=1e-12, le=1e9)]
Celsius = Annotated[Number, Field(ge=-273.15, le=1e4)]
Angle = Annotated[Number, Field(ge=-STEEPEST_DEG, le=STEEPEST_DEG)]
Place = Annotated[Number, Field(ge=-1e6, le=1e6)]
Text = Annotated[str, Field(min_length=1, max_length=100)]
Direction = Literal["x", "y", "z", "-x", "-y", "-z"]


_BOUNDS = {"greater_than_equal": ("at least", "ge"), "less_than_equal": ("at most", "le")}


class Table(BaseModel):
    """A table of the file; unknown keys are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, str_strip_whitespace=False)


def printable(value: str) -> str:
    """A name that fits into one cell and one sentence."""
    if value != value.strip() or not value.isprintable():
        raise ValueError("allowed is printable text without blanks at its ends")
    return value


class BarTable(Table):
    """A uniform bar."""

    EA_N: Rigidity
    """Axial rigidity."""
    EIy_Nmm2: Rigidity
    """Bending rigidity about y: for deflection along z."""
    EIz_Nmm2: Rigidity
    """Bending rigidity about z: for deflection along y."""
    GJ_Nmm2: Rigidity
    """Torsional rigidity."""


def sentences(error: ValidationError, model: type[BaseModel]) -> list[tuple[tuple[str | int, ...], str]]:
    """Each of pydantic's complaints as path and sentence."""
    every = error.errors(include_url=False)
    return [(tables_at(model, e["loc"])[1], _sentence(dict(e), model)) for e in every]


def _sentence(error: dict[str, Any], model: type[BaseModel]) -> str:
    kind, found, loc = error["type"], error["input"], error["loc"]
    if kind == "missing":
        return "is missing"
    if kind == "extra_forbidden":
        return unknown_key(model, loc)
    message = error["msg"].removeprefix("Value error, ")
    if kind == "value_error":
        return f"is {shown(found)}, {message}" if isinstance(found, str) else message
    wanted = (message[0].lower() + message[1:]).removeprefix("input should be ")
    if kind in _BOUNDS:
        word, key = _BOUNDS[kind]
        wanted = f"{word} {error['ctx'][key]:g}"
    wanted = {"dict_type": "a table", "list_type": "a list"}.get(kind, wanted)
    named = "a table" if isinstance(found, dict) else "a list" if isinstance(found, list) else shown(found)
    return f"is {named}, allowed is: {wanted}"
