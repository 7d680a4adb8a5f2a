"""What `plan` found, as a record."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshes.files import replacing
from pipeline.campaign.names import COORDINATES
from pipeline.errors import InputError
from pipeline.plan.isolability import Visible
from pipeline.plan.next import Worth
from pipeline.provenance import commit, versions
from pipeline.record import Record


class Size(Record):
    """A number of an effect: sizes from null in `unit`; None: not to be had from these tests below a thousand typical
    ones. detected: with 90 % power. apart: told from every rival in 95 % of cases. rho: correlation with the rival."""

    effect: str
    parameter: str
    unit: str
    typical: float
    detected: float | None
    apart: float | None
    rival: str
    rho: float
    gamma: float


class Plan(Record):
    """sizes: of every number. names, alike: rows and columns, and the multiple correlation of each effect (row) with
    another (column). next_test: as in a diagnosis; None if none of the menu adds anything. unmeasured: tests whose
    readings are still to come. refused: effects that the rig or the campaign cannot have, and why. untested: why the
    tests so far can test nothing. not_done: optional parts that failed, and why."""

    campaign: str
    sizes: tuple[Size, ...]
    names: tuple[str, ...]
    alike: tuple[tuple[float, ...], ...]
    next_test: dict[str, Any] | None
    unmeasured: tuple[str, ...]
    refused: dict[str, str]
    untested: str = ""
    not_done: tuple[str, ...] = ()
    commit: str
    versions: dict[str, str]

    def write(self, path: Path) -> None:
        """Write the JSON whole or not at all. InputError where nothing can be written."""
        text = json.dumps(self.model_dump(mode="json"), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
        try:
            with replacing(path) as part:
                part.write_text(text, encoding="utf-8")
        except OSError as error:
            raise InputError(f"{path} cannot be written: {error.strerror}") from error


def plan_record(
    campaign: str,
    found: Sequence[Visible],
    names: Sequence[str],
    alike: NDArray[np.float64],
    worth: Worth | None,
    words: str | None,
    unmeasured: Sequence[str],
    refused: Mapping[str, str],
) -> Plan:
    """The record of what was computed."""
    following: dict[str, Any] | None = None
    if worth is not None:
        test = worth.choice.test
        following = {
            "q_deg": test.q_deg,
            "control": dict(zip(COORDINATES, test.control, strict=True)),
            "driven": COORDINATES[worth.choice.shape.coordinate],
            "largest": worth.choice.limit,
            "why": words,
            "newly": list(worth.newly),
            "score": [worth.before, worth.after],
        }
    return Plan(
        campaign=campaign,
        sizes=tuple(
            Size(
                effect=v.effect,
                parameter=v.parameter.name,
                unit=v.parameter.unit,
                typical=v.typical,
                detected=v.detected,
                apart=v.apart,
                rival=v.rival,
                rho=v.rho,
                gamma=v.gamma,
            )
            for v in found
        ),
        names=tuple(names),
        alike=tuple(tuple(float(x) for x in row) for row in alike),
        next_test=following,
        unmeasured=tuple(unmeasured),
        refused=dict(refused),
        commit=commit(),
        versions=versions(),
    )
