"""`add` from the command line: campaign and model in; terminal, JSON and model.toml out."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pipeline.add.fitting import Added, add, remove
from pipeline.answer.tables.added import show
from pipeline.campaign import Campaign, read
from pipeline.command import usable
from pipeline.inference.model import Model
from pipeline.inference.model_file import NAME, ModelFile, write_model
from pipeline.inference.model_reading import read_model_file
from pipeline.inference.suitable import Known, known_effects, named_effects
from pipeline.progress import Progress
from pipeline.provenance import commit, versions
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
    known = known_effects(effects_from)
    campaign = read(folder)
    began, known = starting_model(campaign, folder, model_file, known)
    effects = named_effects(names, known.effects)
    for path, named in (
        (folder, f"the model in {folder}"),
        (json and json.parent, f"--json {json}"),
        (out, f"--out {out}"),
    ):
        if path is not None:
            usable(path, named)
    progress = Progress(quiet)
    with progress.stage(f"adding {', '.join(names)}") as stage:
        found = add(campaign, began, effects, stage.say)
        stage.note = f"{found.answer.evaluations} evaluations"
    answer = found.answer.model_copy(update={"seed": seed})
    saved = not found.keep or (force and answer.verdict != "nothing_tested")
    if saved:
        save(folder / NAME, found, campaign, known)
    if json is not None:
        answer.write(json)
    if out is not None:
        answer.write(out / "answer.json")
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
    campaign = read(folder)
    began, known = starting_model(campaign, folder, model_file, known_effects(effects_from))
    usable(folder, f"the model in {folder}")
    if json is not None:
        usable(json.parent, f"--json {json}")
    progress = Progress(quiet)
    with progress.stage(f"removing {', '.join(names)}") as stage:
        found = remove(campaign, began, names, stage.say)
    save(folder / NAME, found, campaign, known)
    if json is not None:
        found.answer.write(json)
    show(found.answer, str(folder / NAME), [command("compare", folder)], quiet)


def starting_model(
    campaign: Campaign, folder: Path, model_file: Path | None, known: Known
) -> tuple[Model, Known]:
    """The model to begin with, and all effects that are known then."""
    known = known.sized(campaign)
    path = model_file or folder / NAME
    if model_file is None and not path.exists():
        return Model(), known
    saved = read_model_file(path, known, campaign.rig)
    return saved.model, known_effects(saved.effects_from, known)


def save(path: Path, found: Added, campaign: Campaign, known: Known) -> None:
    """Write the model with where it comes from."""
    files = known.files_of(found.model.names)
    it = ModelFile(found.model, found.uncertainty, files, campaign.name, commit(), versions())
    write_model(path, it)
