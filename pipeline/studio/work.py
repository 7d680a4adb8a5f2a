"""What the studio asks for, done by the functions of the command line: campaign folder and model in, a page out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from pipeline.add.command import starting_model
from pipeline.add.fitting import Added, add
from pipeline.answer import Answer
from pipeline.campaign import read
from pipeline.diagnose.diagnosis import diagnose
from pipeline.diagnose.words import answered
from pipeline.discover.beyond_catalogue import with_laws
from pipeline.inference.model_file import NAME, ModelFile, model_text
from pipeline.inference.model_reading import read_model_file
from pipeline.inference.suitable import known_effects, named_effects
from pipeline.page.collect import Subject, collect
from pipeline.page.command import write_page
from pipeline.page.isolability import attempted_isolability
from pipeline.page.record import Isolability, Page
from pipeline.plan.command import plan_of
from pipeline.plan.record import Plan
from pipeline.provenance import commit, versions
from pipeline.typed import command

Say = Callable[[str], None]
Kind = Literal["open", "add", "remove", "diagnose", "plan", "export"]


@dataclass(frozen=True)
class Task:
    """What to do. model: text of a model.toml, None for the one of the campaign. at: folder for it, to which paths of
    the user's effects are relative. effects: to add, or the one to remove. out: folder of an exported report."""

    kind: Kind
    folder: Path
    at: Path
    model: str | None = None
    effects: tuple[str, ...] = ()
    effects_from: tuple[Path, ...] = ()
    answer: Answer | None = None
    isolability: Isolability | None = None
    out: Path | None = None


@dataclass(frozen=True)
class Done:
    """What came of it; None where the task does not change it. model, kept: text of a model.toml in the folder of the
    task and in that of the campaign, which differ in the paths of the user's effects. names: effects that are known.
    """

    kind: Kind
    model: str | None = None
    kept: str | None = None
    page: Page | None = None
    answer: Answer | None = None
    isolability: Isolability | None = None
    plan: Plan | None = None
    names: tuple[tuple[str, str], ...] = ()
    written: Path | None = None


def do(task: Task, say: Say) -> Done:
    """The task. InputError for bad input, RuntimeError where the numerics failed."""
    say("reading")
    campaign = read(task.folder)
    model_file = None
    if task.model is not None:
        model_file = task.at / NAME
        model_file.write_text(task.model, encoding="utf-8")
    model, known = starting_model(campaign, task.folder, model_file, known_effects(task.effects_from))
    saved = model_file or task.folder / NAME
    told = dict(read_model_file(saved, known).uncertainty) if saved.exists() else {}
    subject = Subject(campaign, model, known, told)
    if task.kind == "diagnose":
        found = with_laws(diagnose(campaign, model, known.effects, say), say)
        answer = answered(found)
        return Done("diagnose", answer=answer, isolability=attempted_isolability(found))
    if task.kind == "plan":
        return Done("plan", plan=plan_of(campaign, model, known.effects, say))
    if task.kind == "export":
        return _exported(task, subject, say)
    if task.kind == "add":
        return _changed(
            task, add(campaign, model, named_effects(task.effects, known.effects), say), subject, say
        )
    if task.kind == "remove":
        rest = model
        for name in task.effects:
            rest = rest.without(name)
        if rest.terms:
            return _changed(task, add(campaign, rest, [], say), subject, say)
        subject = replace(subject, model=rest, uncertainty={})
    return _shown(task, subject, say)


def _changed(task: Task, found: Added, subject: Subject, say: Say) -> Done:
    return _shown(task, replace(subject, model=found.model, uncertainty=found.uncertainty), say)


def _shown(task: Task, it: Subject, say: Say) -> Done:
    files = it.known.files_of(it.model.names)
    file = ModelFile(it.model, it.uncertainty, files, it.campaign.name, commit(), versions())
    return Done(
        task.kind,
        model_text(file, task.at),
        model_text(file, task.folder),
        collect(it, (), say),
        names=tuple((effect.name, effect.title) for effect in it.known.effects.values()),
    )


def _exported(task: Task, subject: Subject, say: Say) -> Done:
    answer = task.answer
    fits = answer is not None and set(answer.effects) == set(subject.model.names)
    shown = replace(subject, answer=answer, isolability=task.isolability) if fits else subject
    assert task.out is not None
    commands = (command("report", task.folder),)
    return Done("export", written=write_page(collect(shown, commands, say), task.out))
