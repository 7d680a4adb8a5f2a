"""How large a placed law shows, and the size at which it shows by so many sigmas."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from fem.frame.laws.forms.smooth import Linear
from fem.frame.placed import Placed
from pipeline.assessment.challenge.benches import Bench
from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.challenge.laws.cases import Hidden
from pipeline.assessment.challenge.outcome import difference
from pipeline.assessment.virtual.bench import read_out, true_readings
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.campaign import ParallelogramRig
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.inference.residual import Whitening, whitening
from vjm.effects import catalogue

Array = NDArray[np.float64]
HINGE = "hinge_torque"
TRIES = 9
"""Runs of the truth at most to bring a law to its size."""
WITHIN = 0.02
"""Share by which the size may be missed."""
RIGID = {"mm": 1e9, "rad": 1e13}
"""N/mm and N·mm/rad of a series law that shows what load passes: ten thousand bars and more."""
FIRST = {"torque": 200.0, "mm": 5e-3, "rad": 5e-5}
"""Sizes that are tried first: N·mm at a hinge, mm or rad at a series site."""
IDLE = {"torque": 1e-7, "mm": 1.0, "rad": 100.0}
"""Largest coordinate of a hinge, rad, or load of a series site, N or N·mm, that is as good as none."""
LARGEST = {"torque": 2e5, "mm": 1.0, "rad": 0.02}
"""Sizes beyond which a site counts as out of sight."""


class OutOfSight(RuntimeError):
    """A law at this site shows in none of the fitted tests by as much as it should."""


@dataclass(frozen=True, eq=False)
class Scale:
    """Of a bench: what sees a change of its exact readings, in sigmas.

    without: exact readings of the fitted tests without any law; cases, reference, white: load cases, prediction and
    whitening about these; tests (N,): number of the test of each whitened reading.
    """

    bench: Bench
    without: list[Readings]
    cases: LoadCases
    reference: Prediction
    white: Whitening
    tests: NDArray[np.int64]

    def signature(self, found: Sequence[Readings]) -> Array:
        """(N,) whitened difference of readings from those without, less what prescribed ones answer for."""
        return difference(self.cases, _program(self.bench, found), self.reference, self.white)


def scale_of(bench: Bench, true: ParallelogramRig) -> Scale:
    """The scale of the tests of a bench, all taken as fitted; RuntimeError where the true rig does not bear them."""
    without = true_readings(true, bench.plan, {}, GAUGES)
    cases = _program(bench, without)
    reference = predict(Model().with_effects([catalogue()[ALWAYS]]), cases, slopes=False)
    white = whitening(cases, reference)
    used = cases.predicted & cases.fitted[:, None]
    return Scale(bench, without, cases, reference, white, cases.test[np.nonzero(used)[0]])


def _program(bench: Bench, found: Sequence[Readings]) -> LoadCases:
    return load_cases(read_out("sizes", bench.rig, bench.plan, bench.noise, None, found, GAUGES))


def unit_of(site: str) -> str:
    """What the size of a law at a site is: "torque", "mm" or "rad"."""
    kind = site.partition("@")[0]
    if kind == HINGE:
        return "torque"
    return "rad" if kind.startswith(("tilt", "base_r")) else "mm"


def reach_of(site: str, bench: Bench, true: ParallelogramRig) -> float:
    """Largest turn of a hinge, rad, or load through a series site, N or N·mm, in the tests of the bench.

    OutOfSight where there is as good as none.
    """
    unit = unit_of(site)
    law = Linear(1e-6) if unit == "torque" else Linear(RIGID[unit])
    found = true_readings(true, bench.plan, {}, GAUGES, [Placed(site, law)])
    every = [it.followed[0].coordinate if unit == "torque" else it.followed[0].force for it in found]
    largest = max(float(np.abs(one).max()) for one in every)
    if largest < IDLE[unit]:
        raise OutOfSight(f"nothing passes {site}")
    return largest


def placed_at(hidden: Hidden, site: str, reach: float, size: float) -> Placed:
    """The law at a site: a torque of that size over the reach of the turn, or a coordinate over that of the load."""
    law = hidden.law(site)
    if unit_of(site) == "torque":
        return Placed(site, law, force=size, length=reach)
    return Placed(site, law, force=reach, length=size)


def sized(
    make: Callable[[float], Placed], mu: float, scale: Scale, true: ParallelogramRig, unit: str
) -> tuple[Placed, list[Readings], Array]:
    """The law at the size where it shows by mu sigmas, the exact readings with it, and (N,) what it does to them.

    By the secant of the logarithms, within `WITHIN`. OutOfSight where no size does.
    """
    known: list[tuple[float, float]] = []
    size, most = FIRST[unit], LARGEST[unit]
    for _ in range(TRIES):
        law = make(size)
        try:
            found = true_readings(true, scale.bench.plan, {}, GAUGES, [law])
        except RuntimeError:
            most, size = size, size / 3.0
            continue
        signature = scale.signature(found)
        shown = float(np.linalg.norm(signature))
        if abs(shown / mu - 1.0) < WITHIN:
            return law, found, signature
        known.append((float(np.log(size)), float(np.log(max(shown, 1e-12) / mu))))
        size = _next(known, most)
    raise OutOfSight(f"no size of {law.site} shows by {mu:.3g} sigmas")


def _next(known: list[tuple[float, float]], most: float) -> float:
    """The next size, from pairs of log size and log of what is shown over what is wanted."""
    below = [it for it in known if it[1] < 0.0]
    above = [it for it in known if it[1] > 0.0]
    near = sorted(known, key=lambda it: abs(it[1]))[:2]
    slope = 1.0
    if len(near) == 2 and near[0][0] != near[1][0]:
        slope = float(np.clip((near[1][1] - near[0][1]) / (near[1][0] - near[0][0]), 0.3, 3.0))
    step = near[0][0] - near[0][1] / slope
    if below and above:
        low, high = max(it[0] for it in below), min(it[0] for it in above)
        if low < high and not low < step < high:
            step = 0.5 * (low + high)
    if step >= np.log(most):
        step = 0.5 * (near[0][0] + float(np.log(most)))
        if step - near[0][0] < 0.05:
            raise OutOfSight("no size that the bench bears shows by as much")
    return float(np.exp(step))
