"""The command compare: a campaign folder in, the comparison on the terminal and in a file out."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshes.files import replacing
from pipeline.campaign import Campaign, read
from pipeline.campaign.reading import DESCRIPTION, MEASUREMENTS
from pipeline.command import usable
from pipeline.compare.models import compare_models
from pipeline.compare.record import Comparison
from pipeline.compare.table import sentence, show
from pipeline.errors import InputError
from pipeline.inference.model import Model
from pipeline.inference.model_reading import read_model_file
from pipeline.inference.suitable import known_effects
from pipeline.progress import Progress
from pipeline.typed import command

MODEL = "model.toml"
RESULT = "comparison.json"


def compare(
    folder: Path,
    model: Path | None = None,
    json: Path | None = None,
    out: Path | None = None,
    quiet: bool = False,
    effects_from: Sequence[Path] = (),
    full: bool = False,
) -> Comparison:
    """Compare, print, and write where it was asked for; the campaign is not touched.

    model: file of a saved model; default that of the campaign, if it has one. full: every test, not only those of a
    screen. InputError for a campaign, a model or a place to write that cannot be used.
    """
    places = [place for place in (json, out / RESULT if out else None) if place is not None]
    for place in places:
        usable(place.parent, f"the folder of {place}")
        _spares(place, folder)
    campaign = read(folder)
    saved = _saved(folder, model, effects_from, campaign)
    progress = Progress(quiet)
    with progress.stage("compare") as stage:
        result = compare_models(campaign, saved, stage.say)
    for place in places:
        with replacing(place) as part:
            part.write_text(result.model_dump_json(indent=1), encoding="utf-8")
    if quiet:
        print(sentence(result))
    else:
        show(result, full=full)
        shown = result.model_of(result.shown)
        if not shown.within_noise and not shown.untested:
            print(f"next: {command('diagnose', folder)}")
    return result


def _saved(
    folder: Path, model: Path | None, effects_from: Sequence[Path], campaign: Campaign
) -> Model | None:
    path, known = model or folder / MODEL, known_effects(effects_from).sized(campaign)
    if model is None and not path.exists():
        return None
    return read_model_file(path, known, campaign.rig).model


def _spares(place: Path, folder: Path) -> None:
    """InputError for a result in the place of a file of the campaign."""
    if place.resolve() in [(folder / name).resolve() for name in (DESCRIPTION, MEASUREMENTS, MODEL)]:
        raise InputError(f"{place} is a file of the campaign, allowed is another name")
