"""A rig of one bar along x, its base clamped or pinned, its tip free, pinned or guided."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal, get_args

import numpy as np

from pipeline.campaign.gauge import Gauge, Vector
from pipeline.campaign.names import DISPLACEMENT, FORCE, SUPPORT
from pipeline.campaign.rig import Array, Mistakes
from pipeline.campaign.rigs.bars import RigOfBars, TableOfBars
from pipeline.campaign.usual_tests import UsualTest
from pipeline.toml.complaints import shown
from pipeline.toml.fields import Length, Number
from vjm.effects.sized import Scale, scale_of_bar
from vjm.link import Link
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.bar import HELD, Bar, Base, Tip
from vjm.sensors import ReadAt, Sensor

_D, _F = DISPLACEMENT, FORCE
FREE = (
    UsualTest("loaded along x", (_F,) * 6, 0),
    UsualTest("moved along y", (_F, _D, _F, _F, _F, _F), 1),
    UsualTest("moved along z", (_F, _F, _D, _F, _F, _F), 2),
    UsualTest("moved along y under compression", (_F, _D, _F, _F, _F, _F), 1, -0.3),
    UsualTest("moved along y under tension", (_F, _D, _F, _F, _F, _F), 1, 0.5),
    UsualTest("turned about x", (_F, _F, _F, _D, _F, _F), 3),
)


@dataclass(frozen=True, eq=False, kw_only=True)
class BarRig(RigOfBars):
    """One bar; base, tip: its supports. load_at: mm from the base to where the tests load it, None at its tip.

    A bar that is loaded before its tip is one that ends there, with a piece beyond it that carries nothing and so stays
    as it is: statics knows no other. Displacements are read at the tip all the same.
    """

    kind = acted_on = "bar"
    runaway = "the pinned bar is a mechanism"
    largest_turn = np.pi
    bars = 1

    base: Base = "clamped"
    tip: Tip = "free"
    load_at: float | None = None

    @property
    def overhang(self) -> float:
        return 0.0 if self.load_at is None else self.length - self.load_at

    @property
    def drawn(self) -> BarRig:
        return replace(self, load_at=None)

    @property
    def sensors(self) -> tuple[Sensor, ...]:
        beyond = (ReadAt(np.array([self.overhang, 0.0, 0.0])),) if self.overhang else ()
        return (*super().sensors, *beyond)

    @property
    def supports(self) -> dict[str, str]:
        return dict.fromkeys(HELD[self.tip], f"the {self.tip} tip")

    @cached_property
    def scale(self) -> Scale:
        return scale_of_bar(self.length, self.stiffness)

    @property
    def ends(self) -> tuple[Base, Tip]:
        return self.base, self.tip

    def mechanism(self, gauges: tuple[Gauge, ...]) -> Bar:
        whole = Link(self.length, self.stiffness)
        link = whole.lengthened(-self.overhang) if self.overhang else whole
        bar = Bar(link.length, link.stiffness, base=self.base, tip=self.tip, overhang=self.overhang)
        return self.equipped(bar, gauges)

    def seen(self, gauge: Gauge) -> GaugeAt:
        loaded = self.length - self.overhang
        if gauge.offset is not None:
            x, y, z = gauge.offset
            return GaugeAt(gauge.bar, gauge.station, gauge.vector, (x + self.overhang, y, z))
        along = gauge.station * self.length
        if along > loaded:
            return GaugeAt(gauge.bar, 1.0, gauge.vector, (along - loaded, 0.0, 0.0))
        return GaugeAt(gauge.bar, along / loaded, gauge.vector)

    def swing(self, q: float) -> Array | None:
        """A pinned base and a free tip: the bar turns about its base."""
        if self.base == "pinned" and self.tip == "free":
            return np.array([0.0, 0.0, -1.0, 0.0, 1.0 / self.length, 0.0])
        return None

    def usual_tests(self, control: tuple[str, ...]) -> tuple[UsualTest, ...]:
        if self.tip == "free":
            return FREE
        if set(control) - {_D, _F, SUPPORT}:
            # What drives a gauge is no usual test: how far it may go is not known from forces.
            return ()
        return (UsualTest("loaded along x", control, 0),)

    def refused(self, gauge: Gauge) -> tuple[str, str] | None:
        return ("bar", "bar is 2, a rig of one bar allows 1") if gauge.bar == 2 else None

    def placed(self, q_deg: float | None, at_mm: Vector | None) -> tuple[BarRig, Mistakes]:
        _, mistakes = super().placed(q_deg, at_mm)
        if q_deg:
            mistakes.append(("q_deg", f"q_deg is {shown(q_deg)}, a bar lies along x and allows 0"))
        return self, mistakes

    def keys(self) -> dict[str, Any]:
        supports = {"base": self.base, "tip": self.tip}
        return {
            "length_mm": self.length,
            **self.bar_keys(),
            **supports,
            "load_at_mm": self.load_at,
            **self.common_keys(),
            **self.fibre_keys(),
        }


class TABLE(TableOfBars):
    """One bar."""

    template = """kind = "bar"                 # one bar along x; or "parallelogram"
