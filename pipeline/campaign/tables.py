"""The schema of campaign.toml: what each table may hold, in the units of the file."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, field_validator, model_validator

from fem.torsion import torsion_constant
from pipeline.campaign.model import Gauge, Kind, Rig, Role, UniformBar, Zero
from pipeline.toml.fields import (
    Angle,
    BarTable,
    Celsius,
    Direction,
    Entry,
    Length,
    Number,
    Place,
    Table,
    Text,
    Weight,
    printable,
)
from pipeline.toml.stiffness import not_a_stiffness, symmetric
from pipeline.validation.case_tables import Material, SectionSize
from pipeline.validation.geometry import section_of
from vjm.mechanisms.bar import Base, Tip


class Top(Table):
    """The whole file, its tables still as they were read."""

    schema_version: Annotated[int, Field(alias="schema", strict=True)]
    name: Text
    rig: dict[str, Any]
    noise: dict[str, Any] = Field(default_factory=dict)
    gauges: list[dict[str, Any]] = Field(default_factory=list)
    file: dict[str, Any] = Field(default_factory=dict)
    columns: dict[str, dict[str, Any]] = Field(default_factory=dict)
    cell: dict[str, Any] | None = None
    derived: dict[str, dict[str, Any]] = Field(default_factory=dict)
    tests: Annotated[list[dict[str, Any]], Field(min_length=1)]

    _name = field_validator("name")(printable)


class RigTable(Table):
    """The rig, each key on its own."""

    kind: Kind
    length_mm: Length
    width_mm: Length | None = None
    bar_stiffness: list[list[Entry]] | None = None
    bar: BarTable | None = None
    section: SectionSize | None = None
    material: Material | None = None
    base: Base | None = None
    tip: Tip | None = None
    gravity: tuple[Number, Number, Number] | None = None
    line_weight_N_per_mm: Weight = 0.0
    platform_weight_N: Weight = 0.0
    reference_temperature_C: Celsius | None = None
    fibre_y_mm: Length | None = None
    fibre_z_mm: Length | None = None

    @field_validator("bar_stiffness")
    @classmethod
    def stiffness(cls, value: list[list[float]] | None) -> list[list[float]] | None:
        if value is not None and (said := not_a_stiffness(value)):
            raise ValueError(said)
        return value

    @field_validator("gravity")
    @classmethod
    def somewhere(cls, value: tuple[float, float, float] | None) -> tuple[float, float, float] | None:
        if value is not None and not 1e-6 <= max(map(abs, value)) <= 1e6:
            raise ValueError("allowed is a direction other than zero, such as [0, 0, -1]")
        return value

    @model_validator(mode="after")
    def consistent(self) -> RigTable:
        if said := self.contradictions():
            raise ValueError("; ".join(said))
        if self.bar_stiffness is None and (why := not_a_stiffness(self.rig().stiffness.tolist())):
            raise ValueError(f"the 6x6 of bar at this length cannot be used: {why}")
        return self

    def contradictions(self) -> list[str]:
        """What does not go together."""
        said = []
        given = [name for name in ("bar_stiffness", "bar", "section") if getattr(self, name) is not None]
        if len(given) != 1:
            what = " and ".join(given) + " are" if given else "none of bar_stiffness, bar and section is"
            said.append(f"{what} given, allowed is one of the three")
        if (self.section is None) != (self.material is None):
            there, missing = ("material", "section") if self.section is None else ("section", "material")
            said.append(f"{there} is given without {missing}, allowed are both together")
        if self.kind == "parallelogram":
            if self.width_mm is None:
                said.append("width_mm is missing, a parallelogram needs it")
            loose = [key for key in ("base", "tip") if getattr(self, key) is not None]
            said += [f'{key} is given, allowed only with kind = "bar"' for key in loose]
        elif self.width_mm is not None:
            said.append('width_mm is given, allowed only with kind = "parallelogram"')
        if self.gravity is None and self.line_weight_N_per_mm + self.platform_weight_N > 0.0:
            said.append("a weight is given without its direction, allowed with gravity = [x, y, z]")
        return said

    def rig(self) -> Rig:
        """The frozen object."""
        outermost: tuple[float | None, float | None] = (None, None)
        if self.section is not None:
            y, z = section_of(self.section).size
            outermost = (0.5 * y, 0.5 * z)
        matrix = None if self.bar_stiffness is None else symmetric(self.bar_stiffness)
        return Rig(
            self.kind,
            self.length_mm,
            self.width_mm,
            matrix,
            self.uniform(),
            self.base or "clamped",
            self.tip or "free",
            self.gravity,
            self.line_weight_N_per_mm,
            self.platform_weight_N,
            self.reference_temperature_C,
            self.fibre_y_mm or outermost[0],
            self.fibre_z_mm or outermost[1],
        )

    def uniform(self) -> UniformBar | None:
        """The rigidities, as they were given or those of a section of a material."""
        if self.bar is not None:
            return UniformBar(*self.bar.model_dump().values())
        if self.section is None or self.material is None:
            return None
        section, modulus = section_of(self.section), self.material.E_MPa
        iy, iz = section.second_moments
        shear = 0.5 * modulus / (1.0 + self.material.nu)
        return UniformBar(
            modulus * section.area, modulus * iy, modulus * iz, shear * torsion_constant(section)
        )


class GaugeTable(Table):
    """One gauge, on a bar at a station or on the platform at an offset."""

    name: Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,39}$")]
    on: Literal["bar", "platform"] = "bar"
    bar: Annotated[int, Field(strict=True, ge=1, le=2)] | None = None
    station: Annotated[Number, Field(ge=0.0, le=1.0)] | None = None
    offset_mm: tuple[Place, Place, Place] | None = None
    direction: Direction

    @model_validator(mode="after")
    def placed(self) -> GaugeTable:
        """A gauge has the place of what it is on, and no other."""
        if self.on == "bar" and self.station is None:
            raise ValueError(
                'station is missing, a gauge on a bar needs it; on the platform write on = "platform"'
            )
        if self.on == "bar" and self.offset_mm is not None:
            raise ValueError('offset_mm is given, allowed only with on = "platform"')
        if self.on == "platform" and self.offset_mm is None:
            raise ValueError(
                "offset_mm is missing, a gauge on the platform needs it: [x, y, z] from its point"
            )
        if self.on == "platform" and (self.bar, self.station) != (None, None):
            raise ValueError("bar or station is given, a gauge on the platform has offset_mm instead")
        return self

    def gauge(self) -> Gauge:
        """The gauge that it describes."""
        return Gauge(self.name, self.station or 0.0, self.direction, self.bar or 1, self.offset_mm)


class TestTable(Table):
    """One test; whether its control can hold depends on the rig."""

    __test__ = False

    id: Text
    q_deg: Angle | None = None
    at_mm: tuple[Place, Place, Place] | None = None
    role: Role
    control: dict[str, str]
    zero: Zero = "nominal"
    rig: dict[str, Any] = Field(default_factory=dict)
    file: dict[str, Any] = Field(default_factory=dict)
    columns: dict[str, dict[str, Any]] = Field(default_factory=dict)

    _id = field_validator("id")(printable)
