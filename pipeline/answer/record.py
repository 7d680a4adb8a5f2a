"""What is found about a campaign's model: one record, the same for adding effects and for searching them.

Errors are whitened root mean squares, 1 is noise; that of the fitted tests is over their degrees of freedom.
Values in the units of their parameters: N, mm, rad, MPa, N·mm.
"""

from __future__ import annotations

from typing import Any, Literal

from pipeline.answer.evidence import Evidence
from pipeline.answer.law import LawFound
from pipeline.answer.value import Value
from pipeline.record import Record

Verdict = Literal["nothing_tested", "within_noise", "identified", "ambiguous", "unknown"]
LEVEL = 0.01
"""A p-value below which what is left is not taken for noise."""


class DoctorFinding(Record):
    """A mistake that the table of readings seems to have."""

    hypothesis: str
    """The mistake, in words."""
    column: str
    """Column that it is in."""
    chi_square_before: float
    """Chi-square that the best single effect leaves with the table as it is."""
    chi_square_after: float
    """The same with the mistake mended."""
    mend: str
    """The line of campaign.toml that mends it, or what to do."""


def place_of(test: str, step: int, line: int | None) -> str:
    """Where a reading stands, in words."""
    return f"step {step} of {test}" + ("" if line is None else f", line {line} of its file")


class SetAside(Record):
    """A single reading that was left out."""

    test: str
    """Its test."""
    step: int
    """Its load step."""
    column: str
    """Its column."""
    sigma: float
    """By how many of its sigmas it is off."""
    instead: tuple[str, ...] = ()
    """Columns of the same step of which one may be off in its place: what the row says of both is the same."""
    line: int | None = None
    """Its line in the file of readings, counted from 1; null where it comes from no file."""

    @property
    def place(self) -> str:
        """Step, test and line in words."""
        return place_of(self.test, self.step, self.line)


class FoundNoise(Record):
    """The noise of a sensor where it is not as it was declared; sigmas in the unit of its column."""

    column: str
    """Column of the sensor."""
    declared: float
    """Standard deviation as declared in [noise]."""
    found: float
    """Standard deviation as the readings scatter."""
    relative_error: float | None = None
    """Standard error of what was found, as a share of it."""
    tails: float | None = None
    """Degrees of freedom of Student's law; None where noise is normal."""
    correlation: float | None = None
    """Correlation of the noise of neighbouring rows of a test; None where none was found. Where it is given, it
    is what was found."""


class Certain(Record):
    """An effect that is there whatever the verdict: the best set without it leaves far more, whatever faults of
    sensors are allowed beside."""

    effect: str
    """Its name."""
    parameters: dict[str, float]
    """Its parameters by name, each in its unit."""


class NominalValue(Record):
    """A number that was written about the rig, beside which everything was fitted."""

    name: str
    """Name of the number."""
    nominal: float
    """As it was written."""
    tolerance: float
    """One standard deviation of that, as it was written or as is usual."""
    value: float
    """As it fits best."""
    std: float
    """Standard error of that."""
    pull: float
    """Standard deviations from nominal to value."""
    unit: str
    """Unit of nominal, tolerance, value and std."""
    meaning: str
    """What the number is."""
    seen: bool
    """Whether these tests say more of it than was written."""
    moved: bool = False
    """Whether it fits best farther from what was written than its tolerance explains."""


class UnknownZero(Record):
    """A sensor that seems not to be zeroed."""

    column: str
    """Its column."""
    tests: tuple[str, ...]
    """Tests in which it reads too much."""
    value: float
    """Constant by which it does."""
    std: float
    """Standard error of that."""
    unit: str
    """Unit of value and std."""
    chi_square: float
    """Chi-square that the constant takes off."""


class ModelError(Record):
    """What one model leaves unexplained. Errors are whitened root mean squares; 1 is noise."""

    effects: tuple[str, ...]
    """Effects of the model, in order."""
    fit: float
    """Error of the fitted tests, over their degrees of freedom."""
    holdout: float | None
    """Error of the tests that were never used to fit or to choose; None where there is none."""
    chi_square: float | None
    """Chi-square of the fitted tests."""
    degrees: int
    """Their degrees of freedom."""
    chi_square_p: float | None
    """Probability that noise alone leaves as much; small is no noise."""
    lag_one_p: float | None
    """Probability that noise alone is as smooth from row to row; small is no noise."""
    lost: tuple[str, ...] = ()
    """Tests in which rows have no prediction, and why; each such reading counts as 30 sigmas."""
    not_noise: tuple[str, ...] = ()
    """What the checks say against noise, a sentence each; of the last model of an answer."""


class TestNoise(Record):
    """What one model leaves in one test; degrees of freedom are not reduced by what was fitted to all tests
    together."""

    __test__ = False

    rms: float | None
    """Whitened root mean square; None where nothing is compared."""
    chi_square_p: float | None
    """Probability that noise alone leaves as much."""
    lag_one_p: float | None
    """Probability that noise alone is as smooth."""
    lost: int
    """Rows without a stable equilibrium of the model."""


