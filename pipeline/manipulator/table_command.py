"""The command table: Table 1 of the paper computed again, on the terminal and in files."""

from pathlib import Path

from meshes.files import replacing
from pipeline.command import usable
from pipeline.errors import InputError
from pipeline.manipulator.description import read
from pipeline.manipulator.table import table_1
from pipeline.manipulator.table_console import show
from pipeline.manipulator.table_record import Table1, markdown
from pipeline.progress import Progress

RESULT, TEXT = "table_1.json", "table_1.md"


def table(file: str, json: Path | None = None, out: Path | None = None, quiet: bool = False) -> Table1:
    """Compute, print, and write where it was asked for.

    file: a manipulator or the name of a shipped one. InputError for one that is no Orthoglide, and for a place to
    write that cannot be used.
    """
    for place in (json and json.parent, out):
        if place is not None:
            usable(place, f"the folder {place}")
    manipulator = read(file).manipulator
    with Progress(quiet).stage("Table 1"):
        try:
            result = table_1(manipulator)
        except ValueError as error:
            raise InputError(
                f"{file}: Table 1 needs an Orthoglide, whose legs have a drive, a foot and a parallelogram: {error}"
            ) from None
    show(result, quiet)
    for path, text in _files(result, json, out):
        with replacing(path) as part:
            part.write_text(text, encoding="utf-8")
    return result


def _files(result: Table1, json: Path | None, out: Path | None) -> list[tuple[Path, str]]:
    record = result.model_dump_json(indent=1) + "\n"
    files = [(json, record)] if json else []
    return files + ([(out / RESULT, record), (out / TEXT, markdown(result))] if out else [])
