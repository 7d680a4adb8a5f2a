"""Predicted readings as a record: for JSON, tables, pictures. Each number in the unit of its column."""

from __future__ import annotations

from typing import Literal

from pipeline.record import Record


class Counted(Record):
    """Readings inside their 95 % intervals."""

    inside: int
    """How many are."""
    of: int
    """Of how many."""

    @property
    def share(self) -> float | None:
        """Inside over all; None without any."""
        return self.inside / self.of if self.of else None


class Reading(Record):
    """One predicted reading with its 95 % interval, the three parts of that as standard deviations."""

    column: str
    """Column that it is of, with its unit."""
    value: float
    """Predicted reading: at the best fit, or the median of the samples."""
    low95: float
    """Lower end of the 95 % interval of a reading, noise included."""
    high95: float
    """Upper end of the 95 % interval."""
    parameters: float
    """Part of the fitted parameters, as if all that is written about the rig were exact."""
    tolerances: float
    """Part of what is written about the rig, as far as the readings leave it open."""
    noise: float
    """Part of the noise: of the sensor, and of what is prescribed."""
    measured: float | None = None
    """What was read there; None where nothing was."""
    inside: bool | None = None
    """Whether that lies inside the interval; None where nothing was read."""


class PredictedRow(Record):
    """A load step with its predicted readings."""

    test: str
    """Test or history that it belongs to."""
    step: int
    """Number of the load step."""
    role: Literal["fit", "holdout", "asked"]
    """fit or holdout as in the campaign; asked for a row of a table."""
    q_deg: float
    """Angle of the bars, degrees."""
    at_mm: tuple[float, float, float] | None
    """Where the unloaded platform of a manipulator stands, mm; None for other rigs."""
    values: dict[str, float]
    """Numbers of the rig that differ from the campaign's, by key."""
    inputs: dict[str, float]
    """What is prescribed, by column."""
    beyond: tuple[str, ...]
    """What lies beyond the range of the fitted tests, one sentence each."""
    sampled: bool
    """Whether its intervals are by samples, each solved for, and not from the tangent at the fit."""
    lost: str
    """Why the model has no stable state there; empty where it has one."""
    readings: tuple[Reading, ...]
    """Predicted readings; none where the model has no state."""


class ColumnBand(Record):
    """The intervals of one column over all rows."""

    column: str
    """Its name, with its unit."""
    readings: int
    """Predicted readings."""
    half_width: float
    """Median of half the width of the intervals."""
    parameters: float
    """Root mean square of the part of the parameters."""
    tolerances: float
    """Root mean square of the part of what is written."""
    noise: float
    """Root mean square of the part of the noise."""
    fitted: Counted
    """Readings of the fitted tests inside their intervals."""
    held_out: Counted
    """Readings of tests that were not fitted inside their intervals."""


class ColumnComparison(Record):
    """Comparison of one column with its readings in tests that were not fitted, in the terms of ASME V&V 20-2009;
    standard uncertainties, root mean squares over the readings."""

    column: str
    """Its name, with its unit."""
    readings: int
    """Readings compared."""
    error: float
    """Mean of predicted less measured: the comparison error E."""
    error_rms: float
    """Root mean square of the same."""
    u_num: float = 0.0
    """Of the computation of the bar, by mesh and by tie of its ends; 0 where K_b is not from a computation."""
    u_input: float
    """Of the parameters and of what else is written about the rig."""
    u_data: float
    """Of the readings, and of what was prescribed."""
    u_val: float
    """Root of the sum of the squares of the three."""
    area: float | None
    """Area between the distribution of the readings in their predicted laws and the uniform one, 0 to 0.5; None
    where nothing is uncertain."""


class Source(Record):
    """One source of the uncertainty of a parameter."""

    name: str
    """A sensor's column, or a number that is written about the rig."""
    kind: Literal["sensor", "tolerance"]
    """Which of the two."""
    share: float
    """Share of the parameter's variance; those of all sources are one together."""


class Budget(Record):
    """What limits a parameter."""

    parameter: str
    """Its name, effect.parameter."""
    std: float
    """Standard error, in its unit."""
    unit: str
    """Unit of that."""
    sources: tuple[Source, ...]
    """The largest sources, largest first."""


class Predictions(Record):
    """What `predict` finds."""

    campaign: str
    """Name of the campaign."""
    effects: tuple[str, ...]
    """Effects of the model."""
    sampled: int
    """Rows whose intervals are by samples, each solved for; those of the others are from the tangent at the fit."""
    noise_factor: float
    """By which noise and parameters are widened, as more is left than noise; 1 where it is noise."""
    rows: tuple[PredictedRow, ...]
    """Every load step."""
    columns: tuple[ColumnBand, ...]
    """Intervals by column."""
    fitted: Counted
    """Readings of the fitted tests inside their intervals."""
    held_out: Counted
    """Readings of tests that were not fitted inside their intervals."""
    at_bound: tuple[str, ...]
    """Parameters that end at a bound other than the absence of their effect."""
    combined: tuple[tuple[str, ...], ...]
    """Parameters of which the fitted tests determine only combinations, or nothing."""
    comparison: tuple[ColumnComparison, ...] = ()
    """Predicted and measured readings of tests that were not fitted, by column."""
    budget: tuple[Budget, ...] = ()
    """What limits each parameter."""
    sentences: tuple[str, ...] = ()
    """All of it in words."""
    not_done: tuple[str, ...] = ()
    """Optional parts that failed, and why."""
    seconds: float = 0.0
    """Time that it took, s."""
    seed: int = 0
    """Of the samples."""
    commit: str = ""
    """Commit of the program, empty outside a checkout."""
    versions: dict[str, str] = {}  # noqa: RUF012 (pydantic copies it)
    """Of the program and its libraries."""
    data: dict[str, str] = {}  # noqa: RUF012
    """SHA-256 of each file of the campaign, and of the table."""
