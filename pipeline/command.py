"""What the commands do, with their imports where they are needed: a complaint about the input comes at once."""

from pathlib import Path

from pipeline.case import load_case
from pipeline.errors import InputError
from pipeline.progress import Progress
from pipeline.system import require_libraries

DEFAULT_OUT = Path("reports/validation")
WORKSHOP = Path(".parastiff")


def validate(name: str, coarse: bool, fine: bool, out: Path | None, quiet: bool) -> None:
    """The whole validation of a case, and its report."""
    case = load_case(name)
    require_libraries()
    from pipeline.detail import COARSE, DEFAULT, FINE
    from pipeline.result import write_result
    from pipeline.run import run
    from pipeline.workshop import Workshop

    progress = Progress(quiet)
    detail = COARSE if coarse else FINE if fine else DEFAULT
    folder = out or (DEFAULT_OUT if name == "orthoglide" else Path("reports") / case.name)
    usable(folder)
    result = run(case, detail, Workshop(WORKSHOP, progress), folder)
    write_result(result, folder)
    pages = draw(folder, progress)
    print("\n".join(result.story))
    print(f"report: {pages}")


def redraw(folder: Path, quiet: bool) -> None:
    """Draw a saved result again."""
    require_libraries()
    print(f"report: {draw(folder, Progress(quiet))}")


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


def usable(folder: Path) -> None:
    """Raise InputError if results cannot be written there, before any time is spent."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / ".probe"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise InputError(f"--out {folder} cannot be written: {error.strerror}") from error
