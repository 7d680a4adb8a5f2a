"""A rig of two bars between four hinges: the parallelogram of the paper."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from pipeline.campaign.gauge import Gauge, Vector
from pipeline.campaign.names import DISPLACEMENT, FORCE
from pipeline.campaign.rig import Array, Mistakes
from pipeline.campaign.rigs.bars import RigOfBars, TableOfBars
from pipeline.campaign.usual_tests import UsualTest
from pipeline.toml.fields import Length
from vjm.mechanisms.parallelogram import Parallelogram

_D, _F = DISPLACEMENT, FORCE
TESTS = (
    UsualTest("loaded along x with the platform held", (_F, _D, _D, _D, _D, _D), 0),
    UsualTest("loaded along x with the platform free along y", (_F, _F, _D, _D, _D, _D), 0),
    UsualTest("moved along y, held in rotation", (_F, _D, _D, _D, _D, _D), 1),
    UsualTest("moved along y under compression, free to turn", (_F, _D, _D, _F, _F, _F), 1, -0.3),
    UsualTest("moved along y under tension, free to turn", (_F, _D, _D, _F, _F, _F), 1, 0.5),
    UsualTest("swung along z", (_F, _F, _D, _D, _D, _D), 2),
    UsualTest("turned about x", (_F, _D, _D, _D, _F, _F), 3),
    UsualTest("turned about z", (_F, _D, _D, _D, _F, _D), 5),
)


@dataclass(frozen=True, eq=False, kw_only=True)
class ParallelogramRig(RigOfBars):
    """Two bars; width: mm between them."""

    kind = acted_on = "parallelogram"
    runaway = "z is a mechanism"
    bars = 2
    usual_angles = (0.0, 15.0, 30.0, -30.0)

    width: float

    @property
    def written(self) -> tuple[str, ...]:
        return (*super().written, "width_mm", "q_mrad")

    @property
    def spread(self) -> float:
        return self.width

    def mechanism(self, gauges: tuple[Gauge, ...]) -> Parallelogram:
        return self.equipped(Parallelogram(self.length, self.width, self.stiffness), gauges)

    def swing(self, q: float) -> Array:
        """The bars turn about y and the platform follows without turning."""
        return np.array([-np.sin(q), 0.0, -np.cos(q), 0.0, 0.0, 0.0])

    def along(self, q: float) -> Array:
        return np.array([np.cos(q), 0.0, -np.sin(q)])

    def usual_tests(self, control: tuple[str, ...]) -> tuple[UsualTest, ...]:
        return TESTS

    def placed(self, q_deg: float | None, at_mm: Vector | None) -> tuple[ParallelogramRig, Mistakes]:
        _, mistakes = super().placed(q_deg, at_mm)
        if q_deg is None:
            mistakes.append(("", "q_deg is missing, a parallelogram needs it"))
        return self, mistakes

    def keys(self) -> dict[str, Any]:
        size = {"length_mm": self.length, "width_mm": self.width}
        return {**size, **self.bar_keys(), **self.common_keys(), **self.fibre_keys()}


class TABLE(TableOfBars):
    """Two bars."""

    template = """kind = "parallelogram"       # two bars between four hinges; or "bar"
length_mm = "?"              # between the hinge axes
width_mm = "?"               # between the bars
bar = { EA_N = "?", EIy_Nmm2 = "?", EIz_Nmm2 = "?", GJ_Nmm2 = "?" }   # of one bar
"""
    posture_template = (
        'q_deg = "?"                  # angle of the bars, positive where they point towards -z\n'
    )
    posture_key = 'q_deg = "?"'
    # It swings along z unless something holds it there.
    held = ("z",)

    kind: Literal["parallelogram"]
    """Two bars between four hinges about y."""
    width_mm: Length | None = None
    """Distance of the two bars; it is needed."""

    def contradictions(self) -> list[str]:
        missing = ["width_mm is missing, a parallelogram needs it"] if self.width_mm is None else []
        return [*missing, *super().contradictions()]

    def bars(self) -> ParallelogramRig:
        assert self.width_mm is not None
        return ParallelogramRig(width=self.width_mm, **self.made_of())

    @classmethod
    def stand_in(cls, raw: dict[str, Any]) -> ParallelogramRig:
        return ParallelogramRig(length=1.0, width=1.0)
