"""What mechanisms of one bar or of two have in common: what acts on bars and hinges, how they stand and are read."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Self, get_args

import numpy as np

from vjm.bars import BarModel
from vjm.frames import Array
from vjm.laws import Law
from vjm.lumped import Lumped, SpringAt
from vjm.mechanisms.assembly import Alteration, GaugeAt
from vjm.mechanisms.sites import WithPlaces
from vjm.refined import SEGMENTS, Refined
from vjm.sensors import Sensor
from vjm.site_joint import SiteJoint


@dataclass(frozen=True, eq=False, kw_only=True)
class OfBars(WithPlaces):
    """A mechanism of bars that are drawn alike.

    spring_at: where along the bar its 6x6 stiffness is lumped. Eq. 1 says the tip. The unloaded stiffness does not
    depend on it, the critical loads do (`vjm.closed_forms`).
    bar: another model of the bars than the stiffness lumped at that place, such as `vjm.refined.Refined`.
    hinges: laws of the turn of each of the hinges, none in a perfect one. They are relaxed where the linkage
    stands without load (`vjm.mechanisms.assembled`): at the nominal angle, but for bars of different lengths.
    single_hinges: further laws of each hinge by itself, at base and tip of bar 1, then of bar 2; or none.
    alterations: what the bars are instead of what is drawn, applied in turn.
    mount: (3,) rotation vector, rad, of the whole linkage against the base frame. base_joints: between ground and base
    body, at the base origin along and about the axes of the base frame. line_load: (3,) N/mm along
    the bars, base frame. gravity: (3,) unit vector of weights given without a direction. sensors, gauge_at:
    what is read (`vjm.sensors`, `vjm.gauges`). fibre_y, fibre_z: outermost fibres of the bars, mm, where known.
    polar_radius: radius of gyration of the section by which an axial force stiffens the twist of refined bars, mm.
    """

    number_of_bars: ClassVar[int]
    spring_at: SpringAt = "tip"
    bar: BarModel | None = None
    hinges: tuple[Law, ...] = ()
    single_hinges: tuple[tuple[Law, ...], ...] = ()
    alterations: tuple[Alteration, ...] = ()
    mount: Array = field(default_factory=lambda: np.zeros(3))
    base_joints: tuple[SiteJoint, ...] = ()
    line_load: Array = field(default_factory=lambda: np.zeros(3))
    gravity: Array = field(default_factory=lambda: np.array([0.0, 0.0, -1.0]))
    sensors: tuple[Sensor, ...] = ()
    gauge_at: tuple[GaugeAt, ...] = ()
    fibre_y: float | None = None
    fibre_z: float | None = None
    polar_radius: float = 0.0

    def __post_init__(self) -> None:
        if self.spring_at not in get_args(SpringAt):
            raise ValueError(f"spring_at must be one of {get_args(SpringAt)}, got {self.spring_at!r}")
        if wrong := [place.bar for place in self.gauge_at if not 1 <= place.bar <= self.number_of_bars]:
            raise ValueError(f"bar must be 1{' or 2' if self.number_of_bars > 1 else ''}, got {wrong[0]}")

    @property
    def model(self) -> BarModel:
        """Of each bar."""
        return Lumped(self.spring_at, self.polar_radius) if self.bar is None else self.bar

    @property
    def hinge_laws(self) -> tuple[tuple[Law, ...], ...]:
        """Laws of each hinge: those of `single_hinges`, then those that all have; base and tip of each bar in turn."""
        own = self.single_hinges or ((),) * (2 * self.number_of_bars)
        return tuple((*laws, *self.hinges) for laws in own)

    def altered(self, *alterations: Alteration) -> Self:
        """The mechanism with further alterations of its bars."""
        return replace(self, alterations=(*self.alterations, *alterations))

    def refined(self, segments: int = SEGMENTS) -> Self:
        """The mechanism with its bars refined into segments."""
        return replace(self, bar=Refined(segments, self.polar_radius))
