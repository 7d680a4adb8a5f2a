"""What the studio asks for, done by the functions of the command line: campaign folder and model in, a page out."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from pipeline.add.fitting import Added, add
from pipeline.answer.of_diagnosis import answered
from pipeline.answer.record import Answer
from pipeline.answer.summary import uncertainty_of
from pipeline.callbacks import OnProgress
from pipeline.campaign import read
from pipeline.campaign.reading import DESCRIPTION
from pipeline.discover.beyond_catalogue import with_laws
from pipeline.discover.command import LawsFound, laws_found
from pipeline.inference.model_file import NAME, fitted_now, model_text
from pipeline.inference.model_reading import read_model_file
from pipeline.inference.suitable import known_effects, named_effects
from pipeline.init.choices import Choices, filled
from pipeline.init.command import found_in
from pipeline.init.found import Found
from pipeline.opened import starting_model
from pipeline.page.collect import Subject, collect, shown_model
from pipeline.page.command import of_diagnosis, write_page
from pipeline.page.record import Isolability, Page
from pipeline.page.rivals import possible
from pipeline.plan.command import plan_of
from pipeline.plan.record import Plan
from pipeline.selection.diagnosis import diagnose
from pipeline.selection.mending import Mend, mends
from pipeline.studio.preview import Preview, preview_of
from pipeline.typed import command

Kind = Literal["open", "add", "remove", "diagnose", "discover", "plan", "export", "look", "preview"]


@dataclass(frozen=True)
class Task:
    """What to do. model: text of a model.toml, None for the one of the campaign. at: folder for it, to which paths of
    the user's effects are relative. effects: to add, or the one to remove. page, out: what is exported, and where.
    file, choices: a table that is to become a campaign in `at`. tolerance: of the rig, in the place of what is written.
    """

    kind: Kind
    folder: Path
    at: Path
    model: str | None = None
    effects: tuple[str, ...] = ()
    effects_from: tuple[Path, ...] = ()
    page: Page | None = None
    out: Path | None = None
    file: Path | None = None
    choices: Choices | None = None
    tolerance: tuple[tuple[str, float], ...] | None = None


@dataclass(frozen=True)
class Proposal:
    """What a diagnosis would make of the model: shown as it would be, and accepted or not. model, kept: as in `Done`;
    answer: the record of this very set."""

    page: Page
    model: str
    kept: str
    answer: Answer


@dataclass(frozen=True)
class Done:
    """What came of it; None where the task does not change it. model, kept: text of a model.toml in the folder of the
    task and in that of the campaign, which differ in the paths of the user's effects. names: effects that are known.
    proposals: of a diagnosis, one for each set that it leaves possible, the simplest first; where it adds nothing the
    one is the model as it is. mends: what campaign.toml can say of what the doctor found.
    """

    kind: Kind
    model: str | None = None
    kept: str | None = None
    page: Page | None = None
    answer: Answer | None = None
    isolability: Isolability | None = None
    proposals: tuple[Proposal, ...] = ()
    mends: tuple[Mend, ...] = ()
    laws: LawsFound | None = None
    plan: Plan | None = None
    names: tuple[tuple[str, str], ...] = ()
    written: Path | None = None
    found: Found | None = None
    preview: Preview | None = None


def do(task: Task, on_progress: OnProgress) -> Done:
    """The task. InputError for bad input, RuntimeError where the numerics failed."""
    on_progress("reading")
    if task.kind == "export":
        return _exported(task)
    if task.kind in ("look", "preview"):
        return _table(task)
    campaign = read(task.folder)
    if task.tolerance is not None:
        campaign = replace(campaign, tolerance=dict(task.tolerance))
    model_file = None
    if task.model is not None:
        model_file = task.at / NAME
        model_file.write_text(task.model, encoding="utf-8")
    model, known = starting_model(campaign, task.folder, model_file, known_effects(task.effects_from))
    saved = model_file or task.folder / NAME
    told = dict(read_model_file(saved, known).uncertainty) if saved.exists() else {}
    subject = Subject(campaign, model, known, told)
    if task.kind == "diagnose":
        return _diagnosed(task, subject, on_progress)
    if task.kind == "discover":
        return Done("discover", laws=laws_found(campaign, model, known, on_progress))
    if task.kind == "plan":
        return Done("plan", plan=plan_of(campaign, model, known.effects, on_progress))
    return _model(task, subject, on_progress)


def _model(task: Task, subject: Subject, on_progress: OnProgress) -> Done:
    """The model as it is, or with effects more or fewer."""
    campaign, model, known = subject.campaign, subject.model, subject.known
    if task.kind == "add":
        return _changed(
            task,
            add(campaign, model, named_effects(task.effects, known.effects), on_progress),
            subject,
            on_progress,
        )
    if task.kind == "remove":
        rest = model
        for name in task.effects:
            rest = rest.without(name)
        if rest.terms:
            return _changed(task, add(campaign, rest, [], on_progress), subject, on_progress)
        subject = replace(subject, model=rest, uncertainty={})
    return _shown(task, subject, on_progress)


def _diagnosed(task: Task, subject: Subject, on_progress: OnProgress) -> Done:
    """The answer, and every set that it leaves possible drawn as the model would be with it."""
    found = with_laws(
        diagnose(subject.campaign, subject.model, subject.known.effects, on_progress), on_progress
    )
    sets = possible(found, answered(found), on_progress)
    zero = found.decision.zero
    seen = of_diagnosis(subject, found, sets)
    shown = [replace(seen, answer=each.answer, fitted=each.fit) for each in sets]
    return Done(
        "diagnose",
        answer=sets[0].answer,
        isolability=seen.isolability,
        proposals=tuple(_proposal(task, it, on_progress) for it in shown),
        mends=mends(task.folder, found.doctor, None if zero is None else zero.zero),
    )


def _proposal(task: Task, it: Subject, on_progress: OnProgress) -> Proposal:
    """The model with the set of an answer."""
    answer, model = it.answer, shown_model(it).freed(it.model)
    assert answer is not None
    file = fitted_now(model, uncertainty_of(answer.parameters, model), it.known, it.campaign.name)
    page = collect(it, (), on_progress)
    return Proposal(page, model_text(file, task.at), model_text(file, task.folder), answer)


def _changed(task: Task, found: Added, subject: Subject, on_progress: OnProgress) -> Done:
    return _shown(task, replace(subject, model=found.model, uncertainty=found.uncertainty), on_progress)


def _shown(task: Task, it: Subject, on_progress: OnProgress) -> Done:
    file = fitted_now(it.model, it.uncertainty, it.known, it.campaign.name)
    return Done(
        task.kind,
        model_text(file, task.at),
        model_text(file, task.folder),
        collect(it, (), on_progress),
        names=tuple((effect.name, effect.title) for effect in it.known.effects.values()),
    )


def _table(task: Task) -> Done:
    """What a table says by itself, or with what its owner said of it; then a campaign is laid beside the table."""
    assert task.file is not None
    found = found_in(task.file)
    if task.choices is None:
        return Done("look", found=found)
    text = filled(task.file.name, found, task.choices)
    (task.file.parent / DESCRIPTION).write_text(text, encoding="utf-8")
    return Done("preview", preview=preview_of(read(task.file.parent)))


def _exported(task: Task) -> Done:
    """The page that is seen, and no other."""
    assert task.out is not None and task.page is not None
    page = task.page.model_copy(update={"commands": (command("report", task.folder),)})
    return Done("export", written=write_page(page, task.out))
