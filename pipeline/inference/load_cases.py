"""The load cases of a campaign as arrays: tests of one rig together, so that they are solved together."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Gauge, Test
from pipeline.campaign import Rig as Described
from pipeline.campaign.names import DISPLACEMENT, FORCE, SUPPORT, channel_columns
from pipeline.campaign.order import run_order
from pipeline.campaign.rig import Solvable
from vjm.effects.sensor_fault import Rows
from vjm.effects.thermal_expansion import DRIVE
from vjm.lagrangian import layout
from vjm.work import UNKNOWNS

Array = NDArray[np.float64]
CHANNELS = 12
"""Six of the pose and six of the wrench; gauges follow."""
INPUTS = 7
"""What is prescribed for each coordinate, and the temperature."""
LOST = 30.0
"""Sigmas that stand for a reading for which the model has no stable equilibrium."""


@dataclass(frozen=True, eq=False)
class Group:
    """Tests on one rig, or on rigs that stand as it (`Rig.stands_as`), filled up to equal numbers of steps with their
    last one.

    rigs: (T,), the first one `rig`. numbers: (T,) of the tests in the campaign. lengths: (T,) steps. targets:
    (T, S, 6) as `vjm.equilibrium` takes them. channels: (T, 6). q: (T,) rad. rise: (T, S) K above the reference
    temperature.
    """

    rigs: tuple[Described, ...]
    numbers: np.ndarray
    lengths: np.ndarray
    targets: Array
    channels: np.ndarray
    q: Array
    rise: Array

    @property
    def rig(self) -> Described:
        """Of the first test: the others differ by where they stand alone."""
        return self.rigs[0]

    @property
    def nominal(self) -> Array:
        """(T, 1, 6) pose from which displacements count."""
        if all(rig is self.rig for rig in self.rigs):
            return self.rig.nominal_pose(self.q)[:, None, :]
        return np.stack([rig.nominal_pose(q) for rig, q in zip(self.rigs, self.q, strict=True)])[:, None, :]

    @property
    def alike(self) -> Hashable:
        """Equal where the mechanisms of groups are."""
        return self.rig.alike_of(self.rigs)

    def mechanism(self, gauges: tuple[Gauge, ...]) -> Solvable:
        """The plain mechanism of all of them."""
        return self.rig.mechanism_of(self.rigs, gauges)

    def inputs(self, mechanism: Solvable) -> dict[str, Array]:
        """(T, 1) or (T, S) of each input of a mechanism, made of the plain one, by what a test prescribes: its angle,
        its temperature, where its rig stands."""
        drives = layout(mechanism).drives
        given = {"q": self.q[:, None], DRIVE: self.rise}
        out = {name: value for name, value in given.items() if name in drives}
        return out | self.standing(mechanism)

    def standing(self, mechanism: Solvable) -> dict[str, Array]:
        """(T, 1) of the inputs by which it stands where the rig of each test does."""
        return {name: value[:, None] for name, value in self.rig.inputs_of(mechanism, self.rigs).items()}

    def turned(self, angle: float) -> Group:
        """The tests with the unloaded linkage turned to further angles, rad, from where displacements count."""
        if not angle:
            return self
        there = replace(self, q=self.q + angle)
        moved = np.where((self.channels < 6)[:, None], there.nominal - self.nominal, 0.0)
        return replace(there, targets=self.targets + moved)

    @cached_property
    def real(self) -> np.ndarray:
        """(T, S) steps that are not filling."""
        return np.arange(self.targets.shape[1]) < self.lengths[:, None]

    def done_alike(self, other: Group) -> bool:
        """Whether another group has the same tests, on the same rigs, with the same prescribed."""
        same = len(self.rigs) == len(other.rigs) and all(
            a is b for a, b in zip(self.rigs, other.rigs, strict=True)
        )
        names = ("numbers", "lengths", "targets", "channels", "q", "rise")
        return same and all(np.array_equal(getattr(self, n), getattr(other, n)) for n in names)

    @cached_property
    def by_steps(self) -> Group:
        """Every real step as a test of its own, without filling; numbers are those of their tests."""
        test, step = np.nonzero(self.real)
        return Group(
            tuple(self.rigs[k] for k in test),
            self.numbers[test],
            np.ones(test.size, dtype=int),
            self.targets[test, step][:, None],
            self.channels[test],
            self.q[test],
            self.rise[test, step][:, None],
        )

    @cached_property
    def places(self) -> np.ndarray:
        """(T, S) of each step among the real ones; filling has the place of the step that it repeats."""
        last = np.cumsum(self.lengths)[:, None] - 1
        first = last - self.lengths[:, None] + 1
        return np.asarray(np.minimum(first + np.arange(self.targets.shape[1]), last))


@dataclass(frozen=True, eq=False)
class LoadCases:
    """All rows of a campaign, in its order; C = 12 + gauges channels.

    measured: (R, C), NaN where not measured. predicted: (R, C) mask of what a model predicts and the campaign
    measured, with a sigma. channels: (R, 6) channel that each coordinate's control prescribes. input_sigma: (R, 7)
    noise of what is prescribed, and of the temperature, K. sigma: (C,) noise of every sensor at a reading of zero.
    test: (R,) its number.
    by_nominal: (R, C, K) derivative of the predictions by what was written about the rig, in its standard deviations,
    near the models that are fitted; None where all is exact, or not looked at yet. whole_clock: (R,) share of the
    campaign that was done before, where these are not all of its rows.
    """

    campaign: Campaign
    groups: tuple[Group, ...]
    measured: Array
    predicted: np.ndarray
    channels: np.ndarray
    input_sigma: Array
    sigma: Array
    test: np.ndarray
    by_nominal: Array | None = None
    whole_clock: Array | None = None

    @cached_property
    def rows(self) -> Rows:
        """The rows as sensors read them."""
        steps = [test.data.steps - test.data.steps[0] for test in self.campaign.tests]
        clock = self.whole_clock
        if clock is None:
            each = [np.arange(self.first[k], self.first[k + 1]) for k in run_order(self.campaign.tests)]
            clock = np.linspace(0.0, 1.0, len(self.test))[np.argsort(np.concatenate(each))]
        columns = tuple(channel_columns(self.campaign.gauges))
        return Rows(self.test, np.concatenate(steps).astype(float), clock, columns)

    @cached_property
    def spread(self) -> Array:
        """(R, C) standard deviation of every reading; NaN where none is known."""
        noise = self.campaign.noise
        return np.concatenate([noise.spread(test.data.readings) for test in self.campaign.tests])

    @cached_property
    def first(self) -> np.ndarray:
        """(tests + 1,) first row of each test."""
        counts = [test.data.steps.size for test in self.campaign.tests]
        return np.concatenate([[0], np.cumsum(counts)]).astype(int)

    @cached_property
    def unknowns(self) -> float:
        """Of all rigs together, each solved by itself, in those of a parallelogram; at least one."""
        every = (group.mechanism(self.campaign.gauges) for group in self.groups)
        return max(1.0, sum(layout(it).size for it in every) / UNKNOWNS)

    @cached_property
    def unweighted(self) -> np.ndarray:
        """(R, C) readings of what a model predicts whose sigma is not known: they are told in units alone."""
        there = np.isfinite(self.measured) & np.isnan(self.sigma)
        np.put_along_axis(there, self.channels, False, axis=1)
        return there

    @cached_property
    def from_first(self) -> np.ndarray:
        """(T, C) channels that are less their first reading in a test: the noise of that one is in all others."""
        columns = channel_columns(self.campaign.gauges)
        return np.array(
            [[name in test.data.from_first for name in columns] for test in self.campaign.tests]
        ).reshape(len(self.campaign.tests), len(columns))

    @cached_property
    def loose(self) -> np.ndarray:
        """(T, C) channels whose zero in a test is not known: no sensor was zeroed, or by no more than one reading."""
        every = np.array([test.zero != "nominal" for test in self.campaign.tests])
        return np.asarray(self.from_first | every[:, None])

    @cached_property
    def unknown_zeros(self) -> int:
        """Zeros of predicted readings that the fitted tests leave unknown, each with a reading of its own."""
        return sum(
            int(np.sum(np.any(self.predicted[self.test == k], axis=0) & self.loose[k]))
            for k, test in enumerate(self.campaign.tests)
            if test.role == "fit"
        )

    @cached_property
    def fitted(self) -> np.ndarray:
        """(R,) rows that may be used to fit and to choose."""
        roles = np.array([test.role == "fit" for test in self.campaign.tests])
        return roles[self.test]

    def done_alike(self, other: LoadCases) -> bool:
        """Whether others are of the same tests, done and zeroed in the same way: then a model predicts the same."""
        zeros, others = ([test.zero for test in it.campaign.tests] for it in (self, other))
        return (
            zeros == others
            and self.campaign.tolerance == other.campaign.tolerance
            and len(self.groups) == len(other.groups)
            and all(a.done_alike(b) for a, b in zip(self.groups, other.groups, strict=True))
        )

    def rows_of(self, group: Group) -> np.ndarray:
        """Rows of the real steps of a group, test by test."""
        return np.concatenate([np.arange(self.first[n], self.first[n + 1]) for n in group.numbers])

    @cached_property
    def by_displacement(self) -> LoadCases | None:
        """With every displacement prescribed that was read beside the force that is; None where there is none."""
        tests = tuple(_by_displacement(test) for test in self.campaign.tests)
        same = all(
            one.control == other.control for one, other in zip(tests, self.campaign.tests, strict=True)
        )
        return (
            None
            if same
            else replace(load_cases(replace(self.campaign, tests=tests)), whole_clock=self.whole_clock)
        )

    @cached_property
    def by_role(self) -> tuple[tuple[NDArray[np.int64], LoadCases], ...]:
        """Rows that may be fitted and those that may not, as load cases of their own; all in one if all are alike."""
        if self.fitted.all() or not self.fitted.any():
            return ((np.arange(len(self.test)), self),)
        return tuple((rows, self.only(rows)) for rows in map(np.flatnonzero, (self.fitted, ~self.fitted)))

    def only(self, *several: NDArray[np.int64]) -> LoadCases:
        """The load cases of these rows (N,) alone; tests without any are left out. Of several sets of rows, which may
        share some, one after the other, each as tests of their own. The rows of a set stand in the order of the
        campaign."""
        tests = [
            _rows_of(test, rows[self.test[rows] == k] - self.first[k])
            for rows in several
            for k, test in self._tests(rows)
        ]
        every = np.concatenate(several)
        part = load_cases(replace(self.campaign, tests=tuple(tests)))
        line = None if self.by_nominal is None else self.by_nominal[every]
        return replace(part, by_nominal=line, whole_clock=self.rows.clock[every])

    @property
    def plain(self) -> LoadCases:
        """As if what was written were exact."""
        return self if self.by_nominal is None else replace(self, by_nominal=None)

    def _tests(self, rows: NDArray[np.int64]) -> list[tuple[int, Test]]:
        return [(int(k), self.campaign.tests[k]) for k in np.unique(self.test[rows])]


def load_cases(campaign: Campaign) -> LoadCases:
    """The load cases of a campaign. Readings of a channel without a sigma are not compared, see `unweighted`."""
    tests, gauges = campaign.tests, campaign.gauges
    noise = campaign.noise
    sigma = noise.sigmas
    measured = np.concatenate([t.data.readings for t in tests], axis=0)
    number = np.repeat(np.arange(len(tests)), [t.data.steps.size for t in tests])
    channels = np.array([_channels(t.control, [g.name for g in gauges]) for t in tests])[number]
    given = np.take_along_axis(measured, channels, axis=1)
    spread = np.concatenate([noise.spread(t.data.readings) for t in tests])
    held = np.array([[by == SUPPORT for by in t.control] for t in tests])[number]
    # A force that was not read, and a coordinate on its support, are what they are without a sensor's noise.
    input_sigma = np.take_along_axis(np.nan_to_num(spread), channels, axis=1)
    input_sigma = np.where(np.isnan(given) | held, 0.0, input_sigma)
    warm = np.full((len(number), 1), np.nan_to_num(noise.temperature))
    input_sigma = np.concatenate([input_sigma, warm], axis=1)
    # A reading whose scatter nobody knows is compared in units alone, one without any scatter says nothing of a model.
    predicted = np.isfinite(measured) & (sigma > 0.0)
    np.put_along_axis(predicted, channels, False, axis=1)
    groups: dict[int, list[int]] = {}
    for k, test in enumerate(tests):
        same = next((n for n in groups if tests[n].rig.stands_as(test.rig)), k)
        groups.setdefault(same, []).append(k)
    return LoadCases(
        campaign,
        tuple(_group(campaign, np.array(numbers)) for numbers in groups.values()),
        measured,
        predicted,
        channels,
        input_sigma,
        sigma,
        number,
    )


def _group(campaign: Campaign, numbers: np.ndarray) -> Group:
    tests = [campaign.tests[n] for n in numbers]
    lengths = np.array([t.data.steps.size for t in tests])
    longest = int(lengths.max())
    q = np.array([t.q for t in tests])
    channels = np.array([_channels(t.control, [g.name for g in campaign.gauges]) for t in tests])
    targets, rise = np.zeros((len(tests), longest, 6)), np.zeros((len(tests), longest))
    reference = tests[0].rig.reference_temperature
    for k, test in enumerate(tests):
        inputs = test.inputs(campaign.gauges)
        inputs = inputs + np.where(channels[k] < 6, test.rig.nominal_pose(q[k]), 0.0)
        targets[k] = inputs[np.minimum(np.arange(longest), lengths[k] - 1)]
        if test.data.temperature is not None and reference is not None:
            warm = np.nan_to_num(test.data.temperature - reference)
            rise[k] = warm[np.minimum(np.arange(longest), lengths[k] - 1)]
    return Group(tuple(t.rig for t in tests), numbers, lengths, targets, channels, q, rise)


def _by_displacement(test: Test) -> Test:
    both = np.isfinite(np.concatenate([test.data.displacement, test.data.wrench])).all(axis=0)
    control = [
        DISPLACEMENT if by == FORCE and read else by
        for by, read in zip(test.control, both.tolist(), strict=True)
    ]
    return replace(test, control=tuple(control))


def _rows_of(test: Test, rows: NDArray[np.int64]) -> Test:
    data = test.data
    part = replace(
        data,
        steps=data.steps[rows],
        displacement=data.displacement[rows],
        wrench=data.wrench[rows],
        gauges=data.gauges[rows],
        temperature=None if data.temperature is None else data.temperature[rows],
        lines=data.lines[rows],
    )
    return replace(test, data=part)


def _channels(control: tuple[str, ...], gauges: list[str]) -> list[int]:
    numbers = []
    for k, by in enumerate(control):
        if by in (DISPLACEMENT, SUPPORT):
            numbers.append(k)
        else:
            numbers.append(k + 6 if by == FORCE else CHANNELS + gauges.index(by))
    return numbers
