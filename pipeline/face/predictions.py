"""Readings that the model of a bench predicts, with their intervals, as a result."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, Union

from rich.console import RenderableType

from pipeline.campaign import Campaign
from pipeline.errors import InputError
from pipeline.face.about import AboutBench, Given, subject_of
from pipeline.face.plans import Plan, plan
from pipeline.predict.asked import Asked, own_rows, read_table, table_of
from pipeline.predict.command import predictions_of
from pipeline.predict.files import reading_lines
from pipeline.predict.record import Predictions
from pipeline.predict.table import headline, listed
from reports.quantities import short

if TYPE_CHECKING:
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture

At: TypeAlias = Union[str, Path, "DataFrame", None]
"""Load cases: the file of a table, or a pandas table with the same columns; None for the rows of the campaign."""
TABLE = "the table of load cases"


@dataclass(frozen=True, eq=False, repr=False)
class Prediction(AboutBench):
    """What the sensors of a bench will read by its model, with 95 % intervals, noise included.

    record: all of it, each number in the unit of its column (mm, rad, N, N·mm), the parts of an interval (parameters,
    tolerances, noise) as standard deviations.
    """

    record: Predictions

    @property
    def headline(self) -> str:
        return headline(self.record)

    @property
    def sentences(self) -> tuple[str, ...]:
        return self.record.sentences

    @property
    def following(self) -> tuple[str, ...]:
        more = self.record.noise_factor
        lacking = f"bench.diagnose() says what the model lacks: the fit leaves {short(more)} times the noise."
        loose = "bench.plan() names the test that shows what the fitted tests leave open."
        return (*((lacking,) if more > 1.0 else ()), *((loose,) if self.record.combined else ()))

    def tables(self) -> tuple[RenderableType, ...]:
        return listed(self.record)

    def plan(self) -> Plan:
        """What the tests can show, and the next one."""
        return plan(self.subject)

    def plot(self, test: str | None = None) -> Picture:
        """One history: the 95 % band of each column, its prediction and its readings over the load steps.

        test: its name; default is the first that was not fitted. Histories of one load step each are drawn together,
        over the number of the row. InputError for a name that is not among the predicted ones.
        """
        from reports.first_screen.predictions import predictions

        names = list(dict.fromkeys(row.test for row in self.record.rows))
        if test is not None and test not in names:
            raise InputError(f"{self.name}: {test!r} is not predicted, allowed are {', '.join(names)}")
        return predictions(self.record.model_dump(), test)

    def to_frame(self) -> DataFrame:
        """One row a reading: test, step, role, q_deg, at_x_mm to at_z_mm, column, value, low95, high95, parameters,
        tolerances, noise, measured, inside (1 or 0), sampled, beyond; then what was prescribed (given.*), and numbers
        of the rig that the table changed. Values are in the unit of `column`."""
        from pandas import DataFrame

        head, lines = reading_lines(self.record)
        return DataFrame(lines, columns=head).dropna(axis=1, how="all")

    def json(self) -> str:
        return self.record.text()


def predict(bench: Given, at: At = None, seed: int = 0) -> Prediction:
    """What the sensors of a bench will read, with 95 % intervals parted into parameters, tolerances and noise.

    bench: a bench, a result about one, a campaign, or the folder of one; its model is fitted to the tests that may be
    fitted. at: load cases, a file or a pandas table laid out like measurements.csv (N, mm, rad, °C), which may have
    q_deg or at_x_mm, at_y_mm, at_z_mm and numbers of [rig]; default are the campaign's own rows. seed: of the samples
    that are solved for where the model is not straight over its uncertainty. InputError with every mistake of the
    table, and for an effect that the rig cannot have. Source: docs/tutorials/prediction.md.
    """
    it = subject_of(bench)
    return Prediction(it, predictions_of(it.campaign, it.model, _asked(at, it.campaign), seed))


def _asked(at: At, campaign: Campaign) -> Asked:
    if at is None:
        return own_rows(campaign)
    if isinstance(at, str | Path):
        return read_table(Path(at), campaign)
    if not hasattr(at, "to_csv"):
        raise InputError(f"at = {at!r} is no table, allowed are the path of one, a pandas table, None")
    text = str(at.to_csv(index=False))
    asked = table_of(text, TABLE, campaign)
    return Asked(
        asked.tests, asked.own, asked.values, asked.remarks, {TABLE: sha256(text.encode()).hexdigest()}
    )
