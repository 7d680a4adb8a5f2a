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

Verdict = Literal["within_noise", "identified", "ambiguous", "unknown", "nothing_tested"]
LEVEL = 0.01
"""A p-value below which what is left is not taken for noise."""


class Value(Record):
    """A parameter. std: standard error; low95, high95: interval; None where the data set no end.

    interval: how it was found, "wald", "profile", "undetermined", or "fixed" for what the fit left alone.
    at_bound: the fit ended at the bound of the parameter, where the physics has no end (as at zero).
    """

    value: float
    std: float | None
    low95: float | None
    high95: float | None
    interval: Literal["wald", "profile", "undetermined", "fixed"]
    unit: str
    meaning: str
    at_bound: bool = False


class ModelError(Record):
    """What a model leaves unexplained. chi_square_p, lag_one_p: of the fitted tests, small is no noise.

    holdout: of tests that were never used to fit or choose. lost: tests in which rows have no prediction, and why;
    each such reading counts as 30 sigmas.
    """

    effects: tuple[str, ...]
    fit: float
    holdout: float | None
    chi_square: float | None
    degrees: int
    chi_square_p: float | None
    lag_one_p: float | None
    lost: tuple[str, ...] = ()


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
    say nothing, or of which they see only combinations. confusable: effects whose parameters go together.
    at_bound: parameters whose fit ended at their bound. out_by_plausibility: sets that fit as well but need an
    implausible size.
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
    next_test: dict[str, Any] | None = None
    sentences: tuple[str, ...] = ()
    evaluations: int = 0
    seconds: float = 0.0
    seed: int | None = None
    commit: str = ""
    versions: dict[str, str] = {}  # noqa: RUF012 (pydantic copies it)

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
