"""A bench that is a little off what is written about it: its rig and the angle of its bars, drawn within tolerances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pipeline.assessment.virtual.plan import PlannedTest
from pipeline.campaign import ParallelogramRig
from pipeline.campaign.rigs.bars import UniformBar

SEED = 20_261_128
ENTRIES = {"EA": (0,), "EIz": (1, 5), "EIy": (2, 4), "GJ": (3,)}
"""Rows of a 6x6 that a stiffness of the section scales."""
DECLARED = (
    "Of what is written the default tolerances hold. What is there is drawn from them: EA, EIy, EIz, GJ (2 %), length",
    "and width (0.05 mm; of a bar that is written as a 6x6 the width alone), and one angle of all bars beside the",
    "nominal one (0.5 mrad), each from a normal law of that standard deviation. The ends of the bars (0.5 %) and the",
    "mount of the rig (0.5 mrad) are as written, though the model does not know it.",
)
"""How, for the page."""


@dataclass(frozen=True, eq=False)
class Off:
    """What is there. angle: rad, of all bars beside the nominal one."""

    rig: ParallelogramRig
    angle: float

    def plan(self, plan: Sequence[PlannedTest]) -> tuple[PlannedTest, ...]:
        """The tests at the angles that are there."""
        return tuple(replace(test, q_deg=test.q_deg + float(np.degrees(self.angle))) for test in plan)


def drawn_off(rig: ParallelogramRig, number: int) -> Off:
    """The bench of a case, of which `rig` is what is written. number: of the case; the same is the same bench."""
    generator = np.random.default_rng([SEED, number])
    usual = rig.usual_tolerance
    factors = {key: 1.0 + usual[key] * float(generator.standard_normal()) for key in ENTRIES}
    longer, wider = (usual[key] * float(generator.standard_normal()) for key in ("length_mm", "width_mm"))
    angle = 1e-3 * usual["q_mrad"] * float(generator.standard_normal())
    if rig.bar is None:
        return Off(replace(rig, bar_stiffness=scaled(rig.stiffness, factors), width=rig.width + wider), angle)
    bar = UniformBar(**{key: getattr(rig.bar, key) * factor for key, factor in factors.items()})
    return Off(replace(rig, bar=bar, length=rig.length + longer, width=rig.width + wider), angle)


def scaled(stiffness: np.ndarray, factors: dict[str, float]) -> np.ndarray:
    """(6, 6) of a straight bar whose section is so many times as stiff."""
    root = np.ones(6)
    for key, rows in ENTRIES.items():
        root[list(rows)] = np.sqrt(factors[key])
    return np.asarray(stiffness * np.outer(root, root))
