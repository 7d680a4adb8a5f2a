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
        file: Annotated[
            str, typer.Argument(metavar="FILE", help="A case, shipped or as .toml; CAD or a mesh.")
        ],
        coarse: Annotated[bool, typer.Option("--coarse", help="Coarse meshes.")] = False,
        fine: Annotated[bool, typer.Option("--fine", help="Fine meshes.")] = False,
        unit: Annotated[
            str | None, typer.Option(help="Of a file without its own: mm, cm, m, um, inch.")
        ] = None,
        base: Annotated[
            str | None, typer.Option(help="End that is held, as listed where it is left out.")
        ] = None,
        tip: Annotated[str | None, typer.Option(help="End that is moved.")] = None,
        y: Annotated[
            str | None, typer.Option(metavar="[X, Y, Z]", help="Bar's y axis in the file's frame.")
        ] = None,
        tie: Annotated[str | None, typer.Option(help="rigid (default), half or distributed.")] = None,
        modulus: Annotated[float | None, typer.Option("--E", help="Young's modulus, MPa.")] = None,
        nu: Annotated[float | None, typer.Option("--nu", help="Poisson's ratio.")] = None,
        size: Annotated[float | None, typer.Option(help="Mesh size, mm; default by thickness.")] = None,
        stiffness_only: Annotated[
            bool, typer.Option("--stiffness-only", help="Of a file K_b and its band by mesh alone, no page.")
        ] = False,
        json: Json = None,
        out: Annotated[
            Path | None, typer.Option(help="Folder of bar.json and its page; default results/NAME-bar.")
        ] = None,
        quiet: Annotated[bool, typer.Option("--quiet", help="No progress.")] = False,
    ) -> None:
        """One bar alone: K_b and K_g with their bands, critical loads, a page.

        FILE is a case with a section, a case whose table bar names a file, or the file: STEP, IGES, BREP or a mesh.
        Without --base and --tip its faces are listed, each with the text that names it.
        """
        from pipeline.bar.command import Asked
        from pipeline.bar.command import bar as compute

        options = {
            "unit": unit,
            "base": base,
            "tip": tip,
            "y": y,
            "tie": tie,
            "E": modulus,
            "nu": nu,
            "size": size,
        }
        guarded(
            lambda: compute(Asked(file, coarse, fine, stiffness_only, out, json, quiet, typed(), options))
        )

    app.command()(bar)
