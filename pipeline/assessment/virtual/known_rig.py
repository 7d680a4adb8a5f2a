"""The rig of a virtual bench from what is known of a real one: a campaign that may be half filled in, or a result."""

from __future__ import annotations

from pathlib import Path

from pydantic import ValidationError

from pipeline.campaign import ParallelogramRig
from pipeline.campaign.bar_from import bar_from
from pipeline.campaign.reading import DESCRIPTION
from pipeline.campaign.rigs import KINDS
from pipeline.errors import InputError, unread
from pipeline.toml.fields import sentences
from pipeline.toml.lines import parsed

ALLOWED = "allowed is a campaign of a parallelogram, or a result with its width"


def rig_of(source: Path) -> ParallelogramRig:
    """The parallelogram of a campaign's folder, of which only [rig] is read, or of a result of `run` or `bar`.

    InputError where there is none.
    """
    return _of_campaign(source) if source.is_dir() or not source.suffix else _of_result(source)


def _of_result(path: Path) -> ParallelogramRig:
    found = bar_from(path)
    if found.width is None:
        raise InputError(f"{path}: is of one bar and says no width, {ALLOWED}")
    return ParallelogramRig(
        length=found.length, width=found.width, bar_stiffness=found.stiffness, computed=found
    )


def _of_campaign(folder: Path) -> ParallelogramRig:
    path = folder / DESCRIPTION
    try:
        raw = parsed(path.read_text(encoding="utf-8-sig")).get("rig", {})
    except OSError as error:
        raise InputError(f"{path}: {unread(error)}") from error
    except ValueError as error:
        raise InputError(f"{path}: is no TOML: {error}") from error
    kind = raw.get("kind") if isinstance(raw, dict) else None
    table = KINDS.get(kind) if isinstance(kind, str) else None
    if table is None or kind != ParallelogramRig.kind:
        raise InputError(f"{path}: rig.kind is {kind!r}, {ALLOWED}")
    try:
        rig = table.model_validate(raw).rig(folder)
    except ValidationError as error:
        place, said = sentences(error, table)[0]
        raise InputError(f"{path}, rig.{'.'.join(map(str, place))}: {said}") from error
    assert isinstance(rig, ParallelogramRig)
    return rig
