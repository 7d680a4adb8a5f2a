"""`bar` from the command line: one bar in, its record as JSON, its page and a few lines out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from meshes.brought.formats import readers
from pipeline.bar.file_case import case_of_options, file_case, names_a_file
from pipeline.bar.record import BarRecord
from pipeline.command import OWN, WORKSHOP, usable
from pipeline.errors import InputError
from pipeline.progress import Progress
from pipeline.system import require
from pipeline.validation.case import load_case, shipped_cases
from pipeline.validation.detail import COARSE, DEFAULT, FINE
from reports.formats import named_entries

RECORD = "bar.json"


@dataclass(frozen=True)
class Asked:
    """What was typed. file: a case, or a file with a bar, which `options` describe (`pipeline.bar.file_case`).

    stiffness_only: of a file K_b and its band by mesh, and nothing else.
    """

    file: str
    coarse: bool = False
    fine: bool = False
    stiffness_only: bool = False
    out: Path | None = None
    json: Path | None = None
    quiet: bool = False
    typed: str = ""
    options: Mapping[str, Any] = field(default_factory=dict)


def bar(asked: Asked) -> BarRecord:
    """Compute the bar, write its record and its page, and say what was found.

    InputError for a file that cannot be used, SolveError or RuntimeError if the numerics fail.
    """
    if asked.coarse and asked.fine:
        raise InputError("--coarse and --fine are both given, allowed is one of the two")
    progress = Progress(asked.quiet)
    path = Path(asked.file)
    of_file = asked.file not in shipped_cases() and (path.suffix.lower() in readers() or names_a_file(path))
    record, folder = (_of_file if of_file else _of_case)(asked, progress)
    record.write(folder / RECORD, asked.json)
    page = [] if asked.stiffness_only else [f"report: {_draw(folder, progress)}"]
    print("\n".join([*summary(record), f"record: {folder / RECORD}", *page]), flush=True)
    return record


def _of_case(asked: Asked, progress: Progress) -> tuple[BarRecord, Path]:
    """The bar of a case with a section."""
    detail = COARSE if asked.coarse else FINE if asked.fine else DEFAULT
    if asked.file not in shipped_cases() and Path(asked.file).suffix != ".toml":
        allowed = f"allowed are a case as .toml, {', '.join(readers())}, or {', '.join(shipped_cases())}"
        raise InputError(f"{asked.file} is no file with a bar, {allowed}")
    case = load_case(asked.file, max(detail.study))
    if asked.stiffness_only:
        raise InputError(
            "--stiffness-only is for a bar that comes as a file, leave it out for a case with a section"
        )
    require("solid")
    from pipeline.bar.of_case import bar_of_case
    from pipeline.validation.workshop import Workshop

    folder = asked.out or OWN / f"{case.name}-bar"
    usable(folder, f"--out {folder}")
    usable(WORKSHOP, f"the folder for intermediate results, {WORKSHOP},")
    return bar_of_case(case, asked.file, detail, Workshop(WORKSHOP, progress), folder, asked.typed), folder


def _of_file(asked: Asked, progress: Progress) -> tuple[BarRecord, Path]:
    """The bar that a file holds, as a case or as options describe it."""
    path = Path(asked.file)
    given = [f"--{key}" for key, value in asked.options.items() if value is not None]
    if path.suffix.lower() == ".toml":
        if given:
            raise InputError(f"{', '.join(given)} belong to a file without a case, {path} says it all itself")
        case = file_case(path)
    else:
        if not path.is_file():
            raise InputError(f"{path} is missing or no file")
        case = case_of_options(path, asked.options)
    if asked.coarse or asked.fine:
        raise InputError(
            "--coarse and --fine are for a case with a section, allowed for a file is a mesh size"
        )
    require("solid")
    folder = asked.out or OWN / f"{case.name}-bar"
    usable(folder, f"--out {folder}")
    if asked.stiffness_only:
        from pipeline.bar.stiffness_only import stiffness_of_file

        return stiffness_of_file(case, path.parent, progress, asked.typed), folder
    from pipeline.bar.of_file import bar_of_file

    return bar_of_file(case, path.parent, folder, progress, asked.typed), folder


def summary(record: BarRecord) -> list[str]:
    """K_b with its bands and the first critical load of each support, a line each."""
    import numpy as np

    k = np.array(record.stiffness)
    lines = [
        f"{record.title}: {record.length_mm:.6g} mm, {record.mesh.cells} {record.mesh.kind}, "
        f"{record.mesh.dofs} unknowns; entry, value in N, mm, rad, band by mesh and by tie of the ends"
    ]
    for name, ij in named_entries(k).items():
        bands = (record.numerical_band.get(name), record.modelling_band.get(name))
        told = ["      -" if b is None else f"{100 * b:6.2f} %" for b in bands]
        lines.append(f"{name} {k[ij]:12.5g} {' '.join(told)}")
    firsts = [b for b in record.buckling if b.model == "solid" and b.mode == 1]
    lines += [f"buckling, {b.supports} tip: {b.load_N:.5g} N in {b.plane}" for b in firsts]
    return [*lines, *record.said]


def _draw(folder: Path, progress: Progress) -> Path:
    from reports.bar_page import draw
    from reports.errors import ReportError

    with progress.stage("report"):
        try:
            return draw(folder)
        except ReportError as error:
            raise InputError(str(error)) from error
