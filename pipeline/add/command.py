"""`add` from the command line: campaign and model in; terminal, JSON and model.toml out."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pipeline.add.fitting import Added, add, remove
from pipeline.answer.tables.added import show
from pipeline.campaign import Campaign
from pipeline.command import usable, usable_places
from pipeline.inference.model_file import NAME, fitted_now, write_model
from pipeline.inference.suitable import Known, named_effects
from pipeline.opened import opened
from pipeline.progress import Progress
from pipeline.typed import command


def add_effects(
    folder: Path,
    names: Sequence[str],
    model_file: Path | None = None,
    effects_from: Sequence[Path] = (),
    json: Path | None = None,
    out: Path | None = None,
    seed: int | None = None,
    quiet: bool = False,
    force: bool = False,
) -> None:
    """Add effects to the model of the campaign in a folder, save it there, print what changed.

    The model is that of `model_file`, else the one in the folder, else plain virtual springs. One that is no better
    than the model before is saved only by `force`, one of which nothing was tested never. InputError for bad input;
    nothing is written then.
    """
    campaign, began, known = opened(folder, model_file, effects_from)
    effects = named_effects(names, known.effects)
    usable(folder, f"the model in {folder}")
    usable_places(out, json=json)
    progress = Progress(quiet)
    with progress.stage(f"adding {', '.join(names)}") as stage:
        found = add(campaign, began, effects, stage.say)
        stage.note = f"{found.answer.evaluations} evaluations"
    answer = found.answer.model_copy(update={"seed": seed})
    saved = not found.keep or (force and answer.verdict != "nothing_tested")
    if saved:
        save(folder / NAME, found, campaign, known)
    answer.write(json, out and out / "answer.json")
    following = [command("compare", folder)]
    if answer.verdict != "within_noise":
        following.append(command("diagnose", folder))
    show(answer, str(folder / NAME) if saved else f"not saved, {found.keep}", following, quiet)


def remove_effects(
    folder: Path,
    names: Sequence[str],
    model_file: Path | None = None,
    effects_from: Sequence[Path] = (),
    json: Path | None = None,
    quiet: bool = False,
) -> None:
    """Take effects out of the model of the campaign in a folder, save it there, print what changed.

    InputError for bad input; nothing is written then.
    """
    campaign, began, known = opened(folder, model_file, effects_from)
    usable(folder, f"the model in {folder}")
    usable_places(json=json)
    progress = Progress(quiet)
    with progress.stage(f"removing {', '.join(names)}") as stage:
        found = remove(campaign, began, names, stage.say)
    save(folder / NAME, found, campaign, known)
    found.answer.write(json)
    show(found.answer, str(folder / NAME), [command("compare", folder)], quiet)


def save(path: Path, found: Added, campaign: Campaign, known: Known) -> None:
    """Write the model with where it comes from."""
    write_model(path, fitted_now(found.model, found.uncertainty, known, campaign.name))
