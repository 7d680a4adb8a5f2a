"""Result of compare: models beside measurements, to and from JSON."""

from __future__ import annotations

from pydantic import Field

from pipeline.answer import DoctorFinding
from pipeline.record import Record


class ChannelError(Record):
    """One channel of a test or of the tests that may be fitted.

    sigmas: root mean square of measured less predicted over their own standard deviation, 1 is noise. rms: the same
    in `unit`. readings: how many; those without a stable equilibrium are not among them.
    """

    sigmas: float
    rms: float
    unit: str
    readings: int


class Lost(Record):
    """Rows of a test without a stable equilibrium; step: number of the first of them."""

    test: str
    rows: int
    of: int
    step: int
    reason: str
    sentence: str


class TestError(Record):
    """One test. rms: whitened, rows that are lost counting as `residual.LOST` sigmas; None: nothing is compared."""

    __test__ = False

    test: str
    q_deg: float
    role: str
    rms: float | None
    lost: int
    channels: dict[str, ChannelError]


class Finding(Record):
    """One significant number of how a channel fails in tests that are loaded alike, as `pipeline.misfit` defines it.

    group: name of the tests, see `Comparison.groups`. load: what drives them. value, std in `unit`. sentence: the
    same in words; empty where a number that is told explains it.
    """

    group: str
    channel: str
    number: str
    value: float
    std: float
    unit: str
    significance: float
    load: str
    sentence: str


class ModelError(Record):
    """How far one model is from the measurements.

    model: lin, vjm, saved or fea. fit, holdout: whitened root mean squares, 1 is noise; chi_square_p and lag_one_p:
    how often noise is as large, or as smooth along the load, of the tests that may be fitted; `degrees` of freedom.
    looks: how many numbers were looked at for the findings. failed: why the model has no prediction at all. headline:
    the mean misfit of the worst channel. untested: why nothing can be tested. in_units: of channels without a sigma.
    too_short: series whose shape cannot be judged. not_noise: what speaks against noise. tolerated: whether what is
    left is noise only with what is written about the rig where it fits best within its tolerances.
    """

    model: str
    title: str
    effects: tuple[str, ...] = ()
    failed: str | None = None
    fit: float | None = None
    holdout: float | None = None
    degrees: int = 0
    chi_square_p: float | None = None
    lag_one_p: float | None = None
    within_noise: bool = False
    tolerated: bool = False
    lost: tuple[Lost, ...] = ()
    tests: tuple[TestError, ...] = ()
    channels: dict[str, ChannelError] = Field(default_factory=dict)
    holdout_channels: dict[str, ChannelError] = Field(default_factory=dict)
    findings: tuple[Finding, ...] = ()
    looks: int = 0
    headline: str = ""
    untested: str = ""
    in_units: tuple[str, ...] = ()
    too_short: tuple[str, ...] = ()
    not_noise: tuple[str, ...] = ()
    seconds: float = 0.0


class Comparison(Record):
    """A campaign and the models beside it. shown: the model whose failure is told. groups: ids of
    the fitted tests that are loaded alike. remarks: on the campaign. doctor: mistakes that the table seems to have."""

    campaign: str
    folder: str
    kind: str
    tests: int
    rows: int
    readings: int
    shown: str
    groups: dict[str, tuple[str, ...]]
    remarks: tuple[str, ...]
    models: tuple[ModelError, ...]
    doctor: tuple[DoctorFinding, ...] = ()
    seconds: float
    versions: dict[str, str]
    data: dict[str, str] = {}  # noqa: RUF012 (pydantic copies it)
    commit: str

    def model_of(self, key: str) -> ModelError:
        """The model of that key. KeyError if there is none."""
        found = {model.model: model for model in self.models}
        return found[key]
