"""What a real bench has besides the physics: drawn, done to exact readings, and written down as somebody would.

None of it uses the models of noise and tolerances that the diagnosis has: each formula stands here again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from pipeline.assessment.challenge.benches import Bench
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.campaign import Campaign, Data, Noise, ParallelogramRig, Test, UniformBar
from pipeline.campaign.model import Role
from pipeline.campaign.tolerance import usual

Array = NDArray[np.float64]
OFF = 0.03
"""By which the bar may be off at most; standard deviation half of it."""
GAIN, GAIN_MOST = 0.005, 0.01
SHARES = (0.001, 0.004)
BAD_MOST, BAD_SIZES = 0.02, (15.0, 60.0)
CORRELATED = (0.4, 0.7)
CELL, DIALS = tuple(range(6, 12)), (0, 1, 2)


@dataclass(frozen=True, eq=False)
class Dirt:
    """bar: (4,) true over nominal EA, EIy, EIz, GJ. gains: (C,) of the sensors. shares: (C,) true share of the reading.
    bad: part of the readings that are knocked. declared: (C,) declared sigma over the true one. correlated: channel and
    correlation of its noise from row to row, or None. rounded: (C,) resolution of displays in true
    sigmas. tails: degrees of freedom of a Student t that the noise has instead of a normal distribution, or None."""

    bar: Array
    gains: Array
    shares: Array
    bad: float
    declared: Array
    correlated: tuple[int, float] | None
    rounded: Array
    tails: float | None = None

    @classmethod
    def of_bar(cls, bar: Array) -> Dirt:
        """A bar that is so far off, and nothing else."""
        one = np.ones(12 + len(GAUGES))
        return cls(bar, one, np.zeros_like(one), 0.0, one, None, np.zeros_like(one))

    @property
    def words(self) -> dict[str, float]:
        """Sizes by name, for the record."""
        return {
            "bar": float(np.abs(self.bar - 1.0).max()),
            "gain": float(np.abs(self.gains - 1.0).max()),
            "of_reading": float(self.shares.max()),
            "bad": self.bad,
            "declared": float(np.exp(np.abs(np.log(self.declared)).max())),
            "correlation": self.correlated[1] if self.correlated else 0.0,
            "rounding": float(self.rounded.max()),
        }


@dataclass(frozen=True)
class Knock:
    """One bad reading: test, row of it, channel, and by how many of its true sigmas it is off."""

    test: int
    row: int
    channel: int
    sigmas: float


def drawn_dirt(generator: np.random.Generator, channels: int) -> Dirt:
    """Of one bench: a bar that is always a little off, and some of the rest."""
    bar = 1.0 + np.clip(0.5 * OFF * generator.normal(size=4), -OFF, OFF)
    gains = np.ones(channels)
    if generator.random() < 0.5:
        some = [*CELL, *DIALS]
        gains[some] += np.clip(GAIN * generator.normal(size=len(some)), -GAIN_MOST, GAIN_MOST)
    shares = np.zeros(channels)
    if generator.random() < 0.5:
        shares[list(CELL)] = generator.uniform(*SHARES)
    bad = float(generator.uniform(0.0, BAD_MOST)) if generator.random() < 0.5 else 0.0
    declared = np.ones(channels)
    if generator.random() < 0.3:
        declared[list(CELL if generator.random() < 0.5 else DIALS)] = generator.choice((0.5, 2.0))
    correlated = None
    if generator.random() < 0.1:
        correlated = int(generator.choice([*CELL[:3], 12])), float(generator.uniform(*CORRELATED))
    rounded = np.zeros(channels)
    if generator.random() < 0.2:
        rounded[list(DIALS)] = generator.uniform(0.5, 2.0)
    return Dirt(bar, gains, shares, bad, declared, correlated, rounded)


def true_rig(rig: ParallelogramRig, bar: Array) -> ParallelogramRig:
    """The rig as it really is: each stiffness of its bars, EA, EIy, EIz, GJ (4,), so many times that of the drawing."""
    if rig.bar is not None:
        own = rig.bar
        true = UniformBar(EA=own.EA * bar[0], EIy=own.EIy * bar[1], EIz=own.EIz * bar[2], GJ=own.GJ * bar[3])
        return replace(rig, bar=true)
    assert rig.bar_stiffness is not None
    # Bending about z moves y and turns rz; about y it moves z and turns ry.
    root = np.sqrt(np.array([bar[0], bar[2], bar[1], bar[3], bar[1], bar[2]]))
    return replace(rig, bar_stiffness=root[:, None] * rig.bar_stiffness * root)


def read_dirty(
    name: str, bench: Bench, dirt: Dirt, found: Sequence[Readings], seed: int
) -> tuple[Campaign, tuple[Knock, ...]]:
    """The campaign that is written of exact readings, of the rig as drawn; and which readings were knocked."""
    generator = np.random.default_rng(seed)
    sigma = np.concatenate([bench.noise.displacement, bench.noise.wrench, bench.noise.gauges[: len(GAUGES)]])
    tests, knocks = [], []
    for number, (planned, it) in enumerate(zip(bench.plan, found, strict=True)):
        exact = np.hstack([it.displacement, it.wrench, it.gauges])
        scatter = np.hypot(sigma, dirt.shares * np.abs(exact))
        read = exact * dirt.gains + scatter * _noise(generator, exact.shape, dirt.correlated, dirt.tails)
        some = generator.random(read.shape) < dirt.bad / exact.shape[1]
        for row, channel in zip(*np.nonzero(some), strict=True):
            size = generator.uniform(*BAD_SIZES) * generator.choice((-1.0, 1.0))
            read[row, channel] += size * scatter[row, channel]
            knocks.append(Knock(number, int(row), int(channel), float(size)))
        steps = np.where(dirt.rounded > 0.0, dirt.rounded * sigma, 10.0 ** np.floor(np.log10(sigma / 20.0)))
        read = np.round(read / steps) * steps
        warm = planned.temperature + bench.noise.temperature * generator.normal(
            size=planned.temperature.shape
        )
        count = np.arange(len(read))
        data = Data(
            count, read[:, :6], read[:, 6:12], read[:, 12:], warm, np.zeros(len(read), dtype=np.int64)
        )
        role: Role = "holdout" if planned.holdout else "fit"
        tests.append(Test(planned.id, planned.q_deg, role, planned.control, "nominal", bench.rig, data))
    noise, known = _declared(bench.noise, sigma, dirt), usual(bench.rig.written)
    return Campaign(name, bench.rig, noise, GAUGES, tuple(tests), tolerance=known), tuple(knocks)


def _declared(noise: Noise, sigma: Array, dirt: Dirt) -> Noise:
    told = dirt.declared * sigma
    gains = np.where(dirt.gains != 1.0, GAIN, 0.0)
    return replace(
        noise,
        displacement=told[:6],
        wrench=told[6:12],
        gauges=told[12:],
        of_reading=dirt.declared * dirt.shares,
        gain=gains,
    )


def _noise(
    generator: np.random.Generator,
    shape: tuple[int, ...],
    correlated: tuple[int, float] | None,
    tails: float | None = None,
) -> Array:
    """Of unit variance; of one channel a first-order autoregression from row to row."""
    if tails is None:
        out = generator.normal(size=shape)
    else:
        out = generator.standard_t(tails, size=shape) / np.sqrt(tails / (tails - 2.0))
    if correlated is not None:
        channel, r = correlated
        for row in range(1, shape[0]):
            out[row, channel] = r * out[row - 1, channel] + np.sqrt(1.0 - r**2) * out[row, channel]
    return np.asarray(out)
