"""A rig of one bar along x, its base clamped or pinned, its tip free, pinned or guided."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np

from pipeline.campaign.gauge import Gauge, Vector
from pipeline.campaign.names import DISPLACEMENT, FORCE, SUPPORT
from pipeline.campaign.rig import Array, Mistakes
from pipeline.campaign.rigs.bars import RigOfBars, TableOfBars
from pipeline.campaign.usual_tests import UsualTest
from pipeline.toml.complaints import shown
from vjm.mechanisms.bar import HELD, Bar, Base, Tip

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
    """One bar; base, tip: its supports."""

    kind = acted_on = "bar"
    runaway = "the pinned bar is a mechanism"
    largest_turn = np.pi
    bars = 1

    base: Base = "clamped"
    tip: Tip = "free"

    @property
    def supports(self) -> dict[str, str]:
        return dict.fromkeys(HELD[self.tip], f"the {self.tip} tip")

    @property
    def ends(self) -> tuple[Base, Tip]:
        return self.base, self.tip

    def mechanism(self, gauges: tuple[Gauge, ...]) -> Bar:
        return self.equipped(Bar(self.length, self.stiffness, base=self.base, tip=self.tip), gauges)

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
"""

    kind: Literal["bar"]
    """One bar along x."""
    base: Base | None = None
    """Support of its base. Left out: clamped."""
    tip: Tip | None = None
    """Support of its tip. guided: it shifts and does not turn. pinned: a hinge about y on a block that slides along x.
    Left out: free."""

    def bars(self) -> BarRig:
        return BarRig(base=self.base or "clamped", tip=self.tip or "free", **self.made_of())

    @classmethod
    def stand_in(cls, raw: dict[str, Any]) -> BarRig:
        tips: dict[str, Tip] = {tip: tip for tip in get_args(Tip)}
        return BarRig(length=1.0, tip=tips.get(str(raw.get("tip")), "free"))
