"""What is asked of a file with a bar and what it says of it, before anything is solved."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from meshes.brought.found import Brought
from meshes.brought.frame import BarFrame, bar_frame
from meshes.solid import Floats
from pipeline.bar.tables import FileCase
from pipeline.errors import InputError
from reports.formats import named_entries


def said_of(path: Path, work: Callable[[], Any]) -> Any:
    """What the work returns; its ValueError as an InputError that names the file."""
    try:
        return work()
    except InputError:
        raise
    except ValueError as error:
        raise InputError(f"{path}: {error}") from error


def asked_of(case: FileCase, path: Path) -> dict[str, Any]:
    """For the reader of the file; ValueError where there is no file."""
    if not path.is_file():
        raise ValueError("is missing or no file")
    bar = case.bar
    return {
        "path": str(path.resolve()),
        "unit": bar.unit,
        "size": case.mesh.size_mm,
        "tetrahedra": case.mesh.tetrahedra,
        "base": None if bar.base is None else bar.base.model_dump(),
        "tip": None if bar.tip is None else bar.tip.model_dump(),
        "y": bar.y,
    }


def frame_of(case: FileCase, brought: Brought) -> BarFrame:
    """The bar's frame; ValueError for ends that make none."""
    base, tip = brought.base, brought.tip
    return bar_frame(base.at, tip.at, (base.axis, tip.axis), case.bar.y)


def relative_error(value: Floats, error: Floats) -> dict[str, float]:
    """Error (6, 6) over value (6, 6) of the entries that are not negligible, by name; none where it is not known."""
    known = {name: ij for name, ij in named_entries(value).items() if error[ij] == error[ij]}
    return {name: float(error[ij] / abs(value[ij])) for name, ij in known.items()}


def described(case: FileCase) -> dict[str, float | str]:
    """The material as it stands in the record."""
    if case.material is not None:
        own = case.material.model_dump(exclude_none=True)
        return {k: v if isinstance(v, float | str) else str(v) for k, v in own.items()}
    return {
        f"{name} {k}": v if isinstance(v, float | str) else str(v)
        for name, each in case.materials.items()
        for k, v in each.model_dump(exclude_none=True).items()
    }
