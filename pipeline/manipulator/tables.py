"""The schema of a manipulator file: what each table may hold, in the units of the file."""

from abc import ABC, abstractmethod
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, field_validator, model_validator

from fem.beam import uniform_stiffness
from pipeline.toml.fields import Angle, BarTable, Entry, Length, Number, Table, Text, printable
from pipeline.toml.stiffness import not_a_stiffness, symmetric
from vjm.manipulator.parts import Bars, Parallelogram
from vjm.parts import Actuator, Frame, Kind, Part, Passive, Virtual, elastic
from vjm.parts import Axis as JointAxis

Array = NDArray[np.float64]
Vector = tuple[Number, Number, Number]
Axis = Literal["x", "y", "z"]
Spring = Annotated[Number, Field(ge=1e-9, le=1e15)]
Give = Annotated[Number, Field(ge=0.0, le=1.0)]
Place = Annotated[Number, Field(ge=-1e6, le=1e6)]
Point = tuple[Place, Place, Place]
Segments = Annotated[int, Field(strict=True, ge=0, le=32)]
AXES: dict[Axis, tuple[float, float, float]] = {
    "x": (1.0, 0.0, 0.0),
    "y": (0.0, 1.0, 0.0),
    "z": (0.0, 0.0, 1.0),
}
_PARALLEL = 1e-6


class Top(Table):
    """The whole file, its tables still as they were read."""

    schema_version: Annotated[int, Field(alias="schema", strict=True)]
    """Version of this format; it is 1."""
    name: Text
    """Name of the machine."""
    length_mm: Length
    """Characteristic length of the machine, by which sizes are scaled."""
    home_mm: Point = (0.0, 0.0, 0.0)
    """Position of the platform point at home, base frame; inverse kinematics starts there."""
    gravity: Vector = (0.0, 0.0, -1.0)
    """Direction of gravity, base frame; its length has no meaning."""
    chains: dict[str, list[dict[str, Any]]]
    """Chains of parts by name: [[chains.NAME]] for each part, from base to platform."""
    legs: Annotated[list[dict[str, Any]], Field(min_length=1, max_length=100)]
    """The legs, one table each."""

    _name = field_validator("name")(printable)

    @field_validator("gravity")
    @classmethod
    def points(cls, value: tuple[float, float, float]) -> tuple[float, float, float]:
        if not any(value):
            raise ValueError("allowed is a direction")
        return value

    @property
    def down(self) -> Array:
        """(3,) unit vector of gravity, base frame."""
        return np.array(self.gravity) / np.linalg.norm(self.gravity)


class Placed(Table):
    """A frame by its origin and two of its axes; y is made normal to x."""

    x_axis: Vector = (1.0, 0.0, 0.0)
    """Direction of the frame's x axis, in the frame before it."""
    y_axis: Vector = (0.0, 1.0, 0.0)
    """Direction of its y axis; made normal to x."""

    @model_validator(mode="after")
    def spans(self) -> "Placed":
        x, y = np.array(self.x_axis), np.array(self.y_axis)
        if np.linalg.norm(np.cross(x, y)) <= _PARALLEL * np.linalg.norm(x) * np.linalg.norm(y) or not x.any():
            raise ValueError(
                "x_axis and y_axis are parallel or zero, allowed are two directions that span a plane"
            )
        return self

    @property
    def rotation(self) -> Array:
        """(3, 3): the frame's axes as columns."""
        x = np.array(self.x_axis) / np.linalg.norm(self.x_axis)
        z = np.cross(x, self.y_axis)
        z = z / np.linalg.norm(z)
        return np.column_stack([x, np.cross(z, x), z])


class LegTable(Placed):
    """One leg: its base frame, its chain, and its place on the platform; there its end has the axes of its base."""

    name: Text
    """Name of the leg, as effects and results call it."""
    chain: Text
    """Name of its chain."""
    at_mm: Point
    """Origin of the leg, base frame."""
    ends_at_mm: Point = (0.0, 0.0, 0.0)
    """Where the leg ends on the platform, from the platform point, base frame."""

    _name = field_validator("name")(printable)

    def begin(self) -> Frame:
        """From the base frame to the leg."""
        return Frame(np.array(self.at_mm), self.rotation)

    def end(self) -> Frame:
        """From the leg's end to the platform point."""
        back = self.rotation.T
        return Frame(-back @ np.array(self.ends_at_mm), back)


