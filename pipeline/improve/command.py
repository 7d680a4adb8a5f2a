"""`improve` from the command line: a waterfall that grows while it works, the model saved step by step."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.live import Live

from pipeline.answer.of_diagnosis import answered
from pipeline.answer.record import Answer
from pipeline.answer.summary import uncertainty_of
from pipeline.campaign import Campaign
from pipeline.command import usable, usable_places
from pipeline.discover.beyond_catalogue import with_laws
from pipeline.improve.steps import Step, steps
from pipeline.improve.table import closing, following, waterfall
from pipeline.inference.model import Model
from pipeline.inference.model_file import NAME, Uncertainty, fitted_now, write_model
from pipeline.inference.suitable import Known
from pipeline.opened import opened
from pipeline.progress import Progress
from pipeline.selection.diagnosis import Diagnosis, diagnose
from pipeline.terminal import terminal


def improve_campaign(
    folder: Path,
    model_file: Path | None = None,
    effects_from: Sequence[Path] = (),
    json: Path | None = None,
    out: Path | None = None,
    seed: int | None = None,
    quiet: bool = False,
) -> Answer:
    """Diagnose, add what is certain one by one, save the model with the campaign. InputError for bad input.

    out: folder for the answer and for the model of every step, to go back to with --model.
    """
    campaign, began, known = opened(folder, model_file, effects_from)
    usable(folder, f"the model in {folder}")
    usable_places(out, json=json)
    progress = Progress(quiet)
    with progress.stage("looking for what is missing") as stage:
        found = with_laws(diagnose(campaign, began, known.effects, stage.say), stage.say)
        stage.note = f"{len(found.cache.fits)} models fitted"
    done = _watched(found, quiet)
    last = done[-1].fit
    answer = improved(found, began, done).model_copy(update={"seed": seed})
    saved = last.model.freed(began)
    if answer.added:
        _write(folder / NAME, saved, uncertainty_of(answer.parameters, saved), campaign, known)
    if out is not None:
        for number, step in enumerate(done):
            _write(out / f"step_{number}.toml", step.fit.model.freed(began), {}, campaign, known)
    answer.write(json, out and out / "answer.json")
    # On a terminal the steps stand there already.
    told = [] if quiet or terminal().is_terminal else [waterfall(campaign.name, done)]
    going_on = following(answer, found.verdict, folder, out)
    closing(answer, found, str(folder / NAME), going_on, quiet, told)
    return answer


def improved(found: Diagnosis, began: Model, done: Sequence[Step]) -> Answer:
    """The answer after all steps of a diagnosis that began with a model."""
    last = done[-1].fit
    answer = answered(found, last)
    return answer.model_copy(
        update={
            "verdict": "within_noise" if answer.verdict == "identified" else answer.verdict,
            "effects": last.model.names,
            "added": tuple(name for name in last.model.names if name not in began.names),
            "error": tuple(step.error for step in done),
        }
    )


def _watched(found: Diagnosis, quiet: bool) -> list[Step]:
    """All steps; on a terminal shown as they come."""
    done: list[Step] = []
    console = terminal()
    if quiet or not console.is_terminal:
        return list(steps(found))
    with Live(waterfall(found.campaign.name, done), console=console) as live:
        for step in steps(found):
            done.append(step)
            live.update(waterfall(found.campaign.name, done))
    return done


def _write(path: Path, model: Model, told: dict[str, Uncertainty], campaign: Campaign, known: Known) -> None:
    write_model(path, fitted_now(model, told, known, campaign.name))
