"""Arguments and options of the command line that several commands have."""

from pathlib import Path
from typing import Annotated

import typer

CampaignFolder = Annotated[
    Path, typer.Argument(metavar="CAMPAIGN", help="Folder with campaign.toml and measurements.csv.")
]
ModelFile = Annotated[
    Path | None, typer.Option("--model", help="Saved model; default model.toml of the campaign, if there.")
]
EffectsFrom = Annotated[
    list[Path] | None,
    typer.Option("--effects-from", help="Python file with an effect of your own; repeatable."),
]
Json = Annotated[Path | None, typer.Option("--json", help="File for the whole result.")]
LogFile = Annotated[
    Path | None,
    typer.Option(
        "--log", metavar="FILE", help="What is fitted, step by step, is written at the end of this file."
    ),
]