class PartTable(Table, ABC):
    """One part of a chain."""

    part: str
    """Kind of part."""

    @abstractmethod
    def made(self) -> Part:
        """The part, in mm and rad."""


class RigidTable(Placed):
    """A rigid link."""

    part: Literal["rigid"]
    """A rigid link."""
    to_mm: Point = (0.0, 0.0, 0.0)
    """Its end, in the frame at which it starts."""

    def made(self) -> Part:
        return Frame(np.array(self.to_mm), self.rotation)


class JointTable(PartTable):
    """What actuators, passive and virtual joints share; the keys with a unit must be those of the kind."""

    kind: Kind
    """A joint that slides along its axis, or turns about it."""
    axis: Axis
    """Axis of the joint, in the frame at which it stands."""
    home_mm: Place | None = None
    """Position of a sliding joint from which inverse kinematics starts."""
    home_deg: Angle | None = None
    """Angle of a turning joint from which inverse kinematics starts."""
    stiffness_N_per_mm: Spring | None = None
    """Stiffness of a sliding joint."""
    stiffness_Nmm_per_rad: Spring | None = None
    """Stiffness of a turning joint."""
    of: ClassVar[dict[str, set[str]]] = {
        "translation": {"home_mm", "stiffness_N_per_mm", "limits_mm"},
        "rotation": {"home_deg", "stiffness_Nmm_per_rad", "limits_deg"},
    }

    @model_validator(mode="after")
    def units(self) -> "JointTable":
        other = self.of["rotation" if self.kind == "translation" else "translation"]
        given = sorted(key for key in other & self.model_fields_set if getattr(self, key) is not None)
        if given:
            own = ", ".join(sorted(self.of[self.kind] & set(type(self).model_fields)))
            raise ValueError(f"{given[0]} is given for a {self.kind}, allowed are {own}")
        return self

    @property
    def home(self) -> float:
        """mm or rad."""
        return (
            (self.home_mm or 0.0) if self.kind == "translation" else float(np.radians(self.home_deg or 0.0))
        )

    @property
    def stiffness(self) -> float | None:
        """N/mm or N·mm/rad."""
        return self.stiffness_N_per_mm if self.kind == "translation" else self.stiffness_Nmm_per_rad


class ActuatorTable(JointTable):
    """An actuated joint; without a stiffness it is rigid."""

    part: Literal["actuator"]
    """An actuated joint; without a stiffness it is rigid."""
    limits_mm: tuple[Place, Place] | None = None
    """Lowest and highest position of a sliding joint."""
    limits_deg: tuple[Number, Number] | None = None
    """Lowest and highest angle of a turning joint."""

    @model_validator(mode="after")
    def ordered(self) -> "ActuatorTable":
        for name in ("limits_mm", "limits_deg"):
            pair = getattr(self, name)
            if pair is not None and not pair[0] < pair[1]:
                raise ValueError(f"{name} is {list(pair)}, allowed is a lower and then a higher limit")
        return self

    def made(self) -> Part:
        limits = self.limits_mm
        if self.kind == "rotation" and self.limits_deg is not None:
            limits = (float(np.radians(self.limits_deg[0])), float(np.radians(self.limits_deg[1])))
        bounds = limits or (-np.inf, np.inf)
        return Actuator(self.kind, AXES[self.axis], self.stiffness, self.home, bounds)


class PassiveTable(JointTable):
    """A perfect passive joint."""

    part: Literal["passive"]
    """A perfect joint that nothing drives; it has no stiffness."""

    @model_validator(mode="after")
    def perfect(self) -> "PassiveTable":
        if self.stiffness is not None:
            raise ValueError('a stiffness is given, allowed with part = "virtual"')
        return self

    def made(self) -> Part:
        return Passive((JointAxis(self.kind, AXES[self.axis], home=self.home),))


