"""A bar that is known already: of a case, by its section and material, or of a result, by its identified K_b."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pipeline.errors import InputError
from pipeline.validation.case import load_case


@dataclass(frozen=True)
class KnownBar:
    """length, width: mm, of the linkage. lines: what `[rig]` of a campaign says of the bar."""

    length: float
    width: float
    lines: str


def known_bar(source: str) -> KnownBar:
    """Of a result.json, of a case file, or of a shipped case by its name. InputError where there is no such bar."""
    return _of_result(Path(source)) if source.endswith(".json") else _of_case(source)


def _of_result(path: Path) -> KnownBar:
    try:
        result = json.loads(path.read_text(encoding="utf-8"))
        matrix = [[float(value) for value in row] for row in result["bar"]["stiffness"]]
        length, width = float(result["length_mm"]), float(result["width_mm"])
    except OSError as error:
        raise InputError(f"--from {path}: cannot be read: {error.strerror}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"--from {path}: is no result of run, allowed is its result.json") from error
    rows = "".join(f"    [{', '.join(f'{value:.9g}' for value in row)}],\n" for row in matrix)
    return KnownBar(length, width, f"bar_stiffness = [          # identified, of {path.name}\n{rows}]\n")


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
