"""What is found about a campaign's model: one record, the same for adding effects and for searching them.

Errors are whitened root mean squares, 1 is noise; that of the fitted tests is over their degrees of freedom.
Values in the units of their parameters: N, mm, rad, MPa, N·mm.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Literal

from meshes.files import replacing
from pipeline.errors import InputError
from pipeline.record import Record

Verdict = Literal["nothing_tested", "within_noise", "identified", "ambiguous", "unknown"]
LEVEL = 0.01
"""A p-value below which what is left is not taken for noise."""


class Value(Record):
    """A parameter. std: standard error; low95, high95: interval; None where the data set no end.

    interval: how it was found, "wald", "profile", "undetermined", or "fixed" for what the fit left alone. at_bound:
    whether it ends at a bound of what it may be, other than the absence of the effect.
    """

    value: float
    std: float | None
    low95: float | None
    high95: float | None
    interval: Literal["wald", "profile", "undetermined", "fixed"]
    unit: str
    meaning: str
    at_bound: bool = False


class DoctorFinding(Record):
    """A mistake that the table seems to have, and the column it is in. chi_square_before, chi_square_after: what the
    best single effect leaves without and with it mended. mend: what to do."""

    hypothesis: str
    column: str
    chi_square_before: float
    chi_square_after: float
    mend: str


class SetAside(Record):
    """A single reading that was left out, and by how many of its sigmas it is off."""

    test: str
    step: int
    column: str
    sigma: float


class FoundNoise(Record):
    """The noise of a sensor where it is not as declared; sigmas in the unit of its column. relative_error: standard
    error of what was found, of itself. tails: degrees of freedom of Student's law, None where noise is normal.
    correlation: of neighbouring rows of a test, then that is what was found; None where there is none."""

    column: str
    declared: float
    found: float
    relative_error: float | None = None
    tails: float | None = None
    correlation: float | None = None


class Certain(Record):
    """An effect that is there whatever else is, with its parameters by name: the best set without it leaves far more,
    whatever faults of sensors are allowed beside."""

    effect: str
    parameters: dict[str, float]


class NominalValue(Record):
    """What was written about the rig, beside which everything was fitted. nominal, tolerance: as written, and one
    standard deviation of that. value, std: as it fits best. pull: standard deviations from nominal to value. seen:
    whether these tests say more of it than was written."""

    name: str
    nominal: float
    tolerance: float
    value: float
    std: float
    pull: float
    unit: str
    meaning: str
    seen: bool


class UnknownZero(Record):
    """A sensor that was not zeroed, as it seems: the constant that a column reads too much in some tests, its standard
    error, and the chi-square that it takes off."""

    column: str
    tests: tuple[str, ...]
    value: float
    std: float
    unit: str
    chi_square: float


class ModelError(Record):
    """What a model leaves unexplained. chi_square_p, lag_one_p: of the fitted tests, small is no noise.

    holdout: of tests that were never used to fit or choose. lost: tests in which rows have no prediction, and why;
    each such reading counts as 30 sigmas. not_noise: what the checks say against noise, a sentence each, of the last
    model of an answer.
    """

    effects: tuple[str, ...]
    fit: float
    holdout: float | None
    chi_square: float | None
    degrees: int
    chi_square_p: float | None
    lag_one_p: float | None
    lost: tuple[str, ...] = ()
    not_noise: tuple[str, ...] = ()


class TestNoise(Record):
    """One model in one test; degrees of freedom are not reduced by what was fitted to all tests together."""

    __test__ = False

    rms: float | None
    chi_square_p: float | None
    lag_one_p: float | None
    lost: int


class TestChange(Record):
    """One test before and after."""

    __test__ = False

    test: str
    q_deg: float
    role: str
    rows: int
    before: TestNoise
    after: TestNoise


class Candidate(Record):
    """An effect that was tried. screen: linear estimate of the whitened RMS; evidence: BIC less that of the best."""

    effect: str
    screen: float | None = None
    fit: float | None = None
    crossvalidated: float | None = None
    evidence: float | None = None


class Correlation(Record):
    """Two parameters whose errors go together."""

    first: str
    second: str
    value: float


class Answer(Record):
    """The answer. effects: of the model, in order; added: those that this command added.

    error: of the models on the way, the last is the answer's. undetermined: sets of parameters about which the data
    say nothing, or of which they see only combinations. confusable: effects whose parameters go together. at_bound:
    numbers that end at a bound of what they may be. out_by_plausibility: sets that fit as well, out only because their
    sizes would be implausible. doctor: mistakes of the table, one of which comes before all physics. zeros: of sensors
    that seem not to be zeroed. nominals: what was written about the rig, none where that is exact. set_aside: single
    bad readings that were left out. noise: of sensors whose noise is not as it was declared. as_declared: the verdict
    with all readings and sigmas as declared, where something was found of them; of the best single effect where single
    bad readings were seen beside that. certain: effects that are there whatever the verdict. not_done: optional parts
    that failed.
    """

    campaign: str
    verdict: Verdict
    effects: tuple[str, ...]
    added: tuple[str, ...] = ()
    alternatives: tuple[tuple[str, ...], ...] = ()
    parameters: dict[str, Value]
    error: tuple[ModelError, ...]
    tests: tuple[TestChange, ...] = ()
    candidates: tuple[Candidate, ...] = ()
    correlations: tuple[Correlation, ...] = ()
    undetermined: tuple[tuple[str, ...], ...] = ()
    confusable: tuple[tuple[str, ...], ...] = ()
    at_bound: tuple[str, ...] = ()
    out_by_plausibility: tuple[tuple[str, ...], ...] = ()
    doctor: tuple[DoctorFinding, ...] = ()
    zeros: tuple[UnknownZero, ...] = ()
    nominals: tuple[NominalValue, ...] = ()
    set_aside: tuple[SetAside, ...] = ()
    noise: tuple[FoundNoise, ...] = ()
    as_declared: Verdict | None = None
    certain: tuple[Certain, ...] = ()
    not_done: tuple[str, ...] = ()
    next_test: dict[str, Any] | None = None
    sentences: tuple[str, ...] = ()
    evaluations: int = 0
    seconds: float = 0.0
    seed: int | None = None
    commit: str = ""
    versions: dict[str, str] = {}  # noqa: RUF012 (pydantic copies it)
    data: dict[str, str] = {}  # noqa: RUF012

    def text(self) -> str:
        """JSON; what is not finite is null."""
        return json.dumps(self.model_dump(mode="json"), indent=1, ensure_ascii=False, allow_nan=False) + "\n"

    def write(self, path: Path) -> None:
        """Write the JSON whole or not at all. InputError where nothing can be written."""
        try:
            with replacing(path) as part:
                part.write_text(self.text(), encoding="utf-8")
        except OSError as error:
            raise InputError(f"{path} cannot be written: {error.strerror}") from error
