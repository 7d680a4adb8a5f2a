"""A bar that is known already: of a case, by its section and material, or of a result, by its identified K_b."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pipeline.campaign.bar_from import bar_from
from pipeline.errors import InputError
from pipeline.validation.case import load_case


@dataclass(frozen=True)
class KnownBar:
    """length, width: mm, of the linkage. lines: what `[rig]` of a campaign says of the bar. file: that it names."""

    length: float
    width: float | None
    lines: str
    file: Path | None = None


def known_bar(source: str) -> KnownBar:
    """Of a result.json, of a case file, or of a shipped case by its name. InputError where there is no such bar."""
    return _of_result(Path(source)) if source.endswith(".json") else _of_case(source)


def _of_result(path: Path) -> KnownBar:
    try:
        found = bar_from(path)
    except InputError as error:
        raise InputError(f"--from {error}") from error
    line = f"bar_from = {json.dumps(path.name)}        # K_b, K_g and their bands, as computed\n"
    return KnownBar(found.length, found.width, line, path)


def _of_case(source: str) -> KnownBar:
    case = load_case(source)
    if case.bar.section is None or case.bar.lug is not None:
        why = "is searched for" if case.bar.section is None else "has lugs, so it is not uniform"
        raise InputError(
            f"--from {source}: its bar {why}; run it, and give its result.json, which holds the identified K_b"
        )
    section = case.bar.section.model_dump()
    material = {"E_MPa": case.material.E_MPa, "nu": case.material.nu}
    lines = f"section = {_inline(section)}\nmaterial = {_inline(material)}\n"
    return KnownBar(case.linkage.length_mm, case.linkage.width_mm, lines)


def _inline(values: dict[str, Any]) -> str:
    return "{ " + ", ".join(f"{key} = {json.dumps(value)}" for key, value in values.items()) + " }"