class VirtualTable(JointTable):
    """A spring."""

    part: Literal["virtual"]
    """A spring; it needs its stiffness and has no home."""

    @model_validator(mode="after")
    def sprung(self) -> "VirtualTable":
        if self.stiffness is None:
            raise ValueError("its stiffness is missing")
        if self.home:
            raise ValueError("a home is given, a spring rests at zero")
        return self

    def made(self) -> Part:
        return Virtual(self.kind, AXES[self.axis], self.stiffness or 0.0)


class ElasticTable(PartTable):
    """What links and parallelograms share: a bar by its 6x6 or as a uniform beam."""

    length_mm: Length
    """Length along the x of the frame at which it starts."""
    stiffness: list[list[Entry]] | None = None
    """6x6 of the link, or of one bar, at its tip with the base clamped; N, mm, rad."""
    beam: BarTable | None = None
    """Instead of stiffness: rigidities of a uniform beam."""
    segments: Segments = 0
    """Segments with geometric stiffness; 0: one lumped spring at the tip."""

    @field_validator("stiffness")
    @classmethod
    def matrix(cls, value: list[list[float]] | None) -> list[list[float]] | None:
        if value is not None and (said := not_a_stiffness(value)):
            raise ValueError(said)
        return value

    @model_validator(mode="after")
    def one_of_two(self) -> "ElasticTable":
        if (self.stiffness is None) == (self.beam is None):
            found = "neither stiffness nor beam is" if self.beam is None else "both stiffness and beam are"
            raise ValueError(f"{found} given, allowed is one of the two")
        if self.beam is not None and (why := not_a_stiffness(self.bar().tolist())):
            raise ValueError(f"the 6x6 of beam at this length cannot be used: {why}")
        return self

    def bar(self) -> Array:
        """(6, 6) at the tip."""
        if self.stiffness is not None:
            return symmetric(self.stiffness)
        assert self.beam is not None
        b = self.beam
        return uniform_stiffness(self.length_mm, b.EA_N, b.EIy_Nmm2, b.EIz_Nmm2, b.GJ_Nmm2)


class LinkTable(ElasticTable):
    """An elastic link."""

    part: Literal["link"]
    """An elastic link."""

    def made(self) -> Part:
        return elastic(self.length_mm, self.bar(), self.segments)


class ParallelogramTable(ElasticTable):
    """A parallelogram of two equal bars; stiffness and beam are those of one of them."""

    part: Literal["parallelogram"]
    """Two equal bars between four hinges about y."""
    width_mm: Length
    """Distance of the two bars, along z."""
    radial_mm_per_N: Give = 0.0
    """Compliance of each hinge axis across itself."""
    tilt_rad_per_Nmm: Give = 0.0
    """Compliance of each hinge axis in tilt."""
    home_deg: Angle = 0.0
    """Angle of the bars from which inverse kinematics starts."""
    bars: Bars = "pair"
    """pair: two bars with hinges. equivalent: one pseudo-rigid bar with the same stiffness at rest."""
    fibre_y_mm: Length | None = None
    """From the axis of a bar to its outermost fibre in y; needed by material_yield."""
    fibre_z_mm: Length | None = None
    """The same in z."""

    @model_validator(mode="after")
    def segmented(self) -> "ParallelogramTable":
        if self.segments and self.bars == "equivalent":
            raise ValueError('segments is given, allowed with bars = "pair"')
        return self

    def made(self) -> Part:
        return Parallelogram(
            self.length_mm,
            self.width_mm,
            self.bar(),
            self.radial_mm_per_N,
            self.tilt_rad_per_Nmm,
            float(np.radians(self.home_deg)),
            self.bars,
            self.segments,
            self.fibre_y_mm,
            self.fibre_z_mm,
        )


PARTS: dict[str, type[PartTable] | type[RigidTable]] = {
    "rigid": RigidTable,
    "actuator": ActuatorTable,
    "passive": PassiveTable,
    "virtual": VirtualTable,
    "link": LinkTable,
    "parallelogram": ParallelogramTable,
}
"""Table of each kind of part."""
