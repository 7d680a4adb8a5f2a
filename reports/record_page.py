"""The page beside a record: index.html from one JSON file and the shapes beside it."""

import json
from collections.abc import Callable, Sequence
from pathlib import Path

from reports import page
from reports.blocks import Section
from reports.errors import ReportError
from reports.files import write_bytes
from reports.load import Json


def drawn(path: Path, what: str, sections: Callable[[Path, Json], Sequence[Section]]) -> Path:
    """Write index.html beside the record `path`: `sections` of its folder and of what it holds, under its title.

    ReportError if the file is missing or not laid out as `what`.
    """
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        html = page.render(record["title"], sections(path.parent, record))
    except OSError as error:
        raise ReportError(f"{path} cannot be read: {error.strerror}") from None
    except (KeyError, IndexError, TypeError, ValueError) as error:
        raise ReportError(f"{path} is not laid out as {what}: {error!r}") from error
    return write_bytes(path.with_name("index.html"), html.encode())
