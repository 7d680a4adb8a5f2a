"""A rig that is a whole manipulator: a file that describes it, and what hangs on its platform."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import field_validator

from pipeline.campaign.gauge import Gauge, Vector
from pipeline.campaign.rig import Array, Mistakes, Rig, Solvable
from pipeline.campaign.rig_table import RigTable
from pipeline.manipulator.description import read as read_manipulator
from pipeline.toml.fields import Text
from vjm.effects.sized import Scale, scale_of
from vjm.manipulator.effects import linkages, view_of
from vjm.manipulator.machine import machine
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posed import Posed
from vjm.manipulator.posture import Postures, postures
from vjm.manipulator.standing import Standing, stacked
from vjm.parts import Actuator, Elastic, Leg


@dataclass(frozen=True, eq=False, kw_only=True)
class ManipulatorRig(Rig):
    """A manipulator and the file that describes it; its length is the characteristic one.

    at: where its unloaded platform stands in a test, mm; None: with its joints at home.
    """

    kind = "manipulator"
    acted_on = "parallelogram"
    axes = " of its file"

    manipulator: Manipulator
    file: str | None = None
    at: Vector | None = None

    @property
    def written(self) -> tuple[str, ...]:
        parts = [part for leg in self.manipulator.legs for part in leg.parts]
        there = {
            "bars": bool(linkages(self.manipulator)),
            "drives": any(isinstance(part, Actuator) and part.stiffness for part in parts),
            "links": any(isinstance(part, Elastic) for part in parts),
        }
        return tuple(key for key, known in there.items() if known)

    @property
    def point(self) -> Vector | None:
        return self.at

    @cached_property
    def posture(self) -> Postures:
        """Where its joints stand: at the point of the test, or at home."""
        if self.at is not None:
            return postures(self.manipulator, np.array(self.at, dtype=float))
        pose = machine(self.manipulator).unloaded_pose
        home = tuple(leg.home for leg in self.manipulator.legs)
        return Postures(pose, home, np.array(True), np.array("", dtype=object))

    @property
    def legs(self) -> tuple[tuple[Leg, Array], ...]:
        return tuple(zip(self.manipulator.legs, self.posture.coordinates, strict=True))

    @cached_property
    def scale(self) -> Scale:
        """By its first parallelogram; without one it has no measure."""
        if not linkages(self.manipulator):
            return Scale()
        first = view_of(self.manipulator).links[0]
        return scale_of(first.length, first.stiffness)

    def mechanism(self, gauges: tuple[Gauge, ...]) -> Posed:
        down = self.manipulator.gravity if self.down is None else self.down
        return Posed(replace(self.manipulator, sensors=self.sensors, gravity=down), self.posture)

    def stands_as(self, other: Rig) -> bool:
        if not isinstance(other, ManipulatorRig) or self.manipulator is not other.manipulator:
            return False
        names = {it.name for it in fields(self)} - {"at", "manipulator"}
        return all(getattr(self, name) == getattr(other, name) for name in names)

    def mechanism_of(self, rigs: tuple[Rig, ...], gauges: tuple[Gauge, ...]) -> Standing:
        return Standing(self.mechanism(gauges).manipulator, _together(rigs))

    def alike_of(self, rigs: tuple[Rig, ...]) -> Hashable:
        return rigs

    def inputs_of(self, mechanism: Solvable, rigs: tuple[Rig, ...]) -> Mapping[str, Array]:
        assert isinstance(mechanism, Standing)
        return replace(mechanism, at=_together(rigs)).inputs

    def nominal_pose(self, q: Array) -> Array:
        pose = np.zeros((*np.shape(q), 6))
        pose[..., :3] = self.posture.pose[:3] if self.at is None else self.at
        return pose

    def refused(self, gauge: Gauge) -> tuple[str, str]:
        return ("", "is on a manipulator, whose campaigns have no gauges yet")

    def placed(self, q_deg: float | None, at_mm: Vector | None) -> tuple[ManipulatorRig, Mistakes]:
        mistakes = []
        if q_deg is not None:
            mistakes.append(("q_deg", "q_deg is given, a manipulator has at_mm instead"))
        if at_mm is None:
            # The table may have it as columns.
            return self, mistakes
        if why := self.unreached(at_mm):
            mistakes.append(("at_mm", f"at_mm is {list(at_mm)}: {why}"))
        return replace(self, at=at_mm), mistakes

    def unreached(self, point: Vector) -> str:
        """Why the platform cannot stand at a point, mm; empty where it can."""
        return str(postures(self.manipulator, np.array(point)).reason)

    def keys(self) -> dict[str, Any]:
        return {"file": self.file, **self.common_keys()}


@lru_cache(maxsize=64)
def _together(rigs: tuple[Rig, ...]) -> Postures:
    """(T,) where the joints of each stand; the same object each time."""
    return stacked([rig.posture for rig in rigs if isinstance(rig, ManipulatorRig)])


class _Unread(ManipulatorRig):
    """In the place of one whose file cannot be read: no point is out of its reach."""

    def unreached(self, point: Vector) -> str:
        return ""


class TABLE(RigTable):
    """A manipulator; file: its path from the campaign's folder, or the name of a shipped one."""

    template = """kind = "manipulator"         # a whole machine
file = "?"                   # that describes its legs, beside this one; or "orthoglide"
"""
    further = """# gravity = [0, 0, -1]           its direction, with platform_weight_N: what hangs on the platform
"""
    has_gauges = False
    posture_template = (
        "# at_mm = [x, y, z]          where the platform stands; or columns at_x_mm, at_y_mm, at_z_mm\n"
    )

    kind: Literal["manipulator"]
    """A whole machine."""
    file: Text
    """Manipulator file, beside campaign.toml, or the name of a shipped one such as orthoglide."""

    @field_validator("file")
    @classmethod
    def decided(cls, value: str) -> str:
        if value == "?":
            raise ValueError(
                "not decided yet, allowed is the file of a manipulator or the name of a shipped one"
            )
        return value

    def rig(self, folder: Path | None) -> ManipulatorRig:
        manipulator = read_manipulator(self.path(folder)).manipulator
        return ManipulatorRig(
            length=manipulator.length,
            manipulator=manipulator,
            file=self.file,
            gravity=self.gravity,
            platform_weight=self.platform_weight_N,
            reference_temperature=self.reference_temperature_C,
        )

    def path(self, folder: Path | None) -> str:
        """What is to be read: a file beside the campaign goes before a shipped one."""
        beside = None if folder is None else folder / self.file
        if beside is not None and beside.is_file():
            return str(beside)
        return self.file.removesuffix(".toml")

    @classmethod
    def stand_in(cls, raw: dict[str, Any]) -> ManipulatorRig:
        return _Unread(length=1.0, manipulator=read_manipulator("orthoglide").manipulator)

    @classmethod
    def merged(cls, base: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
        raise ValueError("is given, tests of a manipulator differ in at_mm only")
