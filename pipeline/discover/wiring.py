"""The command `discover` on the command line: wiring only."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from pipeline.options import CampaignFolder, EffectsFrom, Json, ModelFile


def register(app: typer.Typer, guarded: Callable[[Callable[[], object]], None]) -> None:
    """Add the command; guarded: turns what went wrong into one sentence and an exit code."""

    def discover(
        campaign: CampaignFolder,
        write: Annotated[
            Path | None, typer.Option("--write", metavar="EFFECT.py", help="Effect file of the laws.")
        ] = None,
        model: ModelFile = None,
        effects_from: EffectsFrom = None,
        json: Json = None,
        out: Annotated[Path | None, typer.Option(help="Folder for laws.json and pictures.")] = None,
        seed: Annotated[int | None, typer.Option(help="Kept with the laws; nothing here is random.")] = None,
        quiet: Annotated[bool, typer.Option("--quiet", help="Only the first sentence.")] = False,
    ) -> None:
        """Where in the linkage the rest sits, and what law it follows.

        For what no effect of the catalogue explains: every place of the
        linkage is asked whether one function there, shared by all tests,
        explains what is left. The law that is found goes into the
        mechanism, is fitted there, and the next is looked for.
        --write makes an effect file of the laws, which add takes.
        """
        from pipeline.discover.command import Asked, discover_laws

        guarded(
            lambda: discover_laws(Asked(campaign, model, effects_from or (), write, json, out, seed, quiet))
        )

    app.command()(discover)
