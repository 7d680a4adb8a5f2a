"""The command `export` on the command line: wiring only."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from pipeline.export.formats import names
from pipeline.options import EffectsFrom, ModelFile


def register(app: typer.Typer, guarded: Callable[[Callable[[], object]], None]) -> None:
    """Add the command; guarded: turns what went wrong into one sentence and an exit code."""

    def export(
        source: Annotated[
            Path,
            typer.Argument(
                metavar="CAMPAIGN|RESULT", help="A campaign's folder, result.json of run, bar.json of bar."
            ),
        ],
        out: Annotated[Path, typer.Argument(metavar="OUT", help="File to write.")],
        to: Annotated[str, typer.Option("--to", metavar="FORMAT", help=f"One of {', '.join(names())}.")],
        q: Annotated[
            float | None,
            typer.Option("--q", metavar="DEG", help="The parallelogram at this angle; default its bar."),
        ] = None,
        model: ModelFile = None,
        effects_from: EffectsFrom = None,
        quiet: Annotated[bool, typer.Option("--quiet", help="Only the names of the files.")] = False,
    ) -> None:
        """K_b of the bar, K_p of the parallelogram, for other programs.

        json, npz, mat hold all of it, K_p at every angle of the source.
        inp: CalculiX (six springs and equations), beside it Abaqus (a user element).
        dmig: Nastran. mjcf: MuJoCo. exudyn: a Python module of Exudyn.
        urdf: kinematics alone; the stiffness is in a .json beside it.
        What a format cannot hold is said, and stands at the head of the file.
        A file that is there already and holds something else is not replaced.
        """
        from pipeline.export.command import export as write
        from pipeline.export.source import Sources

        guarded(lambda: write(Sources(source, q, model, effects_from or []), to, out, quiet))

    app.command()(export)
