"""All that a page about a campaign shows, to and from JSON; `reports` draws it and computes nothing.

Errors are in sigmas, 1 is noise. Readings in the units of their columns: mm, rad, N, N·mm; None where there is none.
Before: plain virtual springs; after: the model of the page.
"""

from __future__ import annotations

from typing import Any

from pipeline.answer.law import LawFound
from pipeline.answer.record import (
    Certain,
    Correlation,
    DoctorFinding,
    FoundNoise,
    ModelError,
    NominalValue,
    SetAside,
    UnknownZero,
)
from pipeline.answer.value import Value
from pipeline.predict.record import Budget, ColumnComparison
from pipeline.record import Record

Numbers = tuple[float | None, ...]
NAME = "page.json"


class Line(Record):
    """Points of a manipulator, mm, base frame, unloaded. share: how far each follows the platform, 0 to 1."""

    points: tuple[Numbers, ...]
    share: tuple[float, ...]


class Rig(Record):
    """What is drawn of the rig. width_mm: None but for a parallelogram. Of a manipulator in a test also place_mm,
    where its unloaded platform stands, base frame, and lines of its legs there."""

    kind: str
    length_mm: float
    width_mm: float | None
    place_mm: Numbers | None = None
    lines: tuple[Line, ...] = ()


class Curve(Record):
    """One channel of one test, step after step.

    before, after: predicted. left_before, left_after: measured less predicted over its own standard deviation, in
    which the noise of the inputs stands too; rms_before, rms_after: their root mean squares. sigma: that deviation
    after, in `unit`.
    """

    channel: str
    unit: str
    measured: Numbers
    sigma: Numbers
    before: Numbers
    after: Numbers
    left_before: Numbers
    left_after: Numbers
    rms_before: float | None
    rms_after: float | None


class TestPage(Record):
    """One test. loads: of the quantity `load` that drives it. error_before, error_after: whitened RMS of the test,
    misfit_before, misfit_after: of each step. measured_pose, predicted_pose: x y z rx ry rz from the nominal pose."""

    __test__ = False

    test: str
    q_deg: float
    role: str
    control: dict[str, str]
    rig: Rig
    load: str
    load_unit: str
    loads: Numbers
    steps: tuple[int, ...]
    curves: tuple[Curve, ...]
    error_before: float | None
    error_after: float | None
    misfit_before: Numbers
    misfit_after: Numbers
    lost_before: int
    lost_after: int
    measured_pose: tuple[Numbers, ...]
    predicted_pose: tuple[Numbers, ...]


class CandidatePage(Record):
    """An effect that was looked at, as `pipeline.answer.record.Candidate`; why: it was chosen, or lost."""

    effect: str
    title: str
    chosen: bool
    screen: float | None
    fit: float | None
    crossvalidated: float | None
    evidence: float | None
    why: str


class RivalPage(Record):
    """One of several sets of effects that explain the readings alike, with its own numbers. error: what it leaves."""

    effects: tuple[str, ...]
    error: ModelError
    parameters: dict[str, Value]


class TolerancePage(Record):
    """By how much something that is written about the rig may be off. key: in [tolerance]. value: one standard
    deviation in `unit`; 0: exact."""

    key: str
    words: str
    unit: str
    value: float


class ByHand(Record):
    """A reading that somebody set aside in campaign.toml, or keeps there however far off it is."""

    test: str
    step: int
    column: str
    kept: bool


class Following(Record):
    """Something to do next. command: that does it, "" where none does."""

    words: str
    command: str = ""


class Isolability(Record):
    """How alike effects look in these tests: correlation[i][j] of effect i with the best that effect j can do,
    both free of what the model `about` can move; 1 cannot be told apart. None: effect i does not show. anew: found
    for the page, not by the diagnosis itself."""

    about: tuple[str, ...]
    effects: tuple[str, ...]
    correlation: tuple[Numbers, ...]
    anew: bool = False


class EffectPage(Record):
    """An effect of the model as the catalogue has it."""

    name: str
    title: str
    equation: str
    signature: str
    limits: str
    source: str


class Sigma(Record):
    """The noise of a column; given: in campaign.toml, else estimated."""

    column: str
    value: float
    unit: str
    given: bool


class Dossier(Record):
    """Predicted against measured in the terms of ASME V&V 20-2009, and what limits each parameter.

    held_out: whether of tests that were not fitted; else of the fitted ones, as there are no others. inside, readings:
    of the 95 % intervals. noise_factor: by which noise and parameters are widened. computed: where K_b is from, with
    its bands; empty where it is not computed. data: sha256 of every file.
    """

    held_out: bool
    comparison: tuple[ColumnComparison, ...]
    inside: int
    readings: int
    budget: tuple[Budget, ...]
    noise_factor: float
    computed: str
    data: dict[str, str]


class Page(Record):
    """A campaign, a model and what is known about both.

    effects: of the model, in order; proposed: those of them that a diagnosis adds and the campaign's model lacks.
    error: plain virtual springs and then each effect more, every stage fitted. commands: that make it again.
    out_by_plausibility: sets that fit as well but need an implausible size. titles: of every effect that is named
    here, in words. certain: effects that are there whatever the verdict. rivals: the sets of an ambiguous verdict, the
    simplest first, as far as they were fitted; alternatives: all of them but the first. laws: discovered in what is
    left. not_done: optional parts that failed, and why. following: what to do next.
    tolerances: of what is written about the rig. by_hand: readings that campaign.toml sets aside or keeps. dossier: of
    the model, where it was looked for what is missing.
    """

    campaign: str
    folder: str
    rig: Rig
    remarks: tuple[str, ...]
    verdict: str
    diagnosed: bool
    headline: str
    sentences: tuple[str, ...]
    effects: tuple[str, ...]
    proposed: tuple[str, ...]
    error: tuple[ModelError, ...]
    parameters: dict[str, Value]
    correlations: tuple[Correlation, ...]
    out_by_plausibility: tuple[tuple[str, ...], ...] = ()
    tests: tuple[TestPage, ...]
    candidates: tuple[CandidatePage, ...]
    doctor: tuple[DoctorFinding, ...] = ()
    nominals: tuple[NominalValue, ...] = ()
    set_aside: tuple[SetAside, ...] = ()
    by_hand: tuple[ByHand, ...] = ()
    noise: tuple[FoundNoise, ...] = ()
    titles: dict[str, str] = {}  # noqa: RUF012 (pydantic copies it)
    certain: tuple[Certain, ...] = ()
    alternatives: tuple[tuple[str, ...], ...] = ()
    rivals: tuple[RivalPage, ...] = ()
    zeros: tuple[UnknownZero, ...] = ()
    laws: tuple[LawFound, ...] = ()
    not_done: tuple[str, ...] = ()
    following: tuple[Following, ...] = ()
    tolerances: tuple[TolerancePage, ...] = ()
    dossier: Dossier | None = None
    isolability: Isolability | None
    next_test: dict[str, Any] | None
    catalogue: tuple[EffectPage, ...]
    sigmas: tuple[Sigma, ...]
    assumptions: tuple[str, ...]
    sources: tuple[str, ...]
    commands: tuple[str, ...]
    versions: dict[str, str]
    commit: str
