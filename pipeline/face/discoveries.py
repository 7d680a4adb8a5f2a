"""Laws beyond the catalogue that were found in a bench, as a result."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import RenderableType

from pipeline.discover.command import laws_found
from pipeline.discover.effect_file import write_effect
from pipeline.discover.record import Discovered, LawFound
from pipeline.discover.table import headline, table
from pipeline.discover.words import law_sentences
from pipeline.errors import InputError
from pipeline.face.about import AboutBench, Given, subject_of
from pipeline.face.diagnoses import Diagnosis, diagnose
from pipeline.face.plans import Plan, plan

if TYPE_CHECKING:
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture


@dataclass(frozen=True, eq=False, repr=False)
class Discovery(AboutBench):
    """Where in the linkage what no effect explains sits, and what law it follows.

    record: all of it; coordinates and loads of laws in N, mm, rad. effects: names of all that entered the model, laws
    by those of the effect file. effect_file: the text of that file, "" where no law was found.
    """

    record: Discovered
    effects: tuple[str, ...]
    effect_file: str

    @property
    def headline(self) -> str:
        return headline(self.record)

    @property
    def sentences(self) -> tuple[str, ...]:
        return self.record.sentences

    @property
    def beyond(self) -> tuple[str, ...]:
        return law_sentences(self.record)

    @property
    def following(self) -> tuple[str, ...]:
        if not self.effect_file:
            return ()
        names = ", ".join(map(repr, self.effects))
        return (f'save_effects("law.py"), then open(folder, effects=["law.py"]).add({names}).',)

    def tables(self) -> tuple[RenderableType, ...]:
        return (table(self.record),) if self.record.laws or self.record.entered else ()

    def save_effects(self, path: str | Path) -> Path:
        """Write the laws as an effect file, which `open` takes; returns the path. InputError where there is no law."""
        if not self.effect_file:
            raise InputError(f"{self.name}: no law was found, so that there is none to write")
        write_effect(Path(path), self.effect_file)
        return Path(path)

    def diagnose(self) -> Diagnosis:
        """Which effect of the catalogue the model lacks."""
        return diagnose(self.subject)

    def plan(self) -> Plan:
        """What the tests can show, and the next one."""
        return plan(self.subject)

    def plot(self) -> Picture:
        """Each law over its coordinate: the form, the function without a form with its band, single load steps."""
        from reports.first_screen.laws import laws

        return laws([it.model_dump() for it in self.record.laws], self.name)

    def to_frame(self) -> DataFrame:
        """One row a parameter of each law: site, where, form, equation, parameter, value, unit, evidence, fit,
        holdout."""
        from pandas import DataFrame

        of_law, of_fit = ("site", "where", "form", "equation"), ("evidence", "fit", "holdout")
        columns = [*of_law, "parameter", "value", "unit", *of_fit]
        return DataFrame([row for law in self.record.laws for row in _rows(law)], columns=columns)

    def json(self) -> str:
        return self.record.text()


def discover(bench: Given) -> Discovery:
    """Where in the linkage the rest sits that no effect of the catalogue explains, and what law it follows.

    bench: as of `diagnose`. Every place is asked whether one function there, shared by all tests, explains what is
    left. InputError for a rig without places of laws, and where no test may be fitted. Source: docs/laws.md.
    """
    it = subject_of(bench)
    found = laws_found(it.campaign, it.model, it.known)
    return Discovery(it, found.record, found.effects, found.effect_file)


def _rows(law: LawFound) -> list[tuple[object, ...]]:
    head: tuple[object, ...] = (law.site, law.where, law.form, law.equation)
    tail: tuple[object, ...] = (law.evidence, law.fit, law.holdout)
    found = [(*head, name, it.value, it.unit, *tail) for name, it in law.parameters.items()]
    return found or [(*head, None, None, None, *tail)]
