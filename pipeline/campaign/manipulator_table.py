"""The rig of a campaign on a whole manipulator: a file that describes it, and what hangs on its platform."""

from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import field_validator, model_validator

from pipeline.campaign.model import Rig, Vector
from pipeline.manipulator.description import read as read_manipulator
from pipeline.toml.fields import Celsius, Number, Table, Text, Weight
from vjm.manipulator.posture import postures


class ManipulatorTable(Table):
    """The rig; file: path of a manipulator from the campaign's folder, or the name of a shipped one."""

    kind: Literal["manipulator"]
    file: Text
    gravity: tuple[Number, Number, Number] | None = None
    platform_weight_N: Weight = 0.0
    reference_temperature_C: Celsius | None = None

    @field_validator("file")
    @classmethod
    def decided(cls, value: str) -> str:
        if value == "?":
            raise ValueError(
                "not decided yet, allowed is the file of a manipulator or the name of a shipped one"
            )
        return value

    @field_validator("gravity")
    @classmethod
    def somewhere(cls, value: Vector | None) -> Vector | None:
        if value is not None and not 1e-6 <= max(map(abs, value)) <= 1e6:
            raise ValueError("allowed is a direction other than zero, such as [0, 0, -1]")
        return value

    @model_validator(mode="after")
    def directed(self) -> "ManipulatorTable":
        if self.platform_weight_N and self.gravity is None:
            raise ValueError("a weight is given without its direction, allowed with gravity = [x, y, z]")
        return self

    def rig(self, folder: Path | None) -> Rig:
        """The frozen object. InputError with every complaint about the file."""
        manipulator = read_manipulator(self.path(folder)).manipulator
        return Rig(
            "manipulator",
            manipulator.length,
            gravity=self.gravity,
            platform_weight=self.platform_weight_N,
            reference_temperature=self.reference_temperature_C,
            manipulator=manipulator,
            file=self.file,
        )

    def path(self, folder: Path | None) -> str:
        """What is to be read: a file beside the campaign goes before a shipped one."""
        beside = None if folder is None else folder / self.file
        if beside is not None and beside.is_file():
            return str(beside)
        return self.file.removesuffix(".toml")


def reached(rig: Rig, point: Vector) -> str:
    """Why the platform of the manipulator cannot stand at a point, mm; empty where it can."""
    assert rig.manipulator is not None
    at = postures(rig.manipulator, np.array(point))
    return str(at.reason)
