"""What an effect does to the readings of a usual plan: the model's readings with it, less those without it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from pipeline.assessment.virtual import manipulator as machine
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.campaign import Campaign, Data, ManipulatorRig, Noise, Test
from pipeline.campaign.names import DISPLACEMENT
from pipeline.inference.driving import column_name, driving, unit_of
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model, Term
from pipeline.inference.prediction import predict
from pipeline.manipulator.description import read
from pipeline.simulate import bench_rig
from vjm.effects import catalogue
from vjm.effects.base import Effect
from vjm.effects.sensor_fault import SensorFault
from vjm.effects.sized import sized

Array = NDArray[np.float64]
GEOMETRY = "bar_geometric_nonlinearity"
PANELS, OF_ONE_LOADING, LEAST = 6, 2, 0.05
"""Panels of a picture at most, those of tests that are loaded alike at most, and the least change in sigmas."""
SENSOR = {"sensor_cross_talk": "fy_N<fx_N"}
"""Site at which a fault of a sensor is shown; another fault is that of the cell along y."""


@dataclass(frozen=True, eq=False)
class Panel:
    """One channel of one test. load: (N,) of what drives the test. change: (N,) of the reading; NaN where the model
    has no equilibrium. Both in the unit of their channel; sigma: of the sensor. names of both as column and unit."""

    test: str
    load: Array
    load_name: tuple[str, str]
    change: Array
    name: tuple[str, str]
    sigma: float

    @property
    def size(self) -> float:
        """Root mean square of the change, in sigmas."""
        return float(np.sqrt(np.nanmean(np.square(self.change / self.sigma))))


def shown(effect: Effect) -> Effect:
    """The effect itself; of a kind of fault, that of one sensor."""
    return effect.at(SENSOR.get(effect.name, "fy_N")) if isinstance(effect, SensorFault) else effect


def signature(effect: Effect) -> tuple[Panel, ...]:
    """The channels and tests that change most, of tests that are loaded alike at another angle only one each."""
    if "parallelogram" in effect.kinds:
        plan, base = _bench(), _plain(effect)
    else:
        plan, base = _machine(), Model()
    it = sized(shown(effect), plan.campaign.rig.scale)
    there = Model((*base.terms, Term(it, it.typicals)))
    with_it, without = (predict(model, plan, slopes=False, order=0) for model in (there, base))
    change = with_it.values - without.values
    change[with_it.lost | without.lost] = np.nan
    return _chosen([it for number in range(len(plan.campaign.tests)) for it in _panels(plan, number, change)])


def _plain(effect: Effect) -> Model:
    """Bars as they bend under load, without the effect itself."""
    if effect.name == GEOMETRY:
        return Model()
    return Model((Term(catalogue()[GEOMETRY], {}),))


def _chosen(every: Sequence[Panel]) -> tuple[Panel, ...]:
    out: list[Panel] = []
    loadings: list[str] = []
    for it in sorted(every, key=lambda it: -it.size):
        loading = it.test.rpartition("_")[0]
        alike = any(
            loading == other and it.name == one.name for other, one in zip(loadings, out, strict=True)
        )
        enough = len(out) == PANELS or (out and it.size < LEAST)
        if not enough and not alike and loadings.count(loading) < OF_ONE_LOADING:
            out.append(it)
            loadings.append(loading)
    return tuple(out)


def _panels(plan: LoadCases, number: int, change: Array) -> list[Panel]:
    """All channels of a test that are predicted."""
    rows = slice(int(plan.first[number]), int(plan.first[number + 1]))
    test, gauges = plan.campaign.tests[number], plan.campaign.gauges
    load, values = driving(test, gauges)
    named = (column_name(load, gauges), unit_of(load))
    return [
        Panel(
            test.id,
            values,
            named,
            change[rows, channel],
            (column_name(channel, gauges), unit_of(channel)),
            float(plan.sigma[channel]),
        )
        for channel in np.flatnonzero(plan.predicted[rows].any(axis=0)).tolist()
    ]


@cache
def _bench() -> LoadCases:
    """The plan of the virtual bench, with nothing read but what is prescribed."""
    rig = bench_rig()
    tests = [
        Test(
            one.id,
            one.q_deg,
            "fit",
            one.control,
            "nominal",
            rig,
            _data(one.control, one.values, one.temperature),
        )
        for one in bench_plan()
    ]
    return load_cases(Campaign("bench", rig, SENSORS, GAUGES, tuple(tests)))


@cache
def _machine() -> LoadCases:
    """The plan of a virtual machine, the shipped one."""
    found = read("orthoglide")
    rig = ManipulatorRig(length=found.manipulator.length, manipulator=found.manipulator, file="orthoglide")
    control = ("force",) * 6
    tests = [
        Test(
            one.id,
            0.0,
            "fit",
            control,
            "nominal",
            rig.placed(None, one.point)[0],
            _data(control, one.loads, None),
        )
        for one in machine.plan(found.manipulator, found.home)
    ]
    noise: Noise = machine.NOISE
    return load_cases(Campaign("machine", rig, noise, (), tuple(tests)))


def _data(control: Sequence[str], values: Array, temperature: Array | None) -> Data:
    by_way = np.array([by == DISPLACEMENT for by in control])
    count = len(values)
    return Data(
        np.arange(count),
        np.where(by_way, values, 0.0),
        np.where(by_way, 0.0, values),
        np.zeros((count, len(GAUGES) if temperature is not None else 0)),
        temperature,
        np.zeros(count, dtype=np.int64),
    )
