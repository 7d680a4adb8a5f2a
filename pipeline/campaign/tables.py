"""The schema of campaign.toml: what each table may hold, in the units of the file."""

from __future__ import annotations

from math import hypot
from typing import Annotated, Any, Literal

from pydantic import Field, field_validator, model_validator

from pipeline.campaign.head import SensorNoise
from pipeline.campaign.model import Gauge, Role, Zero
from pipeline.toml.fields import (
    Angle,
    Direction,
    Number,
    Place,
    Sigma,
    Table,
    Text,
    printable,
)


class Top(Table):
    """The whole file, its tables still as they were read."""

    schema_version: Annotated[int, Field(alias="schema", strict=True)]
    name: Text
    rig: dict[str, Any]
    noise: dict[str, Any] = Field(default_factory=dict)
    tolerance: dict[str, Any] | None = None
    gauges: list[dict[str, Any]] = Field(default_factory=list)
    file: dict[str, Any] = Field(default_factory=dict)
    columns: dict[str, dict[str, Any]] = Field(default_factory=dict)
    cell: dict[str, Any] | None = None
    derived: dict[str, dict[str, Any]] = Field(default_factory=dict)
    tests: Annotated[list[dict[str, Any]], Field(min_length=1)]

    _name = field_validator("name")(printable)


class NoiseTable(Table):
    """Noise of one sensor that is more than a standard deviation."""

    sigma: Sigma | None = None
    of_reading: Annotated[Number, Field(ge=0.0, le=0.1)] = 0.0
    resolution: Sigma | None = None
    gain: Annotated[Number, Field(ge=0.0, le=0.2)] = 0.0

    @model_validator(mode="after")
    def known(self) -> NoiseTable:
        """A reading of zero has noise too."""
        if self.sigma is None and self.resolution is None:
            raise ValueError("sigma is missing, allowed is one standard deviation, or a resolution")
        return self

    @property
    def noise(self) -> SensorNoise:
        """Rounding to a resolution r scatters by r / sqrt(12) (a uniform law)."""
        rounding = (self.resolution or 0.0) / 12.0**0.5
        return SensorNoise(float(hypot(self.sigma or 0.0, rounding)), self.of_reading, self.gain)


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
