"""What a result is about: a campaign, its model, the effects that are known; a pickle works in another process."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pipeline.campaign import Campaign, read
from pipeline.errors import InputError
from pipeline.face.equality import same
from pipeline.inference.model import Model, Term
from pipeline.inference.suitable import Known, known_effects
from vjm.effects import effect_of, shipped
from vjm.effects.base import Effect

Values = Mapping[str, float]


@dataclass(frozen=True, eq=False, repr=False)
class Subject:
    """campaign: rig, noise, tests with their readings. model: from which results begin. known: all effects that may be
    looked for, in sizes of the rig."""

    campaign: Campaign
    model: Model = field(default_factory=Model)
    known: Known = field(default_factory=known_effects)

    def with_model(self, model: Model) -> Subject:
        """The same campaign with another model."""
        return replace(self, model=model)

    def knowing(self, effects: Iterable[Effect]) -> Subject:
        """With effects of one's own besides. InputError for one whose name another one has."""
        more = {effect.name: effect for effect in effects}
        for name, effect in more.items():
            there = self.known.effects.get(name)
            if there is not None and type(there) is not type(effect):
                raise InputError(f"effect {name} is taken, allowed is a name of its own")
        known = Known({**self.known.effects, **more}, self.known.files).sized(self.campaign)
        return replace(self, known=known)

    def __eq__(self, other: object) -> bool:
        return same(self, other)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Callable[..., Subject], tuple[Any, ...]]:
        files = tuple(dict.fromkeys(self.known.files.values()))
        own = {
            name: effect
            for name, effect in self.known.effects.items()
            if name not in self.known.files and not shipped(effect)
        }
        terms = tuple((term.effect.name, dict(term.values)) for term in self.model.terms)
        return _again, (self.campaign, files, own, terms, self.model.fixed, self.model.nominals)


def _again(
    campaign: Campaign,
    files: tuple[Path, ...],
    own: Mapping[str, Effect],
    terms: tuple[tuple[str, Values], ...],
    fixed: frozenset[str],
    nominals: tuple[Term, ...],
) -> Subject:
    """As it was pickled; files with effects are run again, as their classes have no place to be found at."""
    known = known_effects(files)
    known = Known({**known.effects, **own}, known.files).sized(campaign)
    found = tuple(Term(effect_of(name, known.effects), values) for name, values in terms)
    return Subject(campaign, Model(found, fixed, nominals), known)


def campaign_of(folder: str | Path) -> Campaign:
    """The campaign in a folder: rig, noise of the sensors, tests with their readings, all in N, mm, rad and °C.

    InputError with every mistake in campaign.toml and in the files of readings: file, line, key or column, what was
    found and what is allowed. Nothing is written.
    """
    return read(Path(folder))
