"""What is asked for: the campaign's own rows, or load cases of a table laid out like the measurements.

A table has the columns of measurements.csv, and may have q_deg (or at_x_mm, at_y_mm, at_z_mm) and numbers of [rig],
such as length_mm. Rows one after the other that agree in all but the loads are one history, done in order from the
unloaded state. Where `test` names one of the campaign, they are controlled as that is, at its posture unless the row
says another; else a coordinate is held where its displacement is written, and loaded by its force where it is not.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from hashlib import sha256
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Data, Rig, Test
from pipeline.campaign.control import controls
from pipeline.campaign.head import Head
from pipeline.campaign.model import Vector
from pipeline.campaign.names import (
    COORDINATES,
    DISPLACEMENT,
    DISPLACEMENTS,
    FORCE,
    PLACES,
    TEMPERATURE,
    WRENCHES,
    gauge_column,
    known_columns,
)
from pipeline.campaign.plausible import judge
from pipeline.campaign.rows import steps_of
from pipeline.campaign.sheet import numbers, sheet
from pipeline.campaign.variant import value_keys, varied
from pipeline.errors import InputError, unread
from pipeline.toml.complaints import Complaints, shown
from pipeline.toml.spelling import unknown_name

Array = NDArray[np.float64]
ANGLE = "q_deg"
LARGEST = 2**26
"""Bytes of a table."""


@dataclass(frozen=True, eq=False)
class Asked:
    """Tests to predict. own: whether they are the campaign's own. values: of [rig], by the id of the test that has
    others than the campaign. digests: SHA-256 of the table, by its name."""

    tests: tuple[Test, ...]
    own: bool
    values: dict[str, dict[str, float]]
    remarks: tuple[str, ...] = ()
    digests: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class _History:
    """Rows of a table that are one history, by their numbers."""

    name: str
    rows: NDArray[np.int64]
    q_deg: float | None
    at: Vector | None
    values: tuple[tuple[str, float], ...]


def own_rows(campaign: Campaign) -> Asked:
    """The tests of a campaign as they were done, those that are held out included."""
    return Asked(campaign.tests, True, {})


def read_table(path: Path, campaign: Campaign) -> Asked:
    """The load cases of a file for the rig of a campaign. BadCampaign, with every complaint about the table."""
    asked = table_of(_text(path), str(path), campaign)
    return replace(asked, digests={path.name: sha256(path.read_bytes()).hexdigest()})


def table_of(text: str, name: str, campaign: Campaign) -> Asked:
    """The load cases of a table as text. name: of the table in complaints. BadCampaign, with all of these."""
    complaints = Complaints(name)
    allowed = value_keys(campaign.rig)
    known = (*known_columns(g.name for g in campaign.gauges), ANGLE, *PLACES, *allowed)
    frame = sheet(text, tuple(dict.fromkeys(known)), complaints, ())
    complaints.check()
    return _Table(frame, campaign, complaints, allowed).asked()


def _text(path: Path) -> str:
    try:
        if path.stat().st_size > LARGEST:
            raise InputError(f"{path} has more than {LARGEST // 2**20} MB, allowed is less")
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise InputError(f"{path}: {unread(error)}") from error
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: is not text in UTF-8, allowed is a table of comma-separated values"
        ) from error


class _Table:
    """Makes tests of the rows of a table."""

    def __init__(
        self, frame: pd.DataFrame, campaign: Campaign, complaints: Complaints, keys: tuple[str, ...]
    ) -> None:
        self.campaign, self.complaints = campaign, complaints
        self.tests = {test.id: test for test in campaign.tests}
        self.gauges = [gauge.name for gauge in campaign.gauges]
        self.lines = frame.index.to_numpy(dtype=np.int64)
        columns = (*DISPLACEMENTS, *WRENCHES, *map(gauge_column, self.gauges), TEMPERATURE, ANGLE, *PLACES)
        self.there = {str(name) for name in frame.columns}
        self.values = {name: numbers(frame, name, complaints) for name in dict.fromkeys((*columns, *keys))}
        self.keys = tuple(key for key in keys if key in self.there)
        self.names = list(frame["test"].str.strip()) if "test" in self.there else [""] * len(frame)
        cells = list(frame["step"]) if "step" in self.there else None
        self.steps = None if cells is None else steps_of(cells, self.lines.tolist(), complaints)
        self.rigs: dict[tuple[int, object, object], Rig] = {}
        self.remarks: list[str] = []

    def asked(self) -> Asked:
        """All of it. BadCampaign for complaints."""
        histories = list(self._histories())
        tests = [test for test in map(self._test, histories) if test is not None]
        self.complaints.check()
        values = {h.name: dict(h.values) for h in histories if h.values}
        return Asked(tuple(tests), False, values, tuple(dict.fromkeys(self.remarks)))

    def _histories(self) -> Iterator[_History]:
        """Rows one after the other that agree in all but the loads."""
        settings = (ANGLE, *PLACES, *self.keys)
        marks = [
            (self.names[k], *(_key(self.values[column][k]) for column in settings))
            for k in range(len(self.names))
        ]
        starts = [k for k in range(len(marks)) if k == 0 or marks[k] != marks[k - 1]]
        counts = Counter(self.names[first] or "case" for first in starts)
        seen: dict[str, int] = {}
        for first, end in zip(starts, [*starts[1:], len(marks)], strict=True):
            name = self.names[first] or "case"
            seen[name] = seen.get(name, 0) + 1
            several = counts[name] > 1 or not self.names[first]
            yield _History(
                f"{name} {seen[name]}" if several else name,
                np.arange(first, end),
                _key(self.values[ANGLE][first]),
                self._point(first),
                tuple((key, float(v)) for key in self.keys if np.isfinite(v := self.values[key][first])),
            )

    def _point(self, row: int) -> Vector | None:
        x, y, z = (float(self.values[column][row]) for column in PLACES)
        if np.isfinite([x, y, z]).all():
            return x, y, z
        if np.isfinite([x, y, z]).any():
            self._say("column at_x_mm", f"a posture needs all of {', '.join(PLACES)}", row)
        return None

    def _test(self, it: _History) -> Test | None:
        first = int(it.rows[0])
        name = self.names[first]
        base = self.tests.get(name)
        if name and base is None:
            self._say("column test", f"names {shown(name)}, {unknown_name(name, self.tests)}", first)
            return None
        rig = self._rig(it, base, first)
        if rig is None:
            return None
        control = self._control(it, rig) if base is None else base.control
        if control is None:
            return None
        q_deg = it.q_deg if it.q_deg is not None else base.q_deg if base is not None else 0.0
        data = self._data(it.rows)
        zero = "nominal" if base is None or base.zero == "fitted" else base.zero
        head = Head(it.name, q_deg, "holdout", control, zero, rig, None)
        told = Complaints(self.complaints.file)
        judge(head, data, self.campaign.gauges, self.campaign.noise, self.there, told)
        self.complaints.found += [each for each in told.found if each not in self.complaints.found]
        if zero == "first_row":
            self.remarks.append(
                f"{it.name}: readings count from the first row of the table, as in that test of the campaign"
            )
        return Test(it.name, q_deg, "holdout", control, zero, rig, data)

    def _rig(self, it: _History, base: Test | None, row: int) -> Rig | None:
        """The rig at the posture and with the values of a history; the same object for the same."""
        mine = self.campaign.rig if base is None else base.rig
        key = (id(mine), it.at, it.values)
        if key not in self.rigs:
            try:
                made = varied(mine, dict(it.values), self.campaign.folder)
            except ValueError as error:
                self._say(f"columns {', '.join(key for key, _ in it.values)}", str(error), row)
                return None
            if base is None or it.at is not None or it.q_deg is not None:
                made, mistakes = made.placed(it.q_deg if it.q_deg is not None else self._angle(base), it.at)
                for _, said in mistakes:
                    self._say("", said, row)
                if mistakes:
                    return None
            if made.point is None and any(test.rig.point is not None for test in self.campaign.tests):
                self._say("", f"{', '.join(PLACES)} are missing, or the id of a test that has a posture", row)
                return None
            self.rigs[key] = made
        return self.rigs[key]

    @staticmethod
    def _angle(base: Test | None) -> float | None:
        return None if base is None or base.rig.point is not None else base.q_deg

    def _control(self, it: _History, rig: Rig) -> tuple[str, ...] | None:
        """What is held and what is loaded, where no test of the campaign says it."""
        written = {}
        for k, name in enumerate(COORDINATES):
            if name in rig.supports:
                continue
            moved = np.isfinite(self.values[DISPLACEMENTS[k]][it.rows])
            loaded = np.isfinite(self.values[WRENCHES[k]][it.rows])
            if moved.any() and loaded.any():
                said = (
                    f"and {WRENCHES[k]} are both written, allowed is one of them: what is prescribed; readings "
                    "beside it need the id of a test of the campaign"
                )
                self._say(f"column {DISPLACEMENTS[k]}", said, int(it.rows[0]))
                return None
            written[name] = DISPLACEMENT if moved.any() else FORCE
        control, wrong = controls(written, rig, self.gauges)
        for said in wrong:
            self._say("", said, int(it.rows[0]))
        return None if wrong else control

    def _data(self, rows: NDArray[np.int64]) -> Data:
        def of(columns: tuple[str, ...]) -> Array:
            return np.column_stack([self.values[column][rows] for column in columns])

        warm = self.values[TEMPERATURE][rows]
        steps = np.arange(rows.size) if self.steps is None else np.nan_to_num(self.steps[rows])
        gauges = tuple(map(gauge_column, self.gauges))
        return Data(
            steps.astype(np.int64),
            of(DISPLACEMENTS),
            of(WRENCHES),
            of(gauges) if gauges else np.zeros((rows.size, 0)),
            None if np.isnan(warm).all() else warm,
            self.lines[rows],
        )

    def _say(self, place: str, said: str, row: int) -> None:
        self.complaints.add(place, said, int(self.lines[row]))


def _key(value: float) -> float | None:
    """A cell, None where it is empty: two empty cells are alike."""
    return float(value) if np.isfinite(value) else None


def filled(tests: tuple[Test, ...], values: Array) -> tuple[Test, ...]:
    """The tests with values (R, C), what a sensor of each column would read, in the place of readings that are not
    there; loads that control them are left alone."""
    out, start = [], 0
    for test in tests:
        count = test.data.steps.size
        own = values[start : start + count]
        start += count
        force = np.array([by == FORCE for by in test.control])
        data = test.data
        out.append(
            replace(
                test,
                data=replace(
                    data,
                    displacement=np.where(np.isnan(data.displacement), own[:, :6], data.displacement),
                    wrench=np.where(np.isnan(data.wrench) & ~force, own[:, 6:12], data.wrench),
                    gauges=np.where(np.isnan(data.gauges), own[:, 12:], data.gauges),
                ),
            )
        )
    return tuple(out)
