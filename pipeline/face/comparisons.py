"""Models beside the readings of a bench, as a result."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from rich.console import RenderableType

from pipeline.compare.models import compare_models
from pipeline.compare.record import Comparison as Record
from pipeline.compare.record import ModelError
from pipeline.compare.table import HEADS, headline, page, sentence, tests_table
from pipeline.face.about import AboutBench, Given, subject_of
from pipeline.face.diagnoses import Diagnosis, diagnose
from pipeline.face.plans import Plan, plan
from pipeline.face.shown import rendered

if TYPE_CHECKING:
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture


@dataclass(frozen=True, eq=False, repr=False)
class Comparison(AboutBench):
    """How far LIN, VJM, the model of the bench and FEA are from the readings, and how they fail.

    record: all of it; errors in sigmas, 1 is noise, and in the units of the columns (mm, rad, N, N·mm).
    """

    record: Record

    @property
    def shown(self) -> ModelError:
        """The model whose failure is told: that of the bench, or plain virtual springs."""
        return self.record.model_of(self.record.shown)

    @property
    def headline(self) -> str:
        return headline(self.record)

    @property
    def sentences(self) -> tuple[str, ...]:
        told = [it.sentence for it in self.shown.findings if it.sentence]
        return (sentence(self.record), *told)

    @property
    def following(self) -> tuple[str, ...]:
        if self.shown.within_noise or self.shown.untested:
            return ()
        return ("bench.diagnose() looks for the effect that is missing.",)

    def tables(self) -> tuple[RenderableType, ...]:
        return (tests_table(self.record),)

    def text(self, full: bool = False) -> str:
        """As on the terminal; full: every test, not only the worst."""
        return rendered(page(self.record, full=full))

    def diagnose(self) -> Diagnosis:
        """Which effect the model lacks."""
        return diagnose(self.subject)

    def plan(self) -> Plan:
        """What the tests can show, and the next one."""
        return plan(self.subject)

    def plot(self) -> Picture:
        """Error of each test by each model, in sigmas."""
        from reports.first_screen.figures import Bars, errors

        models = [model for model in self.record.models if model.tests]
        by_test = [{test.test: test.rms for test in model.tests} for model in models]
        ids = tuple(test.test for test in models[0].tests) if models else ()
        values = tuple(tuple(found.get(name) for found in by_test) for name in ids)
        names = tuple(HEADS[model.model] for model in models)
        return errors(Bars(ids, names, values, "error, sigma (1 is noise)", self.name))

    def to_frame(self) -> DataFrame:
        """One row a test: test, q_deg, role, and the error in sigmas by each model, of which the name is the column."""
        from pandas import DataFrame

        rows: dict[str, dict[str, object]] = {}
        for model in self.record.models:
            for test in model.tests:
                mine = rows.setdefault(test.test, {"test": test.test, "q_deg": test.q_deg, "role": test.role})
                mine[HEADS[model.model]] = test.rms
        return DataFrame(list(rows.values()))

    def json(self) -> str:
        return self.record.text()


def compare(bench: Given) -> Comparison:
    """LIN, VJM, the model of the bench where it has effects, and FEA beside the readings; nothing is fitted.

    bench: a bench, a result about one, a campaign, or the folder of one. Errors are in sigmas, 1 is noise. InputError
    for a campaign that cannot be used.
    """
    it = subject_of(bench)
    return Comparison(it, compare_models(it.campaign, it.model if it.model.terms else None))
