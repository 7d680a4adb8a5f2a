"""What a key of a schema means: the text below it, in the source of its class."""

from __future__ import annotations

import ast
import inspect
import textwrap
from functools import cache

from pydantic import BaseModel


@cache
def descriptions(schema: type[BaseModel]) -> dict[str, str]:
    """Meaning of each field of a schema by its Python name, those of its bases included; only fields that have one."""
    found: dict[str, str] = {}
    for cls in reversed(schema.__mro__):
        if issubclass(cls, BaseModel) and cls is not BaseModel:
            found |= _below_fields(cls)
    return {name: found[name] for name in schema.model_fields if name in found}


def _below_fields(cls: type) -> dict[str, str]:
    """Strings that stand alone below an annotated name of a class."""
    body = ast.parse(textwrap.dedent(inspect.getsource(cls))).body[0]
    assert isinstance(body, ast.ClassDef)
    out = {}
    for field, below in zip(body.body, body.body[1:], strict=False):
        if not (isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)):
            continue
        if (
            isinstance(below, ast.Expr)
            and isinstance(below.value, ast.Constant)
            and isinstance(below.value.value, str)
        ):
            out[field.target.id] = " ".join(below.value.value.split())
    return out


def summary(cls: type) -> str:
    """The docstring of a class itself, on one line; empty where it has none."""
    return " ".join((vars(cls).get("__doc__") or "").split())
