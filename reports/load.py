"""Reads result.json as plain data and complains before anything is drawn."""

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from reports.errors import ReportError

Json = Mapping[str, Any]

# What the report draws, path by path; "[]" after a name is a list of such objects, "?" one that may be null.
REQUIRED = {
    "": "case title detail length_mm width_mm bar buckling parallelogram critical curves validity orthoglide "
    "errata story seconds versions commit command seed solver sources",
    "bar": "section length_mm lug material constants stiffness paper worst_entry_error oracle second_route "
    "fit dofs cells cell_kind quality laws convergence",
    "bar.section": "kind",
    "bar.second_route": "stiffness leftover explanation",
    "bar.fit?": "start found rms solves",
    "bar.convergence": "dofs sizes_mm entries orders extrapolated band",
    "buckling[]": "body model supports plane mode load_N",
    "parallelogram[]": "q_deg closed_form vjm fea paper doubled_bar rank singular_values_fea frame "
    "worst_fea_deviation",
    "critical[]": "q_deg held model spring_at what load_N why",
    "curves[]": "model q_deg held spring_at branch x_mm fx_N critical_N note",
    "validity[]": "model q_deg held deviation load_N",
    "orthoglide[]": "unknowns cells readings agreement findings",
    "errata[]": "number place printed correct evidence",
}


def load(folder: Path) -> Json:
    """The result in `folder`.

    Raises ReportError if result.json is missing, is not JSON or lacks a key that the report draws.
    """
    path = folder / "result.json"
    try:
        result = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ReportError(f"{path} does not exist; a validation run writes it") from None
    except OSError as error:
        raise ReportError(f"{path} cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise ReportError(f"{path} is not JSON: {error}") from None
    for place, keys in REQUIRED.items():
        for name, part in parts(path, result, place):
            require(path, name, part, keys.split())
    return result


def parts(path: Path, result: Any, place: str) -> Iterator[tuple[str, Any]]:
    """Every object that `place` of REQUIRED stands for, with the name an error gives it."""
    if place.endswith("[]"):
        name = place.removesuffix("[]")
        if not isinstance(result[name], list):
            raise ReportError(f"{path}: {name} is {kind(result[name])}, allowed is a list")
        yield from ((f"{name}[{i}]", part) for i, part in enumerate(result[name]))
        return
    part = result
    for step in filter(None, place.removesuffix("?").split(".")):
        part = part[step]
    if part is not None or not place.endswith("?"):
        yield place.removesuffix("?"), part


def require(path: Path, name: str, part: Any, keys: Sequence[str]) -> None:
    """Raise ReportError unless `part` is an object with all `keys`."""
    where = name or "the file"
    if not isinstance(part, dict):
        raise ReportError(f"{path}: {where} is {kind(part)}, allowed is an object")
    for key in keys:
        if key not in part:
            raise ReportError(f"{path}: {where} lacks the key {key!r}")


def kind(value: Any) -> str:
    """What JSON calls the value."""
    names = {dict: "an object", list: "a list", str: "a string", bool: "a boolean", type(None): "null"}
    return names.get(type(value), "a number")
