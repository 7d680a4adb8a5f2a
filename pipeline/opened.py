"""A campaign as commands take it, with the model that it begins with and the effects that are known to it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from pipeline.campaign import Campaign, read
from pipeline.inference.model import Model
from pipeline.inference.model_file import NAME
from pipeline.inference.model_reading import read_model_file
from pipeline.inference.suitable import Known, known_effects


def opened(
    folder: Path, model_file: Path | None = None, effects_from: Iterable[Path] = ()
) -> tuple[Campaign, Model, Known]:
    """The campaign in a folder, and the rest as of `starting_model`. InputError for bad input."""
    known = known_effects(effects_from)
    campaign = read(folder)
    return campaign, *starting_model(campaign, folder, model_file, known)


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
