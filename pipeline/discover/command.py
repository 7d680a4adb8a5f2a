"""`discover` from the command line: campaign and model in; terminal, JSON, pictures and an effect file out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

from meshes.files import replacing
from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.campaign.order import by_name
from pipeline.command import usable_places
from pipeline.discover.effect_file import effect_text, name_of, write_effect
from pipeline.discover.record import Discovered
from pipeline.discover.recording import recorded
from pipeline.discover.search import GEOMETRY, Discovery, discover
from pipeline.discover.table import show
from pipeline.discover.words import sentences
from pipeline.errors import InputError
from pipeline.inference.declared_sigmas import trusted_and_fit
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.suitable import Known, check_suitable
from pipeline.opened import opened
from pipeline.progress import Progress
from pipeline.selection.diagnosis import suitable
from pipeline.typed import command


@dataclass(frozen=True)
class Asked:
    """What the command line asks for."""

    folder: Path
    model: Path | None = None
    effects_from: Sequence[Path] = ()
    write: Path | None = None
    json: Path | None = None
    out: Path | None = None
    seed: int | None = None
    quiet: bool = False


def discover_laws(asked: Asked) -> Discovered:
    """Discover and print. InputError for bad input, and for a rig without places of laws."""
    campaign, began, known = opened(asked.folder, asked.model, asked.effects_from)
    _check(asked)
    with Progress(asked.quiet).stage("looking for laws") as stage:
        found = laws_found(campaign, began, known, stage.say)
        stage.note = f"{len(found.record.laws)} found"
    found = replace(found, record=found.record.model_copy(update={"seed": asked.seed}))
    following = _written(asked, found)
    show(found.record, following, asked.quiet)
    return found.record


@dataclass(frozen=True)
class LawsFound:
    """record: with all of it in words. effects: names of all that entered the model, laws by those of their effect
    file, in order. effect_file: its text, "" where no law in the mechanism was found."""

    record: Discovered
    effects: tuple[str, ...]
    effect_file: str


def laws_found(
    campaign: Campaign, model: Model, known: Known, on_progress: OnProgress = lambda _: None
) -> LawsFound:
    """What is found from a model on. InputError as of `searched`."""
    begin = perf_counter()
    found, whole = searched(campaign, model, known, on_progress)
    record = recorded(found, whole, perf_counter() - begin)
    record = record.model_copy(update={"sentences": sentences(record)})
    text = effect_text(found, record) if any(law.ways for law in found.laws) else ""
    return LawsFound(record, _effects(found, record), text)


def _effects(found: Discovery, record: Discovered) -> tuple[str, ...]:
    names = [GEOMETRY] if found.bent else []
    names += [each.effect for each in record.entered]
    return (*names, *(name_of(law.ways[0]) for law in found.laws if law.ways))


def searched(
    campaign: Campaign, model: Model, known: Known, on_progress: OnProgress = lambda _: None
) -> tuple[Discovery, Campaign]:
    """What is found in the tests that may be fitted, and the campaign with all that it lacks of sigmas."""
    check_suitable([term.effect for term in model.terms], campaign)
    whole, _ = trusted_and_fit(completed(by_name(campaign)), model, None)
    effects, _ = suitable(whole, model, known.effects)
    fitted = tuple(test for test in whole.tests if test.role == "fit")
    if not fitted:
        raise InputError(
            f'{campaign.name} has no test that may be fitted, allowed is one with role = "fit" in campaign.toml'
        )
    try:
        found = discover(load_cases(replace(whole, tests=fitted)), model, effects, on_progress)
    except ValueError as error:
        raise InputError(f"{campaign.name}: {error}") from error
    return found, whole


def _check(asked: Asked) -> None:
    if asked.write is not None and asked.write.suffix != ".py":
        raise InputError(f"--write {asked.write} is no Python file, allowed is a name that ends with .py")
    usable_places(asked.out, json=asked.json, write=asked.write)


def _written(asked: Asked, found: LawsFound) -> list[str]:
    """Writes what was asked for; commands that go on from there."""
    record = found.record
    record.write(asked.json, asked.out and asked.out / "laws.json")
    if asked.out is not None:
        from reports.laws import drawn

        for name, content in drawn(record.model_dump()).items():
            with replacing(asked.out / name) as part:
                part.write_bytes(content)
    if not found.effect_file:
        return []
    if asked.write is None:
        return [command("discover", asked.folder, "--write", "law.py")]
    write_effect(asked.write, found.effect_file)
    return [command("add", asked.folder, *found.effects, "--effects-from", asked.write)]
