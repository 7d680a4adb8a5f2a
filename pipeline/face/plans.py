"""What the tests of a bench can show, as a result."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from rich.console import RenderableType

from pipeline.face.about import AboutBench, Given, subject_of
from pipeline.parameter_names import path_of
from pipeline.plan.command import plan_of
from pipeline.plan.record import Plan as Record
from pipeline.plan.table import following, headline, tables

if TYPE_CHECKING:
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture


@dataclass(frozen=True, eq=False, repr=False)
class Plan(AboutBench):
    """Smallest sizes of effects that the tests of a bench detect and tell from their rivals, and the test to add.

    record: all of it, sizes in the units of their parameters (`unit` of each).
    """

    record: Record

    @property
    def headline(self) -> str:
        return headline(self.record)

    def tables(self) -> tuple[RenderableType, ...]:
        return tables(self.record)

    @property
    def sentences(self) -> tuple[str, ...]:
        return tuple(following(self.record))

    @property
    def following(self) -> tuple[str, ...]:
        return self.sentences

    def plot(self) -> Picture:
        """Sizes over the typical one of each parameter: 1 is a typical effect, more is hidden from these tests."""
        from reports.first_screen.figures import Bars, errors

        rows = [s for s in self.record.sizes if s.typical]
        values = tuple(
            tuple(None if v is None else v / s.typical for v in (s.detected, s.apart)) for s in rows
        )
        labels = tuple(path_of(s.effect, s.parameter) for s in rows)
        title = f"{self.name}: smallest sizes that the tests show"
        return errors(Bars(labels, ("detected", "told apart"), values, "typical sizes", title))

    def to_frame(self) -> DataFrame:
        """One row a parameter: effect, parameter, unit, typical, detected, apart (in that unit), rival, rho, gamma."""
        from pandas import DataFrame

        return DataFrame([size.model_dump() for size in self.record.sizes])

    def json(self) -> str:
        return self.record.text()


def plan(bench: Given) -> Plan:
    """Which effects the tests of a bench can show and tell apart, measured or not yet, and the next test worth doing.

    bench: a bench, a result about one, a campaign, or the folder of one. Sizes are in the unit of each parameter, from
    its null value: detected with 90 % power, told from the hardest rival in 95 % of cases. InputError for a campaign
    that cannot be used. Source: docs/verdict.md.
    """
    it = subject_of(bench)
    return Plan(it, plan_of(it.campaign, it.model, it.known.effects))
