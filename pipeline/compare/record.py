"""Result of compare: models beside measurements, to and from JSON."""

from __future__ import annotations

from pydantic import Field

from pipeline.answer.record import DoctorFinding
from pipeline.record import Record


class ChannelError(Record):
    """One channel of a test, or of the tests that may be fitted."""

    sigmas: float
    """Root mean square of measured less predicted over their own standard deviation; 1 is noise."""
    rms: float
    """Root mean square of measured less predicted, in unit."""
    unit: str
    """Unit of rms."""
    readings: int
    """How many; those without a stable equilibrium of the model are not among them."""


class Lost(Record):
    """Rows of a test without a stable equilibrium of the model."""

    test: str
    """Its id."""
    rows: int
    """How many rows."""
    of: int
    """Rows of the test."""
    step: int
    """Load step of the first of them."""
    reason: str
    """Reason, a short name."""
    sentence: str
    """The reason in words."""


class TestError(Record):
    """One test beside one model."""

    __test__ = False

    test: str
    """Its id."""
    q_deg: float
    """Angle of its bars, degrees."""
    role: str
    """fit or holdout."""
    rms: float | None
    """Whitened root mean square, each lost reading counting as 30 sigmas; None: nothing is compared."""
    lost: int
    """Rows without a stable equilibrium."""
    channels: dict[str, ChannelError]
    """By column."""


class Finding(Record):
    """One significant number of how a channel fails in tests that are loaded alike."""

    group: str
    """Name of these tests, as in groups of the comparison."""
    channel: str
    """Column that fails."""
    number: str
    """What the number is: offset, slope, curvature, dead band, loop, asymmetry or growth with the angle."""
    value: float
    """The number, in unit."""
    std: float
    """Its standard error, in unit."""
    unit: str
    """Unit of value and std."""
    significance: float
    """Value over its standard error."""
    load: str
    """Column that drives these tests."""
    sentence: str
    """The same in words; empty where a number that is told explains it."""


class ModelError(Record):
    """How far one model is from the measurements. Errors are whitened root mean squares; 1 is noise."""

    model: str
    """lin, vjm, saved or fea."""
    title: str
    """The model in words."""
    effects: tuple[str, ...] = ()
    """Its effects, in order."""
    failed: str | None = None
    """Why the model has no prediction at all."""
    fit: float | None = None
    """Error of the tests that may be fitted."""
    holdout: float | None = None
    """Error of the held-out tests."""
    degrees: int = 0
    """Degrees of freedom of the tests that may be fitted."""
    chi_square_p: float | None = None
    """Probability that noise alone leaves as much."""
    lag_one_p: float | None = None
    """Probability that noise alone is as smooth along the load."""
    within_noise: bool = False
    """Whether what is left looks like noise."""
    tolerated: bool = False
    """Whether it does so only with what is written about the rig where it fits best within its tolerances."""
    lost: tuple[Lost, ...] = ()
    """Rows without a stable equilibrium."""
    tests: tuple[TestError, ...] = ()
    """Test by test."""
    channels: dict[str, ChannelError] = Field(default_factory=dict)
    """By column, of the tests that may be fitted."""
    holdout_channels: dict[str, ChannelError] = Field(default_factory=dict)
    """By column, of the held-out tests."""
    findings: tuple[Finding, ...] = ()
    """How the model fails, what is told in words first."""
    looks: int = 0
    """How many numbers were looked at for the findings."""
    headline: str = ""
    """The mean misfit of the worst channel, in words."""
    untested: str = ""
    """Why nothing can be tested; empty where it can."""
    in_units: tuple[str, ...] = ()
    """Errors of channels without a sigma, in words."""
    too_short: tuple[str, ...] = ()
    """Series whose shape cannot be judged, in words."""
    not_noise: tuple[str, ...] = ()
    """What speaks against noise, in words."""
    seconds: float = 0.0
    """Time that it took."""


class Comparison(Record):
    """The answer of compare: a campaign and the models beside it."""

    campaign: str
    """Name of the campaign."""
    folder: str
    """Its folder."""
    kind: str
    """Kind of its rig."""
    tests: int
    """Number of tests."""
    rows: int
    """Number of load steps."""
    readings: int
    """Number of readings that are compared."""
    shown: str
    """Model whose failure is told."""
    groups: dict[str, tuple[str, ...]]
    """Ids of the fitted tests that are loaded alike, by the name of the group."""
    remarks: tuple[str, ...]
    """What was accepted but may deserve a look."""
    models: tuple[ModelError, ...]
    """One record for each model."""
    doctor: tuple[DoctorFinding, ...] = ()
    """Mistakes that the table seems to have."""
    not_done: tuple[str, ...] = ()
    """Optional parts that failed, and why."""
    seconds: float
    """Time that it took."""
    versions: dict[str, str]
    """Versions of the program and its libraries."""
    data: dict[str, str] = {}  # noqa: RUF012 (pydantic copies it)
    """SHA-256 of each file that was read, by its name."""
    commit: str
    """Commit of the program."""

    def model_of(self, key: str) -> ModelError:
        """The model of that key. KeyError if there is none."""
        found = {model.model: model for model in self.models}
        return found[key]
