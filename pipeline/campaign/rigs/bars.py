"""What a rig of one bar and a parallelogram have in common: bars of one K_b."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from pydantic import field_validator, model_validator

from fem.beam import uniform_stiffness
from fem.torsion import torsion_constant
from pipeline.campaign.bar_from import BarFrom, bar_from
from pipeline.campaign.gauge import Gauge, Vector
from pipeline.campaign.rig import Array, Mistakes, Rig
from pipeline.campaign.rig_table import RigTable
from pipeline.errors import InputError
from pipeline.toml.fields import BarTable, Entry, Length, Weight
from pipeline.toml.stiffness import not_a_stiffness, symmetric
from pipeline.validation.case_tables import Material, SectionSize
from pipeline.validation.geometry import section_of
from pipeline.validation.material_questions import material_questions
from vjm.effects.sized import Scale, scale_of
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.bar import Bar, Base, Tip
from vjm.mechanisms.parallelogram import Parallelogram

Mechanism = TypeVar("Mechanism", Bar, Parallelogram)
Own = TypeVar("Own", bound="RigOfBars")
SAME_LENGTH = 1e-6
"""Relative: two lengths of one bar differ by how many digits were written."""


@dataclass(frozen=True)
class UniformBar:
    """Rigidities of a uniform bar: EA in N, EIy, EIz and GJ in N·mm²."""

    EA: float
    EIy: float
    EIz: float
    GJ: float


@dataclass(frozen=True, eq=False, kw_only=True)
class RigOfBars(Rig):
    """Bars of one stiffness; one of `bar_stiffness` and `bar` is given.

    bar_stiffness: (6, 6) of one bar at its tip, base clamped, bar frame. fibre_y, fibre_z: mm from the bar's axis to
    its outermost fibres. computed: the result that bar_stiffness comes from, with K_g and bands.
    """

    bar_stiffness: Array | None = None
    bar: UniformBar | None = None
    fibre_y: float | None = None
    fibre_z: float | None = None
    computed: BarFrom | None = None

    @property
    def usual_tolerance(self) -> dict[str, float]:
        usual = super().usual_tolerance
        return usual if self.computed is None else self.computed.tolerance(usual)

    @property
    def computed_bands(self) -> dict[str, float]:
        return {} if self.computed is None else self.computed.bands

    @property
    def files(self) -> tuple[Path, ...]:
        return () if self.computed is None else (self.computed.path,)

    @property
    def named(self) -> dict[str, Any]:
        if self.computed is None:
            return {}
        if not np.array_equal(self.stiffness, self.computed.stiffness):
            raise ValueError(
                f"its 6x6 is not that of {self.computed.name}: no file can say that and keep K_g"
            )
        return {"bar_stiffness": None, "bar_from": self.computed.name}

    def of_the_bars(self: Own, other: Rig) -> Own:
        return replace(self, computed=other.computed) if isinstance(other, RigOfBars) else self

    @property
    def tolerance_said(self) -> str:
        return "" if self.computed is None else self.computed.said

    @cached_property
    def stiffness(self) -> Array:
        """(6, 6) of one bar at its tip, base clamped, bar frame; a uniform bar is slender (Euler-Bernoulli)."""
        if self.bar_stiffness is not None:
            return self.bar_stiffness
        if self.bar is None:
            raise ValueError("a rig needs bar_stiffness or bar, it has neither")
        b = self.bar
        return uniform_stiffness(self.length, b.EA, b.EIy, b.EIz, b.GJ)

    def with_bars(self: Own, change: Callable[[Array], Array]) -> Own | None:
        if self.computed is not None:
            return None
        return replace(self, bar=None, bar_stiffness=change(self.stiffness))

    @property
    def written(self) -> tuple[str, ...]:
        return ("EA", "EIy", "EIz", "GJ", "ends", "length_mm")

    @property
    def ends(self) -> tuple[Base, Tip]:
        """Supports of a bar; those of a linkage are its hinges."""
        return "clamped", "free"

    @cached_property
    def scale(self) -> Scale:
        return scale_of(self.length, self.stiffness)

    @property
    def euler_load(self) -> float:
        rigidity = self.stiffness[1, 1] * self.length**3 / 12.0
        return float(self.bars * np.pi**2 * rigidity / self.length**2)

    def nominal_pose(self, q: Array) -> Array:
        pose = np.zeros((*np.shape(q), 6))
        pose[..., 0], pose[..., 2] = self.length * np.cos(q), -self.length * np.sin(q)
        return pose

    def placed(self: Own, q_deg: float | None, at_mm: Vector | None) -> tuple[Own, Mistakes]:
        if at_mm is None:
            return self, []
        return self, [("at_mm", 'at_mm is given, allowed only with kind = "manipulator"')]

    @property
    def overhang(self) -> float:
        """mm that a bar goes on beyond where it is loaded."""
        return 0.0

    def seen(self, gauge: Gauge) -> GaugeAt:
        """Where a gauge is, on a bar that ends where it is loaded."""
        return GaugeAt(gauge.bar, gauge.station, gauge.vector, gauge.offset)

    def equipped(self, plain: Mechanism, gauges: tuple[Gauge, ...]) -> Mechanism:
        """The mechanism with the weights, sensors, gauges and fibres of the rig."""
        places = tuple(self.seen(gauge) for gauge in gauges)
        it = replace(plain, sensors=self.sensors, gauge_at=places, fibre_y=self.fibre_y, fibre_z=self.fibre_z)
        if self.computed is not None:
            it = replace(it, polar_radius=self.computed.polar_radius)
        down = self.down
        return it if down is None else replace(it, gravity=down, line_load=self.line_weight * down)

    def bar_keys(self) -> dict[str, Any]:
        """The keys of its bars."""
        bar = self.bar
        return {
            "bar_stiffness": None if self.bar_stiffness is None else np.asarray(self.bar_stiffness).tolist(),
            "bar": None
            if bar is None
            else {"EA_N": bar.EA, "EIy_Nmm2": bar.EIy, "EIz_Nmm2": bar.EIz, "GJ_Nmm2": bar.GJ},
        }

    def fibre_keys(self) -> dict[str, Any]:
        """The keys of its outermost fibres."""
        return {"fibre_y_mm": self.fibre_y, "fibre_z_mm": self.fibre_z}


class TableOfBars(RigTable):
    """A rig of bars: one of bar, bar_stiffness, bar_from, and section with material."""

    further = """# section = { kind = "round", diameter_mm = 12.0 } and material = { E_MPa = 7e4, nu = 0.33 } for `bar`
