"""What campaign.toml says, before the measurements are there."""

from dataclasses import dataclass

from pipeline.campaign.mapped.mapping import Source
from pipeline.campaign.model import Cells, Gauge, Rig, Role, Zero
from pipeline.campaign.rig import distinct


@dataclass(frozen=True)
class Head:
    """What campaign.toml says of one test; as in `Test`, and the line where it says so."""

    id: str
    q_deg: float
    role: Role
    control: tuple[str, ...]
    zero: Zero
    rig: Rig
    line: int | None
    set_aside: Cells = ()
    keep: Cells = ()


@dataclass(frozen=True)
class SensorNoise:
    """Of a sensor: standard deviation in its unit, share of the reading, standard deviation of its gain."""

    sigma: float
    of_reading: float = 0.0
    gain: float = 0.0


@dataclass(frozen=True)
class Description:
    """What campaign.toml says; `noise` is that of a column, `tolerance` one standard deviation a key, None where
    nothing is said.

    sources: of files that are read as they are declared; none where measurements.csv is as the contract has it.
    questions: about numbers of the rigs that are accepted and seldom right. table_checked: as of a campaign.
    """

    name: str
    rig: Rig
    noise: dict[str, SensorNoise]
    gauges: tuple[Gauge, ...]
    heads: tuple[Head, ...]
    sources: tuple[Source, ...] = ()
    tolerance: dict[str, float] | None = None
    questions: tuple[str, ...] = ()
    table_checked: bool = False

    @property
    def rigs(self) -> tuple[Rig, ...]:
        """Its rig, and those of tests that have their own."""
        return distinct(self.rig, *(head.rig for head in self.heads))


@dataclass(frozen=True)
class Draft:
    """A description, None where there is a complaint about it, and what its readings can be looked at by all the same:
    names of the gauges, and what is declared of the files."""

    description: Description | None
    gauges: tuple[str, ...]
    sources: tuple[Source, ...]
