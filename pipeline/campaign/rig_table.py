"""The table of a rig in campaign.toml: what every kind of rig has in it."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from pathlib import Path
from typing import Any, ClassVar

from pydantic import field_validator, model_validator

from pipeline.campaign.gauge import Vector
from pipeline.campaign.rig import Rig
from pipeline.toml.fields import Celsius, Number, Table, Weight


class RigTable(Table):
    """A rig, each key on its own. A kind's own table names it: `kind: Literal["..."]`."""

    template: ClassVar[str]
    """The table for `init`, with a question mark where only its owner knows."""
    further: ClassVar[str]
    """Lines of keys that may be there, explained behind #."""
    has_gauges: ClassVar[bool] = True
    posture_template: ClassVar[str] = ""
    """The line of a test that says its posture."""
    posture_key: ClassVar[str] = ""
    """The same without its explanation, where each test has to say it."""
    held: ClassVar[tuple[str, ...]] = ()
    """Coordinates that a test usually holds."""

    gravity: tuple[Number, Number, Number] | None = None
    """Direction of gravity, base frame; its length has no meaning. Needed by a weight."""
    platform_weight_N: Weight = 0.0
    """Known weight that hangs on the platform at its point."""
    reference_temperature_C: Celsius | None = None
    """Temperature at which the dimensions hold; needed where temperature_C was measured."""

    @field_validator("gravity")
    @classmethod
    def somewhere(cls, value: Vector | None) -> Vector | None:
        if value is not None and not 1e-6 <= max(map(abs, value)) <= 1e6:
            raise ValueError("allowed is a direction other than zero, such as [0, 0, -1]")
        return value

    @model_validator(mode="after")
    def consistent(self) -> RigTable:
        if said := self.contradictions():
            raise ValueError("; ".join(said))
        return self

    def contradictions(self) -> list[str]:
        """What does not go together."""
        if self.gravity is None and self.weight > 0.0:
            return ["a weight is given without its direction, allowed with gravity = [x, y, z]"]
        return []

    def questions(self) -> Iterator[str]:
        """What to ask about numbers that are accepted and seldom right, behind the name of the table."""
        yield from ()

    @property
    def weight(self) -> float:
        """Positive where any weight is given."""
        return self.platform_weight_N

    @abstractmethod
    def rig(self, folder: Path | None) -> Rig:
        """The frozen object. folder: of files that it names. InputError with every complaint about such a file."""

    @classmethod
    @abstractmethod
    def stand_in(cls, raw: dict[str, Any]) -> Rig:
        """A rig to judge the control of a test by, where the table has mistakes of its own."""

    @classmethod
    @abstractmethod
    def merged(cls, base: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
        """The table of a test: that of the campaign with the test's own values. ValueError where they cannot be had."""
