"""`studio` from the command line: a page on this machine's own address, until it is interrupted."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from pipeline.campaign import read
from pipeline.errors import InputError
from pipeline.system import require


def studio(folder: Path | None, port: int, browser: bool, effects_from: Sequence[Path] = ()) -> None:
    """Serve. InputError for a campaign that cannot be read, or where the studio's packages are missing."""
    if folder is not None:
        read(folder)
    require("studio")
    from pipeline.studio.view import Studio
    from reports.errors import ReportError

    # The server reads the command line for options of its own, and would take an address from there.
    sys.argv = sys.argv[:1]
    try:
        page = Studio(folder, tuple(Path(file).resolve() for file in effects_from))
    except ReportError as error:
        raise InputError(str(error)) from error
    page.serve(port, lambda at: _ready(at, browser))


def _ready(port: int, browser: bool) -> None:
    url = f"http://127.0.0.1:{port}/index.html"
    print(f"studio: {url} (Ctrl+C ends it)", flush=True)
    if browser:
        import webbrowser

        webbrowser.open(url)
