"""What the commands do, with their imports where they are needed: a complaint about the input comes at once."""

import os
from pathlib import Path

from pipeline.bar.file_case import file_case, names_a_file
from pipeline.errors import InputError
from pipeline.progress import Progress
from pipeline.system import require
from pipeline.terminal import complain
from pipeline.typed import INSTALLED
from pipeline.validation.case import load_case
from pipeline.validation.detail import COARSE, DEFAULT, FINE

KEPT = Path("reports/validation")
OWN = Path("results")
WORKSHOP = Path(".parastiff")
RESULT, BAR = "result.json", "bar.json"


def validate(name: str, coarse: bool, fine: bool, out: Path | None, quiet: bool, typed: str) -> None:
    """The whole validation of a case, and its report; `typed` is the command line."""
    if names_a_file(Path(name)):
        validate_file(Path(name), coarse, fine, out, quiet, typed)
        return
    detail = COARSE if coarse else FINE if fine else DEFAULT
    case = load_case(name, max(detail.study))
    require("solid")
    from pipeline.validation.result import write_result
    from pipeline.validation.run import run
    from pipeline.validation.workshop import Workshop

    progress = Progress(quiet)
    # Only the default look at the paper's case replaces the report that is kept with the project.
    kept = name == "orthoglide" and detail is DEFAULT and not INSTALLED
    folder = out or (KEPT if kept else OWN / f"{case.name}-{detail.name}")
    usable(folder, f"--out {folder}")
    usable(WORKSHOP, f"the folder for intermediate results, {WORKSHOP},")
    result = run(case, detail, Workshop(WORKSHOP, progress), folder, typed)
    write_result(result, folder)
    page = draw(folder, progress)
    print("\n".join([*result.story, f"report: {page}"]), flush=True)
    for said in result.warnings:
        complain(f"warning: {said}")


def validate_file(path: Path, coarse: bool, fine: bool, out: Path | None, quiet: bool, typed: str) -> None:
    """The same for a case whose bar is a file."""
    case = file_case(path)
    require("solid")
    from pipeline.bar.run_file import detail_of, run_file

    detail, progress = detail_of(coarse, fine, path), Progress(quiet)
    folder = out or OWN / f"{case.name}-{detail.name}"
    usable(folder, f"--out {folder}")
    result = run_file(case, path, detail, folder, progress, typed)
    result.bar.write(folder / BAR)
    result.write(folder / RESULT)
    page = draw_part(folder, progress)
    print("\n".join([*result.story, f"report: {page}"]), flush=True)
    for said in result.warnings:
        complain(f"warning: {said}")


def is_part(path: Path) -> bool:
    """Whether a saved result is that of a bar that came as a file."""
    try:
        return '"kind": "part"' in path.read_text(encoding="utf-8")[:200]
    except (OSError, ValueError):
        return False


def redraw(folder: Path, quiet: bool) -> None:
    """Draw a saved result again."""
    if is_part(folder / RESULT):
        from pipeline.bar.part_result import PartResult

        PartResult.read(folder / RESULT, "saved result")
        require("solid")
        print(f"report: {draw_part(folder, Progress(quiet))}")
        return
    from pipeline.validation.result import read_result

    read_result(folder / RESULT)
    require("solid")
    print(f"report: {draw(folder, Progress(quiet))}")


def draw_part(folder: Path, progress: Progress) -> Path:
    """Draw the page of a run of a bar that came as a file; returns it."""
    from reports.errors import ReportError
    from reports.part_page import draw as draw_result

    with progress.stage("report"):
        try:
            return draw_result(folder)
        except ReportError as error:
            raise InputError(str(error)) from error


def draw(folder: Path, progress: Progress) -> Path:
    """Draw the report of a folder; returns the page."""
    from reports.validation import ReportError
    from reports.validation import draw as draw_validation

    with progress.stage("report"):
        try:
            draw_validation(folder)
        except ReportError as error:
            raise InputError(str(error)) from error
    return folder / "index.html"


def usable(folder: Path, named: str) -> None:
    """Raise InputError if nothing can be written there, before any time is spent; makes nothing."""
    here = folder
    while not here.exists() and here != here.parent:
        here = here.parent
    if not here.is_dir() or not os.access(here, os.W_OK | os.X_OK):
        raise InputError(f"{named} cannot be written, allowed is a folder in which you may make files")


def usable_places(out: Path | None = None, **files: Path | None) -> None:
    """The same of the folder of --out and of those of files, by the options that name them, where they are given."""
    for option, file in files.items():
        if file is not None:
            usable(file.parent, f"--{option} {file}")
    if out is not None:
        usable(out, f"--out {out}")
