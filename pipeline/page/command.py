"""`report` of a campaign: its folder in; page.json, index.html, report.md and pictures out, the campaign untouched."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pydantic import ValidationError

from meshes.files import replacing
from pipeline.answer.of_diagnosis import answered
from pipeline.answer.record import Answer
from pipeline.campaign.reading import DESCRIPTION
from pipeline.command import redraw, usable
from pipeline.discover.beyond_catalogue import with_laws
from pipeline.errors import InputError
from pipeline.inference.model_file import NAME as MODEL
from pipeline.inference.model_reading import read_model_file
from pipeline.opened import opened
from pipeline.page.collect import Subject, collect
from pipeline.page.isolability import attempted_isolability, isolability_anew
from pipeline.page.record import NAME, Page
from pipeline.page.rivals import Possible, pages_of, possible
from pipeline.progress import Progress, Stage
from pipeline.selection.diagnosis import Diagnosis, diagnose
from pipeline.typed import command
from vjm.effects import effect_named

RESULTS, RESULT = Path("results"), "result.json"


def report_of(
    path: Path,
    out: Path | None = None,
    model_file: Path | None = None,
    effects_from: Sequence[Path] = (),
    diagnosing: bool = False,
    answer: Path | None = None,
    quiet: bool = False,
) -> None:
    """Of a campaign, or of whatever result is saved in a folder. InputError for bad input."""
    kept = next((name for name in (NAME, RESULT) if (path / name).exists()), None)
    if kept is None and path.is_dir() and not (path / DESCRIPTION).exists():
        said = f"has no {DESCRIPTION}, {RESULT} or {NAME}"
        raise InputError(f"{path}: {said}, allowed is a campaign's folder or one with a saved result")
    if kept is None or (path / DESCRIPTION).exists():
        page = report_campaign(path, out, model_file, effects_from, diagnosing, answer, quiet)
    else:
        options = {"--out": out, "--model": model_file, "--answer": answer, "--diagnose": diagnosing or None}
        given = [name for name, value in options.items() if value is not None]
        if given:
            raise InputError(f"{given[0]} is given, allowed with a campaign; {path} holds a saved result")
        if kept == RESULT:
            redraw(path, quiet)
            return
        page = redraw_campaign(path, quiet)
    print(f"report: {page}")


def report_campaign(
    folder: Path,
    out: Path | None = None,
    model_file: Path | None = None,
    effects_from: Sequence[Path] = (),
    diagnosing: bool = False,
    answer: Path | None = None,
    quiet: bool = False,
) -> Path:
    """Collect and draw; returns the page. InputError for bad input, or a place inside the campaign."""
    campaign, model, known = opened(folder, model_file, effects_from)
    out = out or _own_place(folder)
    _outside(out, folder)
    usable(out, f"--out {out}")
    saved = model_file or folder / MODEL
    uncertainty = read_model_file(saved, known).uncertainty if saved.exists() else {}
    subject = Subject(campaign, model, known, uncertainty)
    progress = Progress(quiet)
    if answer is not None:
        with progress.stage("what could be taken for what") as stage:
            subject = _answered(subject, read_answer(answer), answer, stage)
    elif diagnosing:
        with progress.stage("looking for what is missing") as stage:
            subject = diagnosed(subject, stage)
    with progress.stage("curves") as stage:
        page = collect(subject, _commands(folder, model_file, effects_from, diagnosing, answer), stage.say)
    return write_page(page, out, progress)


def _own_place(folder: Path) -> Path:
    """By the folder: copies of a campaign have one name, and would overwrite each other."""
    name = folder.resolve().name
    place = RESULTS / name
    return RESULTS / f"{name}-report" if place.resolve() == folder.resolve() else place


def write_page(page: Page, out: Path, progress: Progress | None = None) -> Path:
    """Write the record and draw it; returns the page."""
    with replacing(out / NAME) as part:
        part.write_text(page.model_dump_json() + "\n", encoding="utf-8")
    return draw(out, progress or Progress(quiet=True))


def redraw_campaign(folder: Path, quiet: bool = False) -> Path:
    """Draw a page that was collected before. InputError for a file that is none."""
    try:
        Page.model_validate_json((folder / NAME).read_bytes())
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"])) or "the file"
        raise InputError(f"{folder / NAME} is not a saved page: {place}: {first['msg']}") from error
    return draw(folder, Progress(quiet))


def draw(out: Path, progress: Progress) -> Path:
    """Draw what stands in a folder; returns the page."""
    from reports.campaign import draw as draw_campaign
    from reports.errors import ReportError

    with progress.stage("report"):
        try:
            draw_campaign(out)
        except ReportError as error:
            raise InputError(str(error)) from error
    return out / "index.html"


def diagnosed(it: Subject, stage: Stage) -> Subject:
    """With the answer of a diagnosis made now."""
    found = with_laws(diagnose(it.campaign, it.model, it.known.effects, stage.say), stage.say)
    return of_diagnosis(it, found, possible(found, answered(found), stage.say))


def of_diagnosis(it: Subject, found: Diagnosis, sets: tuple[Possible, ...]) -> Subject:
    """With the answer of a diagnosis, on the readings as it took them: what it set aside is in no picture either.

    sets: what it leaves possible, the first of which is shown.
    """
    alike, first = attempted_isolability(found), sets[0]
    return Subject(
        found.campaign,
        it.model,
        it.known,
        it.uncertainty,
        first.answer,
        alike,
        pages_of(sets),
        it.campaign,
        first.fit,
    )


def read_answer(path: Path) -> Answer:
    """An answer that diagnose or add has written. InputError for a file that is none."""
    return Answer.read(path, "saved answer")


def _answered(it: Subject, answer: Answer, path: Path, stage: Stage) -> Subject:
    """With a saved answer, if it is about this campaign and these effects; one that looked for candidates has none of
    how alike they are, which is found here."""
    if answer.campaign != it.campaign.name:
        raise InputError(
            f"{path} is about the campaign {answer.campaign!r}, allowed is one about {it.campaign.name!r}"
        )
    for name in [*answer.effects, *(c.effect for c in answer.candidates)]:
        if effect_named(name, it.known.effects) is None:
            raise InputError(
                f"{path} names the effect {name!r}, which is unknown; allowed with --effects-from"
            )
    alike = None
    if answer.candidates:
        alike = isolability_anew(it.campaign, it.model, it.known.effects, answer.added, stage.say)
    return Subject(it.campaign, it.model, it.known, it.uncertainty, answer, alike)


def _outside(out: Path, folder: Path) -> None:
    """InputError for a place inside the campaign, which is never touched."""
    if folder.resolve() in [out.resolve(), *out.resolve().parents]:
        raise InputError(f"--out {out} is inside the campaign {folder}, allowed is a folder outside of it")


def _commands(
    folder: Path, model: Path | None, effects: Sequence[Path], diagnosing: bool, answer: Path | None
) -> tuple[str, ...]:
    """The command line that makes the page again; the campaign's name of its folder, not where it lies."""
    parts = ["report", str(folder)]
    for option, value in (
        ("--model", model),
        *(("--effects-from", e) for e in effects),
        ("--answer", answer),
    ):
        parts += [] if value is None else [option, str(value)]
    return (command(*parts, *(["--diagnose"] if diagnosing else [])),)
