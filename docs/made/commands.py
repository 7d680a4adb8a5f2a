"""The commands, from what the command line says of itself."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, get_args, get_type_hints

from typer.models import ArgumentInfo, OptionInfo

from docs.made.lists import rows
from pipeline.cli import app

_VALUES = {Path: "PATH", int: "N", float: "NUMBER", str: "TEXT"}


def commands() -> str:
    """Every command: what it does, how it is called, arguments and options."""
    return "\n".join(_command(it.callback) for it in app.registered_commands if it.callback is not None)


def names() -> tuple[str, ...]:
    """Of all commands."""
    return tuple(it.callback.__name__ for it in app.registered_commands if it.callback is not None)


def _command(function: Callable[..., Any]) -> str:
    name, told = function.__name__, list(_parameters(function))
    places = [said for said, _, of_place in told if of_place]
    usage = " ".join([f"parastiff {name}", *places, *(["[OPTIONS]"] if len(places) < len(told) else [])])
    table = (
        rows(("argument or option", "meaning"), [(f"`{_cell(said)}`", _cell(text)) for said, text, _ in told])
        if told
        else ""
    )
    doc = inspect.getdoc(function) or ""
    return f"(command-{name})=\n\n## {name}\n\n{doc}\n\n```text\n{usage}\n```\n\n{table}"


def _parameters(function: Callable[..., Any]) -> Iterator[tuple[str, str, bool]]:
    """How each parameter is written, what it is, and whether it is an argument: it has no name on the command line."""
    hints, defaults = get_type_hints(function, include_extras=True), inspect.signature(function).parameters
    for name, hint in hints.items():
        if name == "return":
            continue
        kind, *_, info = get_args(hint)
        default = defaults[name].default
        if isinstance(info, ArgumentInfo):
            value = info.metavar or name.upper()
            needed = default is inspect.Parameter.empty
            yield (value if needed else f"[{value}]"), _text(info, default), True
        elif isinstance(info, OptionInfo):
            yield _option(name, kind, info), _text(info, default), False


def _option(name: str, kind: Any, info: OptionInfo) -> str:
    plain = name.replace("_", "-")
    # The first name of an annotated option stands where a default would.
    every = [each for each in (info.default, *(info.param_decls or ())) if isinstance(each, str)]
    decls = " ".join(each for each in every if each.startswith("-"))
    if kind is bool:
        return decls or f"--{plain} / --no-{plain}"
    types = [kind, *get_args(kind), *(inner for each in get_args(kind) for inner in get_args(each))]
    value = info.metavar or next((_VALUES[each] for each in types if each in _VALUES), "VALUE")
    return f"{decls or f'--{plain}'} {value}"


def _text(info: ArgumentInfo | OptionInfo, default: Any) -> str:
    """Help, and the default where it does not go without saying."""
    said = info.help or ""
    if default in (None, False, "", inspect.Parameter.empty):
        return said
    return f"{said} Default: {'yes' if default is True else default}."


def _cell(text: str) -> str:
    return text.replace("|", r"\|")


PIECES: dict[str, Callable[[], str]] = {"commands": commands}
