"""The command `bar` on the command line: wiring only."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from pipeline.options import Json
from pipeline.typed import typed


def register(app: typer.Typer, guarded: Callable[[Callable[[], object]], None]) -> None:
    """Add the command; guarded: turns what went wrong into one sentence and an exit code."""

    def bar(
        file: Annotated[str, typer.Argument(metavar="FILE", help="A case, shipped or as .toml.")],
        coarse: Annotated[bool, typer.Option("--coarse", help="Coarse meshes.")] = False,
        fine: Annotated[bool, typer.Option("--fine", help="Fine meshes.")] = False,
        json: Json = None,
        out: Annotated[
            Path | None, typer.Option(help="Folder of bar.json and its page; default results/NAME-bar.")
        ] = None,
        quiet: Annotated[bool, typer.Option("--quiet", help="No progress.")] = False,
    ) -> None:
        """One bar alone: K_b and K_g with their bands, critical loads, a page."""
        from pipeline.bar.command import Asked
        from pipeline.bar.command import bar as compute

        guarded(lambda: compute(Asked(file, coarse, fine, out, json, quiet, typed())))

    app.command()(bar)