# bar_stiffness = [[...], ...]   the 6x6 of one bar at its tip instead of `bar`; N, mm, rad
# bar_from = "bar.json"          or a result of the commands bar or run, in this folder: K_b, K_g and their bands
# gravity = [0, 0, -1]           direction of gravity; with line_weight_N_per_mm, platform_weight_N
# reference_temperature_C = 20.0 needed where a temperature was measured
# fibre_y_mm, fibre_z_mm         outermost fibres of the bar, for the effect material_yield
"""

    length_mm: Length
    """Length of a bar, between its hinge axes where it has any."""
    bar_stiffness: list[list[Entry]] | None = None
    """6x6 stiffness of one bar at its tip with the base clamped, bar frame; x y z rx ry rz to Fx Fy Fz Mx My Mz;
    N, mm, rad."""
    bar_from: str | None = None
    """Result of the command `bar` or of `run`, from the folder of the campaign: K_b, K_g and both bands."""
    bar: BarTable | None = None
    """Rigidities of a uniform slender bar."""
    section: SectionSize | None = None
    """Section of a uniform bar, with material."""
    material: Material | None = None
    """Material of that section."""
    line_weight_N_per_mm: Weight = 0.0
    """Known weight of each bar along its length, with gravity."""
    fibre_y_mm: Length | None = None
    """From the bar's axis to its outermost fibre in y; needed by material_yield. A section has its own."""
    fibre_z_mm: Length | None = None
    """The same in z."""

    @field_validator("bar_stiffness")
    @classmethod
    def usable(cls, value: list[list[float]] | None) -> list[list[float]] | None:
        if value is not None and (said := not_a_stiffness(value)):
            raise ValueError(said)
        return value

    @model_validator(mode="after")
    def stiff(self) -> TableOfBars:
        unread = self.bar_stiffness is None and self.bar_from is None
        if unread and (why := not_a_stiffness(self.bars().stiffness.tolist())):
            raise ValueError(f"the 6x6 of bar at this length cannot be used: {why}")
        return self

    def contradictions(self) -> list[str]:
        said = []
        ways = ("bar_stiffness", "bar_from", "bar", "section")
        given = [name for name in ways if getattr(self, name) is not None]
        if len(given) != 1:
            what = " and ".join(given) + " are" if given else f"none of {', '.join(ways[:-1])} and section is"
            said.append(f"{what} given, allowed is one of them")
        if (self.section is None) != (self.material is None):
            there, missing = ("material", "section") if self.section is None else ("section", "material")
            said.append(f"{there} is given without {missing}, allowed are both together")
        return [*said, *super().contradictions()]

    def questions(self) -> Iterator[str]:
        if self.material is not None:
            yield from (f"material.{said}" for said in material_questions(self.material))

    @property
    def weight(self) -> float:
        return self.line_weight_N_per_mm + self.platform_weight_N

    @abstractmethod
    def bars(self) -> RigOfBars:
        """The frozen object; bars name no file."""

    def rig(self, folder: Path | None) -> RigOfBars:
        if self.bar_from is None:
            return self.bars()
        found = bar_from((folder or Path()) / self.bar_from)
        if abs(found.length - self.length_mm) > SAME_LENGTH * self.length_mm:
            raise InputError(
                f"{found.name} is of a bar of {found.length:.9g} mm, but length_mm is {self.length_mm:.9g}; allowed is "
                "its own length"
            )
        own = self.model_copy(update={"bar_stiffness": found.stiffness.tolist(), "bar_from": None})
        return replace(own.bars(), computed=found)

    def made_of(self) -> dict[str, Any]:
        """What rigs of bars are made with, in the words of `RigOfBars`."""
        outermost: tuple[float | None, float | None] = (None, None)
        if self.section is not None:
            y, z = section_of(self.section).size
            outermost = (0.5 * y, 0.5 * z)
        return {
            "length": self.length_mm,
            "bar_stiffness": None if self.bar_stiffness is None else symmetric(self.bar_stiffness),
            "bar": self.uniform(),
            "gravity": self.gravity,
            "line_weight": self.line_weight_N_per_mm,
            "platform_weight": self.platform_weight_N,
            "reference_temperature": self.reference_temperature_C,
            "fibre_y": self.fibre_y_mm or outermost[0],
            "fibre_z": self.fibre_z_mm or outermost[1],
        }

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

    @classmethod
    def merged(cls, base: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
        raw = dict(base)
        if {"bar", "bar_stiffness", "bar_from", "section"} & set(own):
            for key in (
                "bar",
                "bar_stiffness",
                "bar_from",
                "section",
                *(() if "section" in own else ("material",)),
            ):
                raw.pop(key, None)
        raw |= own
        stretched = own.get("length_mm", base.get("length_mm")) != base.get("length_mm")
        fixed = {"bar_stiffness", "bar_from"}
        if stretched and fixed & set(raw) and not fixed & set(own):
            raise ValueError(
                "length_mm is overridden, allowed only where the bar is given by bar: a 6x6 has its length"
            )
        return raw
