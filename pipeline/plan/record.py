"""What `plan` found, as a record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.names import COORDINATES
from pipeline.plan.isolability import Visible
from pipeline.plan.next import Worth
from pipeline.provenance import made_with
from pipeline.record import Record


class Size(Record):
    """How small an effect these tests can show. Sizes are from the null value; None: not to be had below a
    thousand typical ones."""

    effect: str
    """Name of the effect."""
    parameter: str
    """Name of its parameter."""
    unit: str
    """Unit of the sizes."""
    typical: float
    """Typical size."""
    detected: float | None
    """Smallest size that is detected with 90 % power."""
    apart: float | None
    """Smallest size that is told from every rival in 95 % of cases."""
    rival: str
    """Effect that looks most like it in these tests."""
    rho: float
    """Correlation with that rival."""
    gamma: float
    """1 / sqrt(1 - rho): by how much larger it has to be to be told from the rival."""


class Plan(Record):
    """The answer of plan."""

    campaign: str
    """Name of the campaign."""
    sizes: tuple[Size, ...]
    """Of every parameter of every effect."""
    names: tuple[str, ...]
    """Effects that alike has as rows and columns."""
    alike: tuple[tuple[float, ...], ...]
    """Multiple correlation of each effect (row) with another one (column)."""
    next_test: dict[str, Any] | None
    """The test that is worth most: q_deg, control, driven, largest, why, newly (what it would newly show) and
    score; None if none adds anything."""
    unmeasured: tuple[str, ...]
    """Tests whose readings are still to come."""
    refused: dict[str, str]
    """Effects that the rig or the campaign cannot have, and why."""
    untested: str = ""
    """Why the tests so far can test nothing; empty where they can."""
    not_done: tuple[str, ...] = ()
    """Optional parts that failed, and why."""
    commit: str
    """Commit of the program."""
    versions: dict[str, str]
    """Versions of the program and its libraries."""


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
    """The record of what was computed; alike (n, n) of the n names."""
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
        **made_with(),
    )
