"""A measurement campaign: the rig, the sensors' noise, further gauges, and the tests with what was measured.

Units N, mm, rad, temperatures in °C. Displacements are of the platform point (a bar's tip) from the nominal
unloaded pose, x y z rx ry rz; a wrench Fx Fy Fz Mx My Mz is what the load cell reads, exerted on the platform at
the platform point; both in the base frame. NaN: not measured, or not known.
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from fem.beam import uniform_stiffness
from pipeline.campaign.names import COORDINATES, DISPLACEMENT, FORCE, SUPPORT
from vjm.manipulator.parts import Manipulator
from vjm.mechanisms.bar import Base, Tip

Array = NDArray[np.float64]
Kind = Literal["parallelogram", "bar", "manipulator"]
Role = Literal["fit", "holdout"]
Zero = Literal["nominal", "first_row", "fitted"]
Vector = tuple[float, float, float]


@dataclass(frozen=True)
class UniformBar:
    """Rigidities of a uniform bar: EA in N, EIy, EIz and GJ in N·mm²."""

    EA: float
    EIy: float
    EIz: float
    GJ: float


@dataclass(frozen=True, eq=False)
class Rig:
    """What is on the bench: two bars of a parallelogram, or one bar, or a whole manipulator.

    Of a bar one of `bar_stiffness` and `bar` is given. length: mm between the hinges. width: mm between the bars; None
    for a bar. bar_stiffness: (6, 6) of one bar at its tip, base clamped, bar frame. base, tip: supports of a bar.
    gravity: direction in the base frame as it was given, of any length; None where no weight is known. line_weight:
    N/mm along each bar. platform_weight: N. reference_temperature: °C. fibre_y, fibre_z: mm from the bar's axis to its
    outermost fibres. manipulator, file: a manipulator and the file that describes it; its length is then the
    characteristic one. point: where its unloaded platform stands in a test, mm.
    """

    kind: Kind
    length: float
    width: float | None = None
    bar_stiffness: Array | None = None
    bar: UniformBar | None = None
    base: Base = "clamped"
    tip: Tip = "free"
    gravity: Vector | None = None
    line_weight: float = 0.0
    platform_weight: float = 0.0
    reference_temperature: float | None = None
    fibre_y: float | None = None
    fibre_z: float | None = None
    manipulator: Manipulator | None = None
    file: str | None = None
    point: Vector | None = None

    @cached_property
    def stiffness(self) -> Array:
        """(6, 6) of one bar at its tip, base clamped, bar frame; a uniform bar is slender (Euler-Bernoulli)."""
        if self.bar_stiffness is not None:
            return self.bar_stiffness
        if self.bar is None:
            raise ValueError("a rig needs bar_stiffness or bar, it has neither")
        b = self.bar
        return uniform_stiffness(self.length, b.EA, b.EIy, b.EIz, b.GJ)

    @property
    def down(self) -> Array | None:
        """(3,) unit vector of gravity, base frame; None where no weight is known."""
        return None if self.gravity is None else np.array(self.gravity) / np.linalg.norm(self.gravity)


@dataclass(frozen=True, eq=False)
class Noise:
    """One standard deviation of every sensor; NaN where the campaign does not say it.

    displacement: (6,) mm, rad. wrench: (6,) N, N·mm. gauges: (G,) mm. temperature: K.
    """

    displacement: Array
    wrench: Array
    gauges: Array
    temperature: float = np.nan


@dataclass(frozen=True)
class Gauge:
    """A displacement gauge on bar 1 or 2 at `station` (0 base, 1 tip), along a base-frame axis such as "y" or "-y".

    offset: of a gauge on the platform, its point from that of the platform in the nominal pose, mm, base frame; bar and
    station then mean nothing.
    """

    name: str
    station: float
    direction: str
    bar: int = 1
    offset: Vector | None = None

    @property
    def vector(self) -> Vector:
        """Unit vector of the direction, base frame."""
        sign, axis = (-1.0 if self.direction.startswith("-") else 1.0), self.direction[-1]
        return (sign * (axis == "x"), sign * (axis == "y"), sign * (axis == "z"))


@dataclass(frozen=True, eq=False)
class Data:
    """The settled load steps of one test, in the order in which they were done.

    steps: (N,) rising numbers. displacement: (N, 6). wrench: (N, 6). gauges: (N, G). temperature: (N,), or None
    where it was never measured. lines: (N,) lines of measurements.csv, the header being line 1; zeros where the
    data come from no file.
    """

    steps: NDArray[np.int64]
    displacement: Array
    wrench: Array
    gauges: Array
    temperature: Array | None
    lines: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Test:
    """One continuous history from the unloaded state, with hinge springs and friction relaxed there.

    q_deg: nominal angle of the bars, degrees as it was given. control: what is prescribed for each of the six
    coordinates: "displacement", "force", the name of a gauge, or "support" where the support of a bar's tip holds
    the coordinate at zero. rig: that of the campaign with the test's own values.
    """

    id: str
    q_deg: float
    role: Role
    control: tuple[str, ...]
    zero: Zero
    rig: Rig
    data: Data

    # Not a class of tests, whatever its name suggests to a collector.
    __test__ = False

    @property
    def q(self) -> float:
        """Nominal angle of the bars, rad."""
        return float(np.radians(self.q_deg))

    def inputs(self, gauges: tuple[Gauge, ...]) -> Array:
        """(N, 6) what is prescribed for each coordinate: mm, rad, N or N·mm; a force that has no reading is zero."""
        columns = {gauge.name: self.data.gauges[:, k] for k, gauge in enumerate(gauges)}
        values = np.zeros((self.data.steps.size, len(COORDINATES)))
        for k, by in enumerate(self.control):
            if by == DISPLACEMENT:
                values[:, k] = self.data.displacement[:, k]
            elif by == FORCE:
                values[:, k] = np.nan_to_num(self.data.wrench[:, k])
            elif by != SUPPORT:
                values[:, k] = columns[by]
        return values


@dataclass(frozen=True, eq=False)
class Campaign:
    """A measurement campaign.

    remarks: sentences on what was accepted but may deserve a look. digests: (name, SHA-256) of each file it was read
    from.
    """

    name: str
    rig: Rig
    noise: Noise
    gauges: tuple[Gauge, ...]
    tests: tuple[Test, ...]
    folder: Path | None = None
    remarks: tuple[str, ...] = ()
    digests: tuple[tuple[str, str], ...] = ()