length_mm = "?"
bar = { EA_N = "?", EIy_Nmm2 = "?", EIz_Nmm2 = "?", GJ_Nmm2 = "?" }
base = "clamped"             # or "pinned"
tip = "free"                 # or "pinned", "guided"
# load_at_mm = 100.0           from the base to where it is loaded, if not at the tip; a test may have its own
"""

    kind: Literal["bar"]
    """One bar along x."""
    base: Base | None = None
    """Support of its base. Left out: clamped."""
    tip: Tip | None = None
    """Support of its tip. guided: it shifts and does not turn. pinned: a hinge about y on a block that slides along x.
    Left out: free."""
    load_at_mm: Length | tuple[Length, Number, Number] | None = None
    """Where a free bar is loaded: its distance from the base, or [x, y, z] in the base frame. Displacements are those
    of the tip, the wrench is that at this point; a test may have its own. Left out: at the tip."""

    def contradictions(self) -> list[str]:
        return [*super().contradictions(), *self._misplaced()]

    def _misplaced(self) -> Iterator[str]:
        """Why the bar cannot be loaded there."""
        if self.load_at_mm is None:
            return
        if self.bar is None and self.section is None:
            yield (
                "load_at_mm is given with the 6x6 of a whole bar, allowed is a uniform one, given by bar or by section"
            )
        if (self.tip or "free") != "free":
            yield f"load_at_mm is given, allowed with a free tip: this one is {self.tip}"
        if isinstance(self.load_at_mm, tuple) and any(self.load_at_mm[1:]):
            yield (
                f"load_at_mm is {list(self.load_at_mm)}, allowed is a point on the bar, [x, 0, 0]: how far beside it "
                "the load cell is says [cell] at_mm"
            )
        if self.line_weight_N_per_mm:
            yield (
                "line_weight_N_per_mm is given with load_at_mm, allowed is one of them: the sag of the piece beyond "
                'the load is not computed; leave the weight out and zero the dials under it, zero = "first_row"'
            )
        if self.loaded_at is not None and self.loaded_at > self.length_mm:
            yield f"load_at_mm is {self.loaded_at:g}, a bar of {self.length_mm:g} mm allows no more than that"

    @property
    def loaded_at(self) -> float | None:
        """mm from the base, None at the tip."""
        where = self.load_at_mm
        return where[0] if isinstance(where, tuple) else where

    def bars(self) -> BarRig:
        at = None if self.loaded_at == self.length_mm else self.loaded_at
        return BarRig(base=self.base or "clamped", tip=self.tip or "free", load_at=at, **self.made_of())

    @classmethod
    def stand_in(cls, raw: dict[str, Any]) -> BarRig:
        tips: dict[str, Tip] = {tip: tip for tip in get_args(Tip)}
        return BarRig(length=1.0, tip=tips.get(str(raw.get("tip")), "free"))