class TestChange(Record):
    """One test before and after."""

    __test__ = False

    test: str
    """Its id."""
    q_deg: float
    """Angle of its bars, degrees."""
    role: str
    """fit or holdout."""
    rows: int
    """Load steps."""
    before: TestNoise
    """What the model leaves from which the command started."""
    after: TestNoise
    """What the model of the answer leaves."""


class Candidate(Record):
    """An effect that was tried. Errors are whitened root mean squares; 1 is noise."""

    effect: str
    """Its name."""
    screen: float | None = None
    """Error that it was expected to leave, to first order; None where that was not looked at."""
    fit: float | None = None
    """Error that the best fitted set with it leaves; None where it was not fitted."""
    crossvalidated: float | None = None
    """Error in tests that the fit did not see, each left out in turn."""
    evidence: float | None = None
    """BIC of that set less that of the best set; 0 is best."""


class Correlation(Record):
    """Two parameters whose errors go together."""

    first: str
    """One parameter, effect.parameter."""
    second: str
    """The other one."""
    value: float
    """Correlation of their errors, -1 to 1."""


class Answer(Record):
    """The answer of add, remove, diagnose and improve."""

    campaign: str
    """Name of the campaign."""
    verdict: Verdict
    """What was found; see the verdicts."""
    effects: tuple[str, ...]
    """Effects of the model of the answer, in order; of ambiguous the simplest set."""
    added: tuple[str, ...] = ()
    """Those that this command added or found."""
    alternatives: tuple[tuple[str, ...], ...] = ()
    """Other sets of effects that explain the readings as well."""
    parameters: dict[str, Value]
    """Values by effect.parameter."""
    error: tuple[ModelError, ...]
    """What the models on the way leave; the last is that of the answer."""
    tests: tuple[TestChange, ...] = ()
    """What is left test by test."""
    candidates: tuple[Candidate, ...] = ()
    """Effects that were tried, the best first."""
    correlations: tuple[Correlation, ...] = ()
    """Parameters whose errors go together."""
    undetermined: tuple[tuple[str, ...], ...] = ()
    """Sets of parameters about which the data say nothing, or of which they see only combinations."""
    confusable: tuple[tuple[str, ...], ...] = ()
    """Pairs of effects that look alike in these tests."""
    at_bound: tuple[str, ...] = ()
    """Parameters that end at a bound of what they may be; such a number excludes no rival."""
    out_by_plausibility: tuple[tuple[str, ...], ...] = ()
    """Sets that fit as well and are out only because their sizes would be implausible."""
    doctor: tuple[DoctorFinding, ...] = ()
    """Mistakes that the table seems to have; one of them comes before all physics."""
    zeros: tuple[UnknownZero, ...] = ()
    """Sensors that seem not to be zeroed."""
    nominals: tuple[NominalValue, ...] = ()
    """What was written about the rig, as it fits best; empty where all of it is exact."""
    as_written: float | None = None
    """Error of the first model with the rig exactly as it is written, where its tolerances take a good part of that."""
    set_aside: tuple[SetAside, ...] = ()
    """Single bad readings that were left out."""
    noise: tuple[FoundNoise, ...] = ()
    """Sensors whose noise is not as it was declared."""
    as_declared: Verdict | None = None
    """Verdict with all readings and sigmas as declared, where something was found of them; of the best single
    effect where single bad readings were seen beside that."""
    certain: tuple[Certain, ...] = ()
    """Effects that are there whatever the verdict."""
    laws: tuple[LawFound, ...] = ()
    """Laws beyond the catalogue: of what is left where the verdict is unknown or within_noise; of all that was
    measured where they explain it by fewer numbers than the sets of effects, or as well (ambiguous)."""
    evidence: Evidence | None = None
    """What the verdict of diagnose rests on; None where nothing was searched."""
    not_done: tuple[str, ...] = ()
    """Optional parts that failed, and why."""
    next_test: dict[str, Any] | None = None
    """The test that would tell rivals apart: q_deg, control, driven (the coordinate that is driven), largest (how
    far, in its unit), why (in words), tells_apart, expected_chi_square, together_with."""
    sentences: tuple[str, ...] = ()
    """The answer in words."""
    evaluations: int = 0
    """Predictions that the search made."""
    seconds: float = 0.0
    """Time that it took."""
    seed: int | None = None
    """Seed that was given with the command."""
    commit: str = ""
    """Commit of the program."""
    versions: dict[str, str] = {}  # noqa: RUF012 (pydantic copies it)
    """Versions of the program and its libraries."""
    data: dict[str, str] = {}  # noqa: RUF012
    """SHA-256 of each file that was read, by its name."""
