"""The command `predict` on the command line: wiring only."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from pipeline.options import CampaignFolder, EffectsFrom, Json, ModelFile


def register(app: typer.Typer, guarded: Callable[[Callable[[], object]], None]) -> None:
    """Add the command; guarded: turns what went wrong into one sentence and an exit code."""

    def predict(
        campaign: CampaignFolder,
        at: Annotated[
            Path | None,
            typer.Option("--at", metavar="TABLE.csv", help="Load cases; default the campaign's own rows."),
        ] = None,
        model: ModelFile = None,
        effects_from: EffectsFrom = None,
        compensation: Annotated[
            Path | None,
            typer.Option(
                "--compensation", metavar="FILE.csv", help="Correction table: deflection of each row."
            ),
        ] = None,
        json: Json = None,
        out: Annotated[
            Path | None, typer.Option(help="Folder for predictions.csv, predictions.json and pictures.")
        ] = None,
        seed: Annotated[int, typer.Option(min=0, help="Of the samples, where intervals need them.")] = 0,
        quiet: Annotated[bool, typer.Option("--quiet", help="Only the first sentence.")] = False,
    ) -> None:
        """Readings of the model with 95 % intervals, at the campaign's rows or those of a table.

        An interval has three parts: of the fitted parameters, of what is
        written about the rig (its tolerances), and of the noise.
        TABLE.csv has the columns of measurements.csv that are prescribed,
        with the id of a test, or q_deg (at_x_mm, at_y_mm, at_z_mm), and
        numbers of the rig such as length_mm. Rows in order are one history.
        """
        from pipeline.predict.command import Asking, predict_readings

        guarded(
            lambda: predict_readings(
                Asking(campaign, at, model, effects_from or (), compensation, json, out, seed, quiet)
            )
        )

    app.command()(predict)
