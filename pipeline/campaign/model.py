"""A measurement campaign: the rig, the sensors' noise, further gauges, and the tests with what was measured.

Units N, mm, rad, temperatures in °C. Displacements are of the platform point (a bar's tip) from the nominal
unloaded pose, x y z rx ry rz; a wrench Fx Fy Fz Mx My Mz is what the load cell reads, exerted on the platform at
the platform point; both in the base frame. NaN: not measured, or not known.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.gauge import Gauge, Vector
from pipeline.campaign.names import COORDINATES, DISPLACEMENT, FORCE, SUPPORT
from pipeline.campaign.noise import Noise
from pipeline.campaign.rig import Array, Rig, distinct
from pipeline.campaign.tolerance import widest

Role = Literal["fit", "holdout"]
Zero = Literal["nominal", "first_row", "fitted"]
Cells = tuple[tuple[int, str], ...]

__all__ = ["Array", "Campaign", "Cells", "Data", "Gauge", "Noise", "Rig", "Role", "Test", "Vector", "Zero"]


@dataclass(frozen=True, eq=False)
class Data:
    """The settled load steps of one test, in the order in which they were done.

    steps: (N,) rising numbers. displacement: (N, 6). wrench: (N, 6). gauges: (N, G). temperature: (N,), or None
    where it was never measured. lines: (N,) lines of measurements.csv, the header being line 1; zeros where the
    data come from no file. from_first: columns that are less their first reading.
    """

    steps: NDArray[np.int64]
    displacement: Array
    wrench: Array
    gauges: Array
    temperature: Array | None
    lines: NDArray[np.int64]
    from_first: frozenset[str] = frozenset()

    @property
    def readings(self) -> Array:
        """(N, 12 + G) of all channels."""
        return np.hstack([self.displacement, self.wrench, self.gauges])


@dataclass(frozen=True, eq=False)
class Test:
    """One continuous history from the unloaded state, with hinge springs and friction relaxed there.

    q_deg: nominal angle of the bars, degrees as it was given. control: what is prescribed for each of the six
    coordinates: "displacement", "force", the name of a gauge, or "held" where a clamp or the support of a bar's tip
    keeps the coordinate where it is unloaded. rig: that of the campaign with the test's own values. set_aside, keep:
    step and column of readings that somebody left out, and of those that are to count whatever they look like. run:
    tests with a smaller one were done before it; None where only its place among them tells.
    """

    id: str
    q_deg: float
    role: Role
    control: tuple[str, ...]
    zero: Zero
    rig: Rig
    data: Data
    set_aside: Cells = ()
    keep: Cells = ()
    run: int | None = None

    # Not a class of tests, whatever its name suggests to a collector.
    __test__ = False

    @property
    def q(self) -> float:
        """Nominal angle of the bars, rad."""
        return float(np.radians(self.q_deg))

    def inputs(self, gauges: tuple[Gauge, ...]) -> Array:
        """(N, 6) what is prescribed for each coordinate: mm, rad, N or N·mm; a force that has no reading is zero.

        Not to be written to.
        """
        return _inputs(self, gauges)


# The look for mistakes of a table asks for those of the same tests thousands of times.
@lru_cache(maxsize=1024)
def _inputs(test: Test, gauges: tuple[Gauge, ...]) -> Array:
    columns = {gauge.name: test.data.gauges[:, k] for k, gauge in enumerate(gauges)}
    values = np.zeros((test.data.steps.size, len(COORDINATES)))
    for k, by in enumerate(test.control):
        if by == DISPLACEMENT:
            values[:, k] = test.data.displacement[:, k]
        elif by == FORCE:
            values[:, k] = np.nan_to_num(test.data.wrench[:, k])
        elif by != SUPPORT:
            values[:, k] = columns[by]
    values.flags.writeable = False
    return values


@dataclass(frozen=True, eq=False)
class Campaign:
    """A measurement campaign.

    remarks: sentences on what was accepted but may deserve a look. digests: (name, SHA-256) of each file it was read
    from. tolerance: standard deviations of what is written about the rig, by key (`vjm.tolerances`); what has none is
    exact. table_checked: whether its table was looked up, so that no mistake of it is looked for.
    """

    name: str
    rig: Rig
    noise: Noise
    gauges: tuple[Gauge, ...]
    tests: tuple[Test, ...]
    folder: Path | None = None
    remarks: tuple[str, ...] = ()
    digests: tuple[tuple[str, str], ...] = ()
    tolerance: Mapping[str, float] = field(default_factory=dict)
    table_checked: bool = False

    @property
    def rigs(self) -> tuple[Rig, ...]:
        """Its rig, and those of tests that have their own."""
        return distinct(self.rig, *(test.rig for test in self.tests))

    @property
    def files(self) -> tuple[Path, ...]:
        """That these name, beside its own."""
        return tuple(dict.fromkeys(path for rig in self.rigs for path in rig.files))

    @property
    def computed_bands(self) -> dict[str, float]:
        """As of a rig, the widest of those of its bars."""
        return widest(rig.computed_bands for rig in self.rigs)

    @property
    def vouched(self) -> bool:
        """Whether somebody vouches for all that is written, sensors too: numbers exact, sigmas and nothing else."""
        plain = not np.any(self.noise.shares) and not np.any(self.noise.gains)
        return plain and not any(self.tolerance.values())
