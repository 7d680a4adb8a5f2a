"""What every rig has and answers; each kind is one file of `pipeline.campaign.rigs`.

Units N, mm, rad, temperatures in °C, base frame.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.gauge import Gauge, Vector
from pipeline.campaign.tolerance import usual
from pipeline.campaign.usual_tests import UsualTest
from vjm.effects.base import Rig as Bench
from vjm.effects.sized import Scale
from vjm.manipulator.posed import Posed
from vjm.manipulator.standing import Standing
from vjm.parts import Leg
from vjm.sensors import DeadWeight, Sensor, TrueMoment

Array = NDArray[np.float64]
LARGE_TURN = 1.0
"""rad. No parallelogram turns its platform so far; a slender bar's tip may, but degrees are more likely."""
Solvable = Bench | Posed | Standing
"""A mechanism that effects can change."""
Mistakes = list[tuple[str, str]]
"""Keys of a table, each with what is wrong with it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Rig(ABC):
    """What is on the bench, as it was described.

    length: mm, of a bar between its hinges, or characteristic. gravity: direction as it was given, of any length; None
    where no weight is known. platform_weight: N. line_weight: N/mm along each bar. reference_temperature: °C.
    """

    kind: ClassVar[str]
    """Its name in campaign.toml."""
    acted_on: ClassVar[str]
    """The kind among those that effects name: of a manipulator its parallelograms."""
    axes: ClassVar[str] = ": x along the unloaded bars at q = 0, y normal to the plane, z along the width"
    """Where the axes of the base frame lie, after the words "in the base frame"."""
    runaway: ClassVar[str] = ""
    """What is said of a rig with a swing that nothing holds."""
    largest_turn: ClassVar[float] = LARGE_TURN
    """rad, of the platform, up to which a reading is one and no mistake of the unit."""
    bars: ClassVar[int] = 0
    """Bars side by side that carry a load along x."""
    usual_angles: ClassVar[tuple[float, ...]] = ()
    """Degrees at which tests are usual, beside those of a campaign."""

    length: float
    gravity: Vector | None = None
    platform_weight: float = 0.0
    line_weight: float = 0.0
    reference_temperature: float | None = None

    @property
    def down(self) -> Array | None:
        """(3,) unit vector of gravity, base frame; None where no weight is known."""
        return None if self.gravity is None else np.array(self.gravity) / np.linalg.norm(self.gravity)

    @property
    def sensors(self) -> tuple[Sensor, ...]:
        """True moments, and the weight that hangs on the platform."""
        down = self.down
        if down is None or not self.platform_weight:
            return (TrueMoment(),)
        return (TrueMoment(), DeadWeight(self.platform_weight * down))

    @property
    def spread(self) -> float | None:
        """Width of the linkage, mm; None where it has none."""
        return None

    @property
    def written(self) -> tuple[str, ...]:
        """Keys of the tolerances (`vjm.tolerances`) of what its table says."""
        return ()

    @property
    def usual_tolerance(self) -> dict[str, float]:
        """Of what is written, the standard deviations that count where nothing is said."""
        return usual(self.written)

    @property
    def files(self) -> tuple[Path, ...]:
        """That its table names, beside the campaign's own."""
        return ()

    @property
    def named(self) -> dict[str, Any]:
        """Keys of its table that name these files in the place of the numbers which they hold."""
        return {}

    def of_the_bars(self, other: Rig) -> Rig:
        """This rig with what is known of the bars of another one beside its table; the bars are the same."""
        return self

    def with_bars(self, change: Callable[[Array], Array]) -> Rig | None:
        """This rig with another 6x6 of its bars; None for a rig of which nobody wrote it."""
        return None

    @property
    def tolerance_said(self) -> str:
        """Where these come from, if from more than usage; else empty."""
        return ""

    @property
    def computed_bands(self) -> dict[str, float]:
        """Of tolerances by key, the part (relative, one standard deviation) that meshes and models of a computation put
        in; empty where nothing was computed."""
        return {}

    @property
    def point(self) -> Vector | None:
        """Where the unloaded platform stands in a test, mm, where that is said by a point."""
        return None

    @property
    def legs(self) -> tuple[tuple[Leg, Array], ...]:
        """Each leg with its joint coordinates, unloaded; empty where length and width say what is to be drawn."""
        return ()

    @property
    def supports(self) -> dict[str, str]:
        """Coordinates of the platform that the rig itself holds at zero, each with what holds it."""
        return {}

    @property
    def drawn(self) -> Rig:
        """The rig without what its tests do to it: where they are loaded."""
        return self

    @property
    @abstractmethod
    def scale(self) -> Scale:
        """By what typical sizes of effects differ from those of the catalogue."""

    @property
    def euler_load(self) -> float:
        """N, a load along x that is large for the rig: its bars, guided sideways, buckle. NaN where there are none."""
        return float("nan")

    @abstractmethod
    def mechanism(self, gauges: tuple[Gauge, ...]) -> Solvable:
        """The plain mechanism: lumped springs (Eq. 1), known weights, sensors that read true moments."""

    def stands_as(self, other: Rig) -> bool:
        """Whether it differs from another rig by no more than where the unloaded platform stands: tests of both are
        solved together."""
        return self is other

    def mechanism_of(self, rigs: tuple[Rig, ...], gauges: tuple[Gauge, ...]) -> Solvable:
        """The plain mechanism of tests on rigs (T,) that stand as this one."""
        return self.mechanism(gauges)

    @property
    def alike(self) -> Hashable:
        """Equal where the mechanisms of rigs are."""
        return self

    def alike_of(self, rigs: tuple[Rig, ...]) -> Hashable:
        """The same of tests on rigs (T,) that stand as this one."""
        return self

    def inputs_of(self, mechanism: Solvable, rigs: tuple[Rig, ...]) -> Mapping[str, Array]:
        """(T,) of each input by which such a mechanism stands where the rig of a test does."""
        return {}

    @abstractmethod
    def nominal_pose(self, q: Array) -> Array:
        """(..., 6) unloaded platform as drawn at the angles q (...), rad."""

    def swing(self, q: float) -> Array | None:
        """(6,) motion of the platform that costs no energy at rest, 1 mm long; None if the rig has none."""
        return None

    def along(self, q: float) -> Array:
        """(3,) direction of the bars."""
        return np.array([1.0, 0.0, 0.0])

    def usual_tests(self, control: tuple[str, ...]) -> tuple[UsualTest, ...] | None:
        """Tests to choose the next one from, for a campaign with this control; None: no list has them."""
        return None

    def refused(self, gauge: Gauge) -> tuple[str, str] | None:
        """The key of a gauge that this rig cannot have, and why."""
        return None

    @abstractmethod
    def placed(self, q_deg: float | None, at_mm: Vector | None) -> tuple[Rig, Mistakes]:
        """The rig at the posture of a test, and what is wrong with what was written."""

    @abstractmethod
    def keys(self) -> dict[str, Any]:
        """Its table in campaign.toml, kind left out; None for what is not written."""

    def common_keys(self) -> dict[str, Any]:
        """What the tables of all rigs hold."""
        return {
            "gravity": None if self.gravity is None else list(self.gravity),
            "line_weight_N_per_mm": self.line_weight or None,
            "platform_weight_N": self.platform_weight or None,
            "reference_temperature_C": self.reference_temperature,
        }


def distinct(*rigs: Rig) -> tuple[Rig, ...]:
    """Each rig once, in the order given: tests without their own have the one of the campaign."""
    return tuple({id(rig): rig for rig in rigs}.values())
