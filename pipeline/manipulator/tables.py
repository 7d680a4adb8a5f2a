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
    name: Text
    length_mm: Length
    home_mm: Point = (0.0, 0.0, 0.0)
    gravity: Vector = (0.0, 0.0, -1.0)
    chains: dict[str, list[dict[str, Any]]]
    legs: Annotated[list[dict[str, Any]], Field(min_length=1, max_length=100)]

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
    y_axis: Vector = (0.0, 1.0, 0.0)

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
    chain: Text
    at_mm: Point
    ends_at_mm: Point = (0.0, 0.0, 0.0)

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

    @abstractmethod
    def made(self) -> Part:
        """The part, in mm and rad."""


class RigidTable(Placed):
    """A rigid link."""

    part: Literal["rigid"]
    to_mm: Point = (0.0, 0.0, 0.0)

    def made(self) -> Part:
        return Frame(np.array(self.to_mm), self.rotation)


class JointTable(PartTable):
    """What actuators, passive and virtual joints share; the keys with a unit must be those of the kind."""

    kind: Kind
    axis: Axis
    home_mm: Place | None = None
    home_deg: Angle | None = None
    stiffness_N_per_mm: Spring | None = None
    stiffness_Nmm_per_rad: Spring | None = None
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
    limits_mm: tuple[Place, Place] | None = None
    limits_deg: tuple[Number, Number] | None = None

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
    stiffness: list[list[Entry]] | None = None
    beam: BarTable | None = None
    segments: Segments = 0

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

    def made(self) -> Part:
        return elastic(self.length_mm, self.bar(), self.segments)


class ParallelogramTable(ElasticTable):
    """A parallelogram of two equal bars; stiffness and beam are those of one of them."""

    part: Literal["parallelogram"]
    width_mm: Length
    radial_mm_per_N: Give = 0.0
    tilt_rad_per_Nmm: Give = 0.0
    home_deg: Angle = 0.0
    bars: Bars = "pair"
    fibre_y_mm: Length | None = None
    fibre_z_mm: Length | None = None

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
