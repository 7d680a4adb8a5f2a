"""The command effects: the catalogue as a table, and one effect as a page."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Mapping
from pathlib import Path

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from pipeline.errors import InputError
from pipeline.inference.suitable import known_effects
from pipeline.terminal import cell, terminal
from pipeline.toml.spelling import unknown_name
from vjm.effects import effect_named
from vjm.effects.base import Effect, Parameter

NAME, UNIT = 27, 12
"""Cells of a name and of a unit; longer ones go on below, and what a parameter means below its name."""


def effects(name: str | None = None, effects_from: Iterable[Path] = ()) -> None:
    """Print all effects, or one. InputError for a name that is not in the catalogue."""
    known = known_effects(effects_from).effects
    out = terminal()
    if name is None:
        out.print(f"{headline(known)}\n")
    out.print(table(known) if name is None else page(_asked(name, known)))


def headline(known: Mapping[str, Effect]) -> str:
    """How many there are."""
    return f"{len(known)} physical effects that a model may lack"


def _asked(name: str, known: Mapping[str, Effect]) -> Effect:
    """The effect of that name. InputError with the nearest one, or all, if there is none."""
    effect = effect_named(name, known)
    if effect is None:
        raise InputError(f"effect {name!r} is unknown, {unknown_name(name, known)}")
    return effect


def table(known: Mapping[str, Effect]) -> Table:
    """Name, title and parameters with units of all effects."""
    out = Table(box=None, padding=(0, 0, 0, 2), pad_edge=False, header_style="bold")
    for head in ("effect", "what it is", "parameters"):
        out.add_column(head, no_wrap=head == "effect", overflow="fold")
    for effect in known.values():
        parameters = ", ".join(map(_with_unit, effect.parameters)) or "there or not"
        out.add_row(cell(effect.name, NAME), Text(effect.title), Text(parameters))
    return out


def _with_unit(parameter: Parameter) -> str:
    """The name, and the unit where the name does not end with it."""
    spelled = parameter.unit.replace("·", "").replace("/", "_per_").removeprefix("1_")
    return parameter.name if parameter.name.endswith(spelled) else f"{parameter.name} [{parameter.unit}]"


def page(effect: Effect) -> RenderableType:
    """Everything that an effect declares, and the file that it is in."""
    parts: list[RenderableType] = [Text(f"{effect.name}: {effect.title}", style="bold"), Text()]
    said = {
        "equation": effect.equation,
        "what it looks like": effect.signature,
        "limits": effect.limits,
        "rigs": " and ".join(effect.kinds),
        "source": effect.source,
        "file": _file_of(effect),
    }
    for head, text in said.items():
        parts += [Text(head, style="bold"), Padding(Text(text), (0, 0, 0, 2))]
    if effect.parameters:
        parts += [Text(), _parameters(effect.parameters)]
    else:
        parts += [Text(), Text("no parameters: it is there or not")]
    return Group(*parts)


def _parameters(parameters: tuple[Parameter, ...]) -> Table:
    out = Table(box=None, padding=(0, 0, 0, 2), pad_edge=False, header_style="bold")
    out.add_column("parameter", no_wrap=True)
    for head in ("unit", "absent", "typical", "lowest", "highest"):
        out.add_column(head, no_wrap=True, justify="left" if head == "unit" else "right")
    for p in parameters:
        numbers = (f"{value:.6g}" for value in (p.null, p.null + p.typical, p.low, p.high))
        named = Text("\n").join([cell(p.name, NAME), cell(p.meaning, NAME, "dim")])
        out.add_row(named, cell(p.unit, UNIT), *map(Text, numbers))
    return out


def _file_of(effect: Effect) -> str:
    """Path of the effect's file, from here where it is below."""
    # The function knows its file; the class only through a module that may not be registered.
    own = next(it for it in vars(type(effect)).values() if inspect.isfunction(it))
    file = Path(inspect.getfile(own)).resolve()
    here = Path.cwd().resolve()
    return str(file.relative_to(here)) if here in file.parents else str(file)
