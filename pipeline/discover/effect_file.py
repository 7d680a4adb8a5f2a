"""The effect file of laws that were found, as a user would write it: add, diagnose and simulate take it."""

from __future__ import annotations

import keyword
import re
from collections.abc import Sequence
from pathlib import Path

from pipeline.answer.law import LawFound
from pipeline.discover.record import Discovered
from pipeline.discover.search import Discovery
from pipeline.discover.through import Through
from pipeline.errors import InputError
from pipeline.saving import put
from vjm.effects.base import Parameter

DIGITS = 8


def effect_text(found: Discovery, record: Discovered) -> str:
    """One class for each law in the mechanism. ValueError where there is none."""
    ways = [(law.ways[0], told) for law, told in zip(found.laws, record.laws, strict=True) if law.ways]
    if not ways:
        raise ValueError("no law in the mechanism was found, so that there is none to write")
    head = [
        f'"""Found in the campaign {_plain(record.campaign)}: {len(ways)} law{"s" if len(ways) > 1 else ""}."""',
        "",
        "from parastiff import Parameter, SiteLaw",
        "",
        "",
    ]
    blocks = ["\n".join(_class(way, told, record)) for way, told in ways]
    return "\n".join(head) + "\n\n\n".join(blocks) + "\n"


def write_effect(path: Path, text: str) -> None:
    """Write the file whole or not at all. InputError where it cannot be written."""
    if path.suffix != ".py":
        raise InputError(f"--write {path} is no Python file, allowed is a name that ends with .py")
    put(path, text)


def name_of(way: Through) -> str:
    """The law's name in models and answers."""
    return re.sub(r"\W+", "_", f"{way.law.site}_{way.formed.form.name}").strip("_")


def _class(way: Through, told: LawFound, record: Discovered) -> list[str]:
    name, law = name_of(way), way.law
    title = "".join(word.capitalize() for word in name.split("_"))
    title = f"{title}_" if keyword.iskeyword(title) else title
    low, high = told.range
    unit = told.curve.x_unit if told.curve else ""
    files = ", ".join(f"{file} sha256 {digest[:16]}" for file, digest in record.data.items())
    lines = [
        f"class {title}(SiteLaw):",
        f'    """{law.title[0].upper()}{law.title[1:]}."""',
        "",
        f"    name = {name!r}",
        f"    title = {law.title!r}",
        f"    site = {law.site!r}",
        f"    form = {law.form!r}",
        f"    equation = {way.formed.form.equation!r}",
        f"    signature = {told.shape!r}",
        f"    limits = {f'seen from {low:.4g} to {high:.4g} {unit}; nothing is known beyond'!r}",
        f"    source = {f'found in the campaign {record.campaign}; {files}'!r}",
    ]
    if law.mirrored:
        lines.append("    mirrored = True")
    if law.held:
        lines.append(f"    held = {dict(law.held)!r}")
    lines.append("    parameters = (")
    for p in law.parameters:
        lines += _parameter(p, way.values[p.name])
    lines.append("    )")
    return lines


def _parameter(p: Parameter, value: float) -> Sequence[str]:
    null = value if p.null else 0.0
    size = abs(value) or p.typical
    numbers = ", ".join(_number(each) for each in (null, size, p.low, p.high))
    return [
        f"        Parameter({p.name!r}, {p.unit!r}, {numbers}, {p.meaning!r}),",
    ]


def _number(value: float) -> str:
    return repr(float(f"{value:.{DIGITS}g}"))


def _plain(text: str) -> str:
    return text.replace("\\", "/").replace('"', "'")
