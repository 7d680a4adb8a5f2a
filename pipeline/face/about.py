"""Results that are about a bench, and everything that a function may be given in the place of one."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from pipeline.campaign import Campaign
from pipeline.errors import InputError
from pipeline.face.shown import Drawn
from pipeline.face.subject import Subject, campaign_of
from pipeline.inference.model import Model
from pipeline.inference.suitable import known_effects, named_effects
from pipeline.opened import starting_model
from vjm.effects.base import Effect


@dataclass(frozen=True, eq=False, repr=False)
class AboutBench(Drawn):
    """A result about a bench. subject: its campaign, the model that goes on from here, the effects that are known."""

    subject: Subject

    @property
    def name(self) -> str:
        """Of the campaign."""
        return self.subject.campaign.name


Given: TypeAlias = AboutBench | Subject | Campaign | str | Path
"""A bench, any result about one, a campaign that was read, or the folder of one."""


def subject_of(given: Given) -> Subject:
    """What a function is asked about; of a folder with the model that is kept there. InputError for a folder that is
    no campaign."""
    if isinstance(given, AboutBench):
        return given.subject
    if isinstance(given, Subject):
        return given
    if isinstance(given, Campaign):
        return Subject(given, Model(), known_effects().sized(given))
    if not isinstance(given, str | Path):
        raise InputError(
            f"{given!r} is no bench, allowed are a bench, a result about one, a campaign, a folder"
        )
    return opened(Path(given))


def opened(folder: Path, model: Path | None = None, effects: Iterable[str | Path | Effect] = ()) -> Subject:
    """The campaign in a folder with its model and effects of one's own: files that define them, or the effects."""
    every = list(effects)
    files = [Path(it) for it in every if isinstance(it, str | Path)]
    campaign = campaign_of(folder)
    began, known = starting_model(campaign, folder, model, known_effects(files))
    found = Subject(campaign, began, known.sized(campaign))
    return found.knowing(it for it in every if isinstance(it, Effect))


def effects_of(subject: Subject, effects: Iterable[str | Effect]) -> tuple[Subject, list[Effect]]:
    """Effects by name, or as they are given, and a subject that knows them all. InputError for a name that is
    unknown."""
    every = list(effects)
    if wrong := [it for it in every if not isinstance(it, str | Effect)]:
        raise InputError(f"{wrong[0]!r} is no effect, allowed are names and effects, one after another")
    subject = subject.knowing(it for it in every if isinstance(it, Effect))
    names = [it.name if isinstance(it, Effect) else it for it in every]
    return subject, named_effects(names, subject.known.effects)
