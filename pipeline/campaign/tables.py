"""The schema of campaign.toml: what each table may hold, in the units of the file."""

from __future__ import annotations

from math import hypot
from typing import Annotated, Any, Literal

from pydantic import Field, field_validator, model_validator

from pipeline.campaign.head import SensorNoise
from pipeline.campaign.model import Gauge, Role, Zero
from pipeline.toml.fields import Angle, Direction, Number, Place, Sigma, Table, Text, printable

Step = Annotated[int, Field(strict=True, ge=0)]


class Top(Table):
    """The whole file, its tables still as they were read."""

    schema_version: Annotated[int, Field(alias="schema", strict=True)]
    """Version of this format; it is 1."""
    name: Text
    """Name of the campaign, as results and reports call it."""
    rig: dict[str, Any]
    """What was measured: the kind of rig, its dimensions and stiffness. See the kinds below."""
    noise: dict[str, Any] = Field(default_factory=dict)
    """Noise of each sensor by column, such as x_mm = 0.001: one standard deviation in the column's unit, or a
    table. A sigma that is left out is estimated from the scatter, with a remark."""
    tolerance: dict[str, Any] | None = None
    """By how much what [rig] says may be off. Left out: the usual standard deviations, with a remark."""
    gauges: list[dict[str, Any]] = Field(default_factory=list)
    """Further displacement gauges, one table each."""
    file: dict[str, Any] = Field(default_factory=dict)
    """How the file of readings is laid out, where it is not a measurements.csv as above."""
    columns: dict[str, dict[str, Any]] = Field(default_factory=dict)
    """What each column of that file is, by the column's name in it."""
    cell: dict[str, Any] | None = None
    """Where the load cell reads, where that is not the platform point."""
    derived: dict[str, dict[str, Any]] = Field(default_factory=dict)
    """Coordinates that are computed from several columns, by the name of the coordinate: x, y, z, rx, ry or rz."""
    tests: Annotated[list[dict[str, Any]], Field(min_length=1)]
    """The tests, one table each, in the order in which they were done."""
    table_checked: Annotated[bool, Field(strict=True)] = False
    """Whether units, signs, zeros, order and columns were looked up and are right: then no mistake of the table is
    looked for, and what looks like one is a misfit of the model."""

    _name = field_validator("name")(printable)


class NoiseTable(Table):
    """Noise of one sensor that is more than a standard deviation."""

    sigma: Sigma | None = None
    """One standard deviation, in the unit of the column."""
    of_reading: Annotated[Number, Field(ge=0.0, le=0.1)] = 0.0
    """Further standard deviation as a share of the predicted reading; it adds in squares."""
    resolution: Sigma | None = None
    """Step of the display, in the unit of the column; rounding to it adds resolution²/12 to the variance."""
    gain: Annotated[Number, Field(ge=0.0, le=0.2)] = 0.0
    """One standard deviation of the sensor's gain from 1, the same in all readings of the campaign."""

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
    """Name of the gauge; its column is this name with _mm, its sigma in [noise] as well."""
    on: Literal["bar", "platform"] = "bar"
    """What the gauge touches."""
    bar: Annotated[int, Field(strict=True, ge=1, le=2)] | None = None
    """Of a gauge on a bar: 1 starts at z = -width/2, 2 at +width/2; a rig of one bar has 1."""
    station: Annotated[Number, Field(ge=0.0, le=1.0)] | None = None
    """Of a gauge on a bar: its place along the bar, 0 at the base and 1 at the tip."""
    offset_mm: tuple[Place, Place, Place] | None = None
    """Of a gauge on the platform: its point from the platform point, base frame, in the nominal pose."""
    direction: Direction
    """Base-frame direction along which the gauge reads more. It is zeroed in the unloaded state."""

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
    """Name of the test, as it stands in the column test of the readings."""
    q_deg: Angle | None = None
    """Angle of the bars of a parallelogram against the base frame, positive where the bars point from the base towards
    +x and -z; a single bar has 0."""
    at_mm: tuple[Place, Place, Place] | None = None
    """Where the unloaded platform of a manipulator stands, base frame; or columns at_x_mm, at_y_mm, at_z_mm."""
    role: Role
    """fit: models are fitted to it and chosen by it. holdout: it is only predicted, as a check."""
    control: dict[str, str]
    """What was prescribed for each of x, y, z, rx, ry and rz: "displacement" (moved or held, and read in every
    row), "force" (loaded or left free; an empty cell is no load), "held" (a clamp keeps it where it is unloaded, and no
    column reads it), or the name of a gauge whose reading the load was set by."""
    zero: Zero = "nominal"
    """nominal: readings count from the nominal unloaded pose. first_row: sensors and cell were zeroed in the
    first row, so that the noise of one reading is in all others: no constant is compared. fitted: their offsets are
    not known and are fitted."""
    set_aside: dict[str, list[Step]] = Field(default_factory=dict)
    """Readings that do not count: the steps by the column, as { fy_N = [3, 7] }. Where one was prescribed, nothing of
    its step is compared."""
    keep: dict[str, list[Step]] = Field(default_factory=dict)
    """Readings that count however far off they are: a diagnosis sets nothing of their step aside."""
    rig: dict[str, Any] = Field(default_factory=dict)
    """Values of [rig] that this test overrides. A length only where the bar is not given by its 6x6."""
    file: dict[str, Any] = Field(default_factory=dict)
    """Keys of [file] that replace those of the campaign for this test; path is needed."""
    columns: dict[str, dict[str, Any]] = Field(default_factory=dict)
    """Entries of [columns] that replace those of the campaign for this test."""

    _id = field_validator("id")(printable)
