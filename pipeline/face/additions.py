"""Effects added to the model of a bench and fitted, as a result from which it goes on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import RenderableType

from pipeline.add.fitting import Added
from pipeline.add.fitting import add as fit_with
from pipeline.add.fitting import remove as fit_without
from pipeline.answer.summary import uncertainty_of
from pipeline.answer.tables.added import error_table, parameter_table
from pipeline.errors import InputError
from pipeline.face.about import Given, effects_of, subject_of
from pipeline.face.comparisons import Comparison, compare
from pipeline.face.diagnoses import Diagnosis, diagnose
from pipeline.face.of_answer import OfAnswer
from pipeline.face.plans import Plan, plan
from pipeline.face.predictions import At, Prediction, predict
from pipeline.face.subject import Subject
from pipeline.improve.command import improved
from pipeline.improve.steps import steps
from pipeline.inference.model import Model
from pipeline.inference.model_file import NAME, fitted_now, write_model
from pipeline.parameter_names import parted
from pipeline.selection.diagnosis import diagnose as search
from vjm.effects import shipped
from vjm.effects.base import Effect

if TYPE_CHECKING:
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture


@dataclass(frozen=True, eq=False, repr=False)
class Addition(OfAnswer):
    """A bench whose model has got effects, or lost some, and was fitted.

    subject: with the new model, so that whatever is asked of this result goes on from there. before: the model before.
    keep: why the new model should not take the place of the one before, "" if nothing speaks against it.
    """

    before: Model
    keep: str = ""

    @property
    def model(self) -> Model:
        """The new model, fitted."""
        return self.subject.model

    @property
    def following(self) -> tuple[str, ...]:
        if self.verdict == "within_noise":
            return ("save_model() keeps the model with the campaign.",)
        return ("diagnose() looks for what is still missing.",)

    def tables(self) -> tuple[RenderableType, ...]:
        parameters = (parameter_table(self.answer),) if self.answer.parameters else ()
        return (*parameters, error_table(self.answer))

    def compare(self) -> Comparison:
        """The new model beside LIN, VJM and FEA."""
        return compare(self.subject)

    def diagnose(self) -> Diagnosis:
        """Which effect the new model lacks."""
        return diagnose(self.subject)

    def plan(self) -> Plan:
        """What the tests can show beside the new model, and the next one."""
        return plan(self.subject)

    def predict(self, at: At = None, seed: int = 0) -> Prediction:
        """What the sensors will read by the new model, with 95 % intervals; at: load cases, default the own rows."""
        return predict(self.subject, at, seed)

    def save_model(self, path: str | Path | None = None) -> Path:
        """Write the model as model.toml, by default into the campaign's folder; returns the path.

        InputError for a model with an effect that no file defines, where nothing can be written, and without a path for
        a campaign that has no folder.
        """
        campaign, known = self.subject.campaign, self.subject.known
        if path is None and campaign.folder is None:
            raise InputError(f"{self.name} has no folder, allowed is save_model(path)")
        for term in self.model.terms:
            if term.effect.name not in known.files and not shipped(term.effect):
                raise InputError(
                    f"{term.effect.name} is defined in no file of its own, allowed is open(folder, effects=[file])"
                )
        place = Path(path) if path is not None else Path(campaign.folder or "") / NAME
        told = uncertainty_of(self.answer.parameters, self.model)
        write_model(place, fitted_now(self.model, told, known, self.name))
        return place

    def plot(self) -> Picture:
        """Error of each test before and after at the left; at the right the readings that were missed most."""
        from pipeline.face.drawing import worst_curve
        from reports.first_screen.figures import Bars, curve

        tests = sorted(self.answer.tests, key=lambda it: -(it.before.rms or 0.0))
        values = tuple((it.before.rms, it.after.rms) for it in tests)
        labels = tuple(it.test if it.role == "fit" else f"{it.test} (held out)" for it in tests)
        bars = Bars(labels, ("before", "after"), values, "error, sigma (1 is noise)", self.name)
        return curve(worst_curve(self.subject, {"before": self.before, "after": self.model}), bars)

    def to_frame(self) -> DataFrame:
        """One row a parameter: effect, parameter, value, std, low95, high95 (in `unit`), interval, unit, meaning."""
        from pandas import DataFrame

        columns = ["effect", "parameter", "value", "std", "low95", "high95", "interval", "unit", "meaning"]
        return DataFrame(list(self._rows()), columns=columns)

    def json(self) -> str:
        return self.answer.text()

    def _rows(self) -> Iterator[tuple[object, ...]]:
        for name, it in self.answer.parameters.items():
            yield *parted(name), it.value, it.std, it.low95, it.high95, it.interval, it.unit, it.meaning


def add(bench: Given, *effects: str | Effect) -> Addition:
    """The model of a bench with further effects, all its free numbers fitted to the tests that may be fitted.

    effects: names of the catalogue or of files that the bench knows, or effects of one's own. Nothing is written:
    `save_model` does. InputError for an effect that is unknown, that is in the model or that the rig cannot have.
    """
    it, wanted = effects_of(subject_of(bench), effects)
    return _addition(it, fit_with(it.campaign, it.model, wanted))


def remove(bench: Given, *effects: str) -> Addition:
    """The model of a bench without some of its effects, the rest fitted again. InputError for one that it has not."""
    it = subject_of(bench)
    return _addition(it, fit_without(it.campaign, it.model, effects))


def improve(bench: Given) -> Addition:
    """Diagnose and add what is certain, effect by effect, until the error is noise or nothing known helps.

    bench: as of `diagnose`. Of several sets that cannot be told apart only what all of them share is added.
    """
    it = subject_of(bench)
    found = search(it.campaign, it.model, it.known.effects)
    done = list(steps(found))
    return Addition(
        it.with_model(done[-1].fit.model.freed(it.model)), improved(found, it.model, done), it.model
    )


def _addition(it: Subject, found: Added) -> Addition:
    return Addition(it.with_model(found.model), found.answer, it.model, found.keep)
