"""A bench that is opened: its campaign, its model, and everything that can be asked of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from rich.console import RenderableType

from pipeline.campaign import write
from pipeline.campaign.names import TEMPERATURE, channel_columns
from pipeline.face.about import AboutBench, Given, opened, subject_of
from pipeline.face.additions import Addition, add, improve, remove
from pipeline.face.comparisons import Comparison, compare
from pipeline.face.diagnoses import Diagnosis, diagnose
from pipeline.face.discoveries import Discovery, discover
from pipeline.face.plans import Plan, plan
from pipeline.face.predictions import At, Prediction, predict
from pipeline.inference.driving import column_name, driving, unit_of
from pipeline.inference.model import Model
from pipeline.terminal import cell, lean, one_line
from reports.quantities import short
from vjm.effects.base import Effect

if TYPE_CHECKING:
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture

NAME = 32
"""Cells of a test's name; longer ones go on below."""


@dataclass(frozen=True, eq=False, repr=False)
class Bench(AboutBench):
    """A campaign of measurements with its model. Nothing of it changes: whatever is asked gives a new result.

    Readings in N, mm, rad and °C: displacements of the platform point from its nominal unloaded pose, the wrench
    exerted on the platform at that point, both in the base frame.
    """

    @property
    def model(self) -> Model:
        """Plain virtual springs, or the model that is kept with the campaign."""
        return self.subject.model

    @property
    def headline(self) -> str:
        it = self.subject.campaign
        rows = sum(test.data.steps.size for test in it.tests)
        size = f"{it.rig.kind} of {short(it.rig.length)} mm"
        counts = f"{len(it.tests)} tests, {rows} load steps"
        effects = f", model: {' + '.join(self.model.names)}" if self.model.names else ""
        return one_line(f"{it.name}: {size}, {counts}{effects}", f"{it.name}: {size}, {counts}", counts)

    @property
    def sentences(self) -> tuple[str, ...]:
        return (self.headline, *self.subject.campaign.remarks)

    @property
    def following(self) -> tuple[str, ...]:
        return (
            "bench.compare() says how far the models are from the readings, bench.diagnose() what is missing.",
        )

    def tables(self) -> tuple[RenderableType, ...]:
        table = lean("test", "steps", "driven", "from", "to")
        table.add_column("unit")
        for test in self.subject.campaign.tests:
            channel, loads = driving(test, self.subject.campaign.gauges)
            ends = (short(float(np.min(loads))), short(float(np.max(loads))))
            name = test.id if test.role == "fit" else f"{test.id} (held out)"
            driven = column_name(channel, self.subject.campaign.gauges)
            table.add_row(cell(name, NAME), str(loads.size), driven, *ends, unit_of(channel))
        return (table,)

    def with_model(self, model: Model) -> Bench:
        """The same bench with another model, such as `diagnosis.model_of("joint_friction")`."""
        return Bench(self.subject.with_model(model))

    def compare(self) -> Comparison:
        """LIN, VJM, the model and FEA beside the readings."""
        return compare(self.subject)

    def diagnose(self) -> Diagnosis:
        """Which effect the model lacks."""
        return diagnose(self.subject)

    def add(self, *effects: str | Effect) -> Addition:
        """The model with further effects, fitted."""
        return add(self.subject, *effects)

    def remove(self, *effects: str) -> Addition:
        """The model without some of its effects, fitted again."""
        return remove(self.subject, *effects)

    def improve(self) -> Addition:
        """Diagnosed, and what is certain added effect by effect."""
        return improve(self.subject)

    def plan(self) -> Plan:
        """What the tests can show, and the next one."""
        return plan(self.subject)

    def predict(self, at: At = None, seed: int = 0) -> Prediction:
        """What the sensors will read by the model, with 95 % intervals; at: load cases, default its own rows."""
        return predict(self.subject, at, seed)

    def discover(self) -> Discovery:
        """Where the rest sits that no effect of the catalogue explains, and what law it follows."""
        return discover(self.subject)

    def plot(self) -> Picture:
        """The readings that the model misses most, beside what it predicts."""
        from pipeline.face.drawing import worst_curve
        from reports.first_screen.figures import curve

        name = " + ".join(self.model.names) or "plain virtual springs"
        return curve(worst_curve(self.subject, {name: self.model}))

    def to_frame(self) -> DataFrame:
        """One row a load step: test, q_deg, role, step, and a column for each sensor, in the unit that it names."""
        from pandas import DataFrame

        frame = DataFrame(list(self._rows()))
        return frame.dropna(axis=1, how="all")

    def json(self) -> str:
        return str(self.to_frame().to_json(orient="records", indent=1)) + "\n"

    def write(self, folder: str | Path) -> Path:
        """Write campaign.toml and measurements.csv into a folder; returns it. The model is kept by
        `Addition.save_model`. InputError where nothing can be written."""
        place = Path(folder)
        write(place, self.subject.campaign)
        return place

    def _rows(self) -> Iterator[dict[str, object]]:
        it = self.subject.campaign
        names = channel_columns(it.gauges)
        for test in it.tests:
            data = test.data
            warm = np.full(data.steps.size, np.nan) if data.temperature is None else data.temperature
            for step, row, degrees in zip(data.steps, data.readings, warm, strict=True):
                head = {"test": test.id, "q_deg": test.q_deg, "role": test.role, "step": int(step)}
                yield {**head, **dict(zip(names, map(float, row), strict=True)), TEMPERATURE: float(degrees)}


def open_bench(
    folder: str | Path, model: str | Path | None = None, effects: Iterable[str | Path | Effect] = ()
) -> Bench:
    """Open a bench: the folder of a campaign, with the model that is kept there.

    folder: with campaign.toml and its readings. model: another model.toml than the one in the folder. effects: effects
    of one's own beside the catalogue, or files that define them (they are run as Python). InputError with every mistake
    in the files: file, line, key or column, what was found and what is allowed. Nothing is written.
    """
    return Bench(opened(Path(folder), None if model is None else Path(model), effects))


def bench_of(given: Given) -> Bench:
    """A bench of what a function may be given."""
    return Bench(subject_of(given))
