"""Which effect the model of a bench lacks, as a result that gives no model where several are possible."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rich.console import RenderableType

from pipeline.answer.law import LawFound
from pipeline.answer.of_diagnosis import answered
from pipeline.answer.tables.added import parameter_table
from pipeline.answer.tables.diagnosis import candidate_table, waterfall
from pipeline.answer.wording.diagnosis import no_next_test
from pipeline.discover.beyond_catalogue import with_laws
from pipeline.discover.table import law_table
from pipeline.discover.words import said_of
from pipeline.errors import InputError
from pipeline.face.about import Given, subject_of
from pipeline.face.of_answer import OfAnswer
from pipeline.face.plans import Plan, plan
from pipeline.face.predictions import At, Prediction, predict
from pipeline.inference.model import Model
from pipeline.parameter_names import path_of
from pipeline.selection.diagnosis import Diagnosis as Found
from pipeline.selection.diagnosis import diagnose as search
from reports.quantities import estimate, phrase

if TYPE_CHECKING:
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture

Names = tuple[str, ...]


class UndecidedError(InputError):
    """A model was asked for where none is certain: the message names the choices and the test that would tell."""


@dataclass(frozen=True, eq=False, repr=False)
class Diagnosis(OfAnswer):
    """What the model of a bench lacks.

    choices: the sets of effects that explain
    the readings, the simplest first; one where the verdict is `identified`, the empty one where it is `within_noise`,
    of `unknown` what helps, if anything. models: the model of the bench with each of these, fitted.
    """

    choices: tuple[Names, ...]
    models: tuple[Model, ...]

    @property
    def laws(self) -> tuple[LawFound, ...]:
        """Laws beyond the catalogue: of what no effect explains, or of all where they explain it as well."""
        return self.answer.laws

    @property
    def beyond(self) -> tuple[str, ...]:
        return tuple(said for law in self.laws for said in said_of(law))

    @property
    def model(self) -> Model:
        """The model with what was identified. UndecidedError where that is not certain: `model_of` takes a choice."""
        if self.verdict in ("identified", "within_noise"):
            return self.models[0]
        raise UndecidedError(self._undecided())

    def model_of(self, *effects: str) -> Model:
        """The model of one of the choices, by all of its effects or by any that no other choice has.

        UndecidedError where no choice has them, or several.
        """
        exact = [k for k, names in enumerate(self.choices) if set(names) == set(effects)]
        found = exact or [k for k, names in enumerate(self.choices) if effects and set(effects) <= set(names)]
        if len(found) != 1:
            asked = " + ".join(effects) or "no effect"
            why = "is in several choices" if found else "is no choice"
            raise UndecidedError(f"{asked} {why}. {self._undecided()}")
        return self.models[found[0]]

    def plan(self) -> Plan:
        """What the tests of this bench can show, and the next one."""
        return plan(self.subject)

    def predict(self, at: At = None, seed: int = 0) -> Prediction:
        """What the sensors will read by the model with what was identified; at: load cases, default the own rows.

        UndecidedError where that model is not certain: `predict(bench.with_model(it.model_of(...)))` takes a choice.
        """
        return predict(self.subject.with_model(self.model), at, seed)

    def tables(self) -> tuple[RenderableType, ...]:
        laws = (law_table(self.laws),) if self.laws else ()
        parameters = (parameter_table(self.answer),) if self.answer.parameters else ()
        return (*laws, waterfall(self.answer), candidate_table(self.answer), *parameters)

    @property
    def sure(self) -> tuple[str, ...]:
        if self.verdict == "identified":
            return tuple(self._phrases(self.choices[0]))
        return tuple(self._certain())

    @property
    def following(self) -> tuple[str, ...]:
        doctor = tuple(f"Mend the table first: {it.mend}" for it in self.answer.doctor)
        test = (f"Next test: {self.answer.next_test['why']}.",) if self.answer.next_test else ()
        if not test and self.verdict == "ambiguous" and len(self.choices) > 1:
            test = (no_next_test(self.answer.evidence),)
        named = {
            "identified": f"bench.add({', '.join(map(repr, self.choices[0]))}) fits them, save_model() keeps them.",
            "ambiguous": "model_of(...) takes one of the choices.",
            "unknown": 'bench.discover().save_effects("law.py") writes the laws as effects for a model.'
            if any(law.form for law in self.laws)
            else "plot() draws the readings that the model misses most."
            if self.answer.evidence and self.answer.evidence.law_words
            else "bench.discover() looks where in the linkage the rest sits, and what law it follows.",
        }
        if doctor:
            return doctor
        return (*test, *((named[self.verdict],) if self.verdict in named else ()))

    def plot(self) -> Picture:
        """Errors on the way at the left; at the right the readings that the model misses most, beside each choice.

        Below these the laws that were found, each over its coordinate.
        """
        from pipeline.face.drawing import worst_curve
        from reports.first_screen.figures import Bars, curve

        models = {"before": self.subject.model}
        several = len(self.choices) > 1
        models |= {
            " + ".join(names) if several else "after": it
            for names, it in zip(self.choices, self.models, strict=True)
            if names
        }
        steps = self.answer.error
        labels = tuple(
            "before" if not k else f"+ {' + '.join(n for n in it.effects if n not in steps[k - 1].effects)}"
            for k, it in enumerate(steps)
        )
        values = tuple((it.fit, it.holdout) for it in steps)
        bars = Bars(
            labels, ("fitted tests", "held-out tests"), values, "error, sigma (1 is noise)", self.name
        )
        return curve(worst_curve(self.subject, models), bars, [law.model_dump() for law in self.laws])

    def to_frame(self) -> DataFrame:
        """One row a parameter of each choice: choice, effect, parameter, value, std, low95, high95 (in `unit`), unit.

        Errors are those of the first choice; of the others the fit alone is known. Then one row a parameter of each law
        beyond the catalogue, without a choice: effect is the place of the law.
        """
        from pandas import DataFrame

        columns = ["choice", "effect", "parameter", "value", "std", "low95", "high95", "unit"]
        return DataFrame(list(self._rows()), columns=columns)

    def json(self) -> str:
        return self.answer.text()

    def _rows(self) -> Iterator[tuple[object, ...]]:
        for k, (names, model) in enumerate(zip(self.choices, self.models, strict=True)):
            choice = " + ".join(names)
            for term in model.terms:
                for p in term.effect.parameters:
                    known = None if k else self.answer.parameters.get(path_of(term.effect.name, p.name))
                    value = float(term.values[p.name]) if known is None else known.value
                    ends = (None, None, None) if known is None else (known.std, known.low95, known.high95)
                    yield choice, term.effect.name, p.name, value, *ends, p.unit
                if not term.effect.parameters:
                    yield choice, term.effect.name, "", None, None, None, None, ""

        for law in self.laws:
            for name, it in law.parameters.items():
                yield "", law.site, name, it.value, it.std, it.low95, it.high95, it.unit
            if not law.parameters:
                yield "", law.site, "", None, None, None, None, ""

    def _phrases(self, names: Names) -> Iterator[str]:
        for name in names:
            mine = {k: v for k, v in self.answer.parameters.items() if k.startswith(f"{name}.")}
            said = [
                phrase(key[len(name) + 1 :], estimate(value.model_dump()), value.unit)
                for key, value in mine.items()
            ]
            yield f"{name}: {', '.join(said)}" if said else name

    def _certain(self) -> Iterator[str]:
        for it in self.answer.certain:
            said = ", ".join(f"{key} = {value:.4g}" for key, value in it.parameters.items())
            yield f"{it.effect}: {said}" if said else it.effect

    def _undecided(self) -> str:
        """Why there is no model yet, which choices there are, which test would tell."""
        listed = " or ".join(f"model_of({', '.join(map(repr, n))})" for n in self.choices)
        # A zero that is open would be taken for an effect.
        evidence = self.answer.evidence
        several = any(self.choices) and not (evidence and evidence.zero)
        choices = f"allowed is {listed}" if several else "there is no effect to choose"
        test = f"; the test that would tell: {self.answer.next_test['why']}" if self.answer.next_test else ""
        sure = "" if self.verdict == "identified" else ", so that no model is certain"
        return f"{self.name}: the verdict is {self.verdict}{sure}; {choices}{test}"


def diagnose(bench: Given) -> Diagnosis:
    """Which physical effect the model of a bench lacks: one, several that cannot be told apart, or none that is known.

    bench: a bench, a result about one, a campaign, or the folder of one; the search begins with its model. Errors are
    whitened root mean squares, 1 is noise; values are in the units of their parameters. InputError for a campaign that
    cannot be judged. Source: docs/verdict.md.
    """
    it = subject_of(bench)
    found = with_laws(search(it.campaign, it.model, it.known.effects))
    return Diagnosis(it, answered(found), found.possible, tuple(_models(found)))


def _models(found: Found) -> Iterator[Model]:
    """The fitted model of each possible set; of the first without numbers that nothing determines."""
    for k, names in enumerate(found.possible):
        yield found.model if k == 0 else found.cache.fit(frozenset(names)).model
