"""What a key allows, in words: from the type of its field."""

from __future__ import annotations

import re
import types
from collections.abc import Iterable
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import annotated_types as limits
from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

UNITS = {
    "N_per_mm": "N/mm",
    "Nmm_per_rad": "N·mm/rad",
    "mm_per_N": "mm/N",
    "rad_per_Nmm": "rad/(N·mm)",
    "Nmm2": "N·mm²",
    "Nmm": "N·mm",
    "MPa": "MPa",
    "mrad": "mrad",
    "rad": "rad",
    "deg": "°",
    "mm": "mm",
    "N": "N",
    "C": "°C",
}
"""Units by the ending of a key, longer endings first."""
_BOUNDS = (
    ("from", limits.Ge, "ge"),
    ("above", limits.Gt, "gt"),
    ("to", limits.Le, "le"),
    ("below", limits.Lt, "lt"),
)
_COUNTS = {2: "two", 3: "three", 6: "six"}


def unit_of(key: str) -> str:
    """Unit that a key names at its end; empty where it names none."""
    return next((unit for ending, unit in UNITS.items() if key.endswith(f"_{ending}")), "")


def default_of(field: FieldInfo) -> str:
    """ "needed", or what counts where the key is left out, as TOML writes it; empty for nothing."""
    if field.is_required():
        return "needed"
    value = field.get_default(call_default_factory=True)
    if value is None or value is PydanticUndefined or isinstance(value, BaseModel) or value in ((), {}, []):
        return ""
    return f"default `{as_toml(value)}`"


def as_toml(value: Any) -> str:
    """A value as TOML writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(as_toml, value))}]"
    return short(value) if isinstance(value, float) else str(value)


def short(value: float) -> str:
    """A number as one writes it: 1e6, not 1e+06."""
    return re.sub(r"e\+?(-?)0*", r"e\1", f"{value:g}")


def allowed(field: FieldInfo) -> str:
    """What a field allows."""
    return _words(field.annotation, field.metadata)


def _words(kind: Any, metadata: Iterable[Any] = ()) -> str:
    origin, inside = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return _words(inside[0], [*inside[1:], *metadata])
    if origin in (Union, types.UnionType):
        choices = [_words(each, metadata) for each in inside if each is not type(None)]
        return " or ".join(dict.fromkeys(choices))
    if origin is Literal:
        return ", ".join(f"`{as_toml(each)}`" for each in inside)
    if origin in (tuple, list):
        return _list(origin, inside)
    if origin is dict:
        return "table" if inside[1] is Any else f"table of {_many(_words(inside[1]))} by name"
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        return f"table [{called(kind)}](#{anchor(kind)})"
    return _plain(kind, metadata)


def _list(origin: Any, inside: tuple[Any, ...]) -> str:
    each = _words(inside[0])
    if origin is tuple and Ellipsis not in inside:
        return f"list of {_COUNTS.get(len(inside), str(len(inside)))} {_many(each)}"
    return f"list of {_many(each)}"


def _many(words: str) -> str:
    """Of one thing that of several: list, table, number, text ..."""
    first, _, rest = words.partition(" ")
    if words.startswith("whole number"):
        return words.replace("whole number", "whole numbers", 1)
    return " ".join(filter(None, [f"{first}s", rest]))


def _plain(kind: Any, metadata: Iterable[Any]) -> str:
    word = {float: "number", int: "whole number", str: "text", bool: "true or false"}.get(kind, "value")
    pattern = next((p for it in metadata if (p := getattr(it, "pattern", None))), None)
    if pattern:
        return f"text that fits `{pattern}`"
    return word + (_range(metadata) if kind in (int, float) else "")


def _range(metadata: Iterable[Any]) -> str:
    low = high = ""
    for it in _flat(metadata):
        for word, kind, name in _BOUNDS:
            if isinstance(it, kind):
                said = f"{word} {short(float(getattr(it, name)))}"
                low, high = (said, high) if name in ("ge", "gt") else (low, said)
    found = " ".join(filter(None, [low, high]))
    return f" {found}" if found else ""


def _flat(metadata: Iterable[Any]) -> Iterable[Any]:
    """Limits, also those inside a `Field`."""
    for it in metadata:
        yield from _flat(it.metadata) if isinstance(it, FieldInfo) else (it,)


def called(schema: type[BaseModel]) -> str:
    """How a table is named where another one has it: by its kind, else by its class."""
    kind = schema.model_fields.get("kind")
    if kind is not None and get_origin(kind.annotation) is Literal and len(get_args(kind.annotation)) == 1:
        return str(get_args(kind.annotation)[0])
    name = schema.__name__
    short_name = re.sub(r"(Table|Size|Choice)$", "", name)
    return name if short_name == name else short_name.lower()


def anchor(schema: type[BaseModel]) -> str:
    """Where the keys of a schema are."""
    module = schema.__module__.removeprefix("pipeline.").replace(".", "-").replace("_", "-")
    return f"{module}-{schema.__name__.strip('_').lower()}"
