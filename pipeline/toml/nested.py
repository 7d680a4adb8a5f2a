"""Tables within tables: which of them a complaint of pydantic is about."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from pipeline.toml.spelling import unknown_name

Step = str | int


def tables_at(model: type[BaseModel], path: Sequence[Step]) -> tuple[list[type[BaseModel]], tuple[Step, ...]]:
    """The tables that may stand at the end of a path, none where the model knows none, and the path as a file has it:
    without the kinds by which pydantic tells apart the tables that may stand at one place."""
    tables, there = [model], list[Step]()
    for step in path:
        named = [table for table in tables if step in (_kind(table), table.__name__)]
        if len(tables) > 1 and named:
            tables = named
            continue
        there.append(step)
        if isinstance(step, str):
            tables = [found for table in tables for found in _below(table, step)]
    return tables, tuple(there)


def unknown_key(model: type[BaseModel], path: Sequence[Step]) -> str:
    """What to say of a key that its own table does not have; path: to the key."""
    tables, _ = tables_at(model, path[:-1])
    names = [field.alias or name for table in tables for name, field in table.model_fields.items()]
    near = f", {unknown_name(str(path[-1]), dict.fromkeys(names))}" if names else ""
    return f"is not a key of this table{near}"


def _kind(table: type[BaseModel]) -> object:
    """The one word that a table's `kind` may be; None where it has none."""
    field = table.model_fields.get("kind")
    words = () if field is None else get_args(field.annotation)
    return words[0] if len(words) == 1 else None


def _below(table: type[BaseModel], key: str) -> Iterator[type[BaseModel]]:
    for name, field in table.model_fields.items():
        if key in (name, field.alias):
            yield from _tables_of(field.annotation)


def _tables_of(annotation: Any) -> Iterator[type[BaseModel]]:
    """All tables that a value of this type may be or hold."""
    origin = get_origin(annotation)
    if origin is None:
        if isinstance(annotation, type) and issubclass(annotation, BaseModel):
            yield annotation
    elif origin is Annotated:
        yield from _tables_of(get_args(annotation)[0])
    elif origin is not Literal and (origin in (Union, UnionType, list, tuple)):
        for each in get_args(annotation):
            yield from _tables_of(each)
