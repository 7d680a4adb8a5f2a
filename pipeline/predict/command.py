"""`predict` from the command line: campaign, model and a table of load cases in; terminal, CSV, JSON, pictures out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.command import usable_places
from pipeline.errors import InputError
from pipeline.inference.model import Model
from pipeline.opened import opened
from pipeline.predict.asked import Asked, own_rows, read_table
from pipeline.predict.files import compensation_table, readings_table
from pipeline.predict.predicting import fitted_to, predicted
from pipeline.predict.record import Predictions
from pipeline.predict.recording import recorded
from pipeline.predict.table import show
from pipeline.predict.words import about, sentences
from pipeline.progress import Progress
from pipeline.saving import put

CSV, JSON = "predictions.csv", "predictions.json"


@dataclass(frozen=True)
class Asking:
    """What the command line asks for."""

    folder: Path
    at: Path | None = None
    model: Path | None = None
    effects_from: Sequence[Path] = ()
    compensation: Path | None = None
    json: Path | None = None
    out: Path | None = None
    seed: int = 0
    quiet: bool = False


def predict_readings(asking: Asking) -> Predictions:
    """Predict and print. InputError for bad input; nothing is written then."""
    campaign, model, _ = opened(asking.folder, asking.model, asking.effects_from)
    asked = own_rows(campaign) if asking.at is None else read_table(asking.at, campaign)
    _check(asking)
    with Progress(asking.quiet).stage("predict") as stage:
        record = predictions_of(campaign, model, asked, asking.seed, stage.say)
    show(record, _written(asking, record), asking.quiet)
    return record


def predictions_of(
    campaign: Campaign, model: Model, asked: Asked, seed: int = 0, on_progress: OnProgress = lambda _: None
) -> Predictions:
    """The model fitted, then the readings that are asked for, with their sentences. seed: of the samples, where these
    are needed. InputError for an effect that the campaign cannot have."""
    begin = perf_counter()
    fitted = fitted_to(campaign, model, on_progress)
    found = predicted(fitted, asked, seed, on_progress)
    record = recorded(found, perf_counter() - begin, seed)
    remarks = (*about(found), *asked.remarks, *fitted.whole.remarks)
    return record.model_copy(update={"sentences": sentences(record, remarks, fitted.untested)})


def _check(asking: Asking) -> None:
    usable_places(asking.out, json=asking.json, compensation=asking.compensation)
    for path in (asking.json, asking.compensation):
        if path is not None and path.resolve().parent == asking.folder.resolve():
            raise InputError(
                f"{path} is in the campaign's folder, which stays as it is; allowed is another one"
            )


def _written(asking: Asking, it: Predictions) -> list[str]:
    """Writes what was asked for; sentences that say where."""
    said = []
    if asking.compensation is not None:
        put(asking.compensation, compensation_table(it).encode())
        said.append(f"correction to be subtracted: {asking.compensation}")
    it.write(asking.json, asking.out and asking.out / JSON)
    if asking.out is not None:
        from reports.prediction import drawn

        put(asking.out / CSV, readings_table(it).encode())
        for name, content in drawn(it.model_dump()).items():
            put(asking.out / name, content)
        said.append(f"every reading: {asking.out / CSV}")
    return said
