"""Rigs by their drawing: a function for each kind, which takes the keys of its `[rig]` table in campaign.toml.

    rigs.parallelogram(length_mm=310.0, width_mm=80.0, bar={"EA_N": 7e6, ...})

Kinds are found by themselves (`pipeline.campaign.rigs`); `help(rigs.parallelogram)` lists the keys with their units.
Each raises InputError with the key, what was found and what is allowed.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from pydantic import ValidationError

from pipeline.campaign import Rig
from pipeline.campaign.rig_table import RigTable
from pipeline.campaign.rigs import KINDS
from pipeline.errors import InputError

MakesRig = Callable[..., Rig]


def kinds() -> tuple[str, ...]:
    """Names of all kinds of rigs."""
    return tuple(KINDS)


def __getattr__(name: str) -> MakesRig:
    if name not in KINDS:
        raise AttributeError(f"there is no rig {name!r}, allowed are {', '.join(KINDS)}")
    return _maker(name)


def __dir__() -> list[str]:
    return [*KINDS, "kinds"]


@cache
def _maker(kind: str) -> MakesRig:
    table = KINDS[kind]

    def make(**keys: Any) -> Rig:
        given = {key: _plain(value) for key, value in keys.items()}
        try:
            return table.model_validate({"kind": kind, **given}).rig(None)
        except ValidationError as error:
            raise InputError(_said(kind, error)) from error

    own = {name: field for name, field in table.model_fields.items() if name != "kind"}
    make.__name__ = make.__qualname__ = kind
    make.__doc__ = f"{_title(table)}\n\nkeys: {', '.join(own)}."
    make.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
        [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, annotation=it.annotation)
            for name, it in own.items()
        ],
        return_annotation=Rig,
    )
    return make


def _plain(value: Any) -> Any:
    """Arrays as lists, as a file has them."""
    return value.tolist() if isinstance(value, np.ndarray) else value


def _title(table: type[RigTable]) -> str:
    return inspect.cleandoc(table.__doc__ or "").split("\n\n")[0]


def _said(kind: str, error: ValidationError) -> str:
    first = error.errors()[0]
    place = ".".join(map(str, first["loc"])) or "the keys"
    return f"rigs.{kind}: {place}: {first['msg'].removeprefix('Value error, ')}"
