"""Reads page.json and writes the page, its Markdown twin and the pictures."""

import json
from pathlib import Path

from reports import markdown, page
from reports.campaign import pictures
from reports.campaign.sections import build, first
from reports.errors import ReportError
from reports.files import write_bytes
from reports.load import Json

NAME = "page.json"


def first_screen(record: Json) -> str:
    """Verdict, picture, what is certain and the next step of a page: HTML that needs nothing from outside.

    record: of a `pipeline.page.record.Page`, as its `model_dump()` has it; for a notebook (`_repr_html_`).
    """
    return page.screen(first(record))


def draw(folder: Path) -> list[Path]:
    """Write index.html, report.md and pictures/*.png beside page.json; returns the files written.

    Raises ReportError if page.json is missing, is not JSON or is not laid out as a page.
    """
    path = Path(folder) / NAME
    record = read(path)
    try:
        found = pictures.draw(record)
        sections = build(record, found)
        title = f"{record['campaign']}: measured and predicted"
        html, text = page.render(title, sections), markdown.render(title, sections)
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
        raise ReportError(f"{path} is not laid out as a page: {type(error).__name__}: {error}") from error
    written = [write_bytes(path.parent / "pictures" / f"{name}.png", png) for name, png in found.items()]
    written.append(write_bytes(path.parent / "report.md", text.encode()))
    written.append(write_bytes(path.parent / "index.html", html.encode()))
    return written


def read(path: Path) -> Json:
    """The record. ReportError where it cannot be read."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ReportError(f"{path} does not exist; report writes it from a campaign") from None
    except OSError as error:
        raise ReportError(f"{path} cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise ReportError(f"{path} is not JSON: {error}") from None
    if not isinstance(found, dict):
        raise ReportError(f"{path} is no object, allowed is a page that report has written")
    return found
