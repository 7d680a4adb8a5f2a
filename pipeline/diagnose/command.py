"""`diagnose` from the command line: campaign and model in; terminal and JSON out, nothing else is touched."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pipeline.answer.of_diagnosis import answered
from pipeline.answer.record import Answer
from pipeline.answer.tables.diagnosis import show
from pipeline.command import usable_places
from pipeline.discover.beyond_catalogue import with_laws
from pipeline.opened import opened
from pipeline.progress import Progress
from pipeline.selection.diagnosis import diagnose
from pipeline.typed import command


def diagnose_campaign(
    folder: Path,
    model_file: Path | None = None,
    effects_from: Sequence[Path] = (),
    json: Path | None = None,
    out: Path | None = None,
    seed: int | None = None,
    quiet: bool = False,
) -> Answer:
    """Diagnose and print. InputError for bad input."""
    campaign, began, known = opened(folder, model_file, effects_from)
    usable_places(out, json=json)
    progress = Progress(quiet)
    with progress.stage("looking for what is missing") as stage:
        found = with_laws(diagnose(campaign, began, known.effects, stage.say), stage.say)
        stage.note = f"{len(found.cache.fits)} models fitted"
    with progress.stage("intervals"):
        answer = answered(found).model_copy(update={"seed": seed})
    answer.write(json, out and out / "answer.json")
    show(answer, _following(answer, folder), quiet)
    return answer


def _following(answer: Answer, folder: Path) -> list[str]:
    if answer.verdict == "identified":
        return [command("add", folder, *answer.added)]
    if any(law.form for law in answer.laws):
        return [command("discover", folder, "--write", "law.py")]
    if answer.verdict == "unknown" and not answer.doctor:
        return [command("report" if answer.evidence and answer.evidence.law_words else "discover", folder)]
    return []
