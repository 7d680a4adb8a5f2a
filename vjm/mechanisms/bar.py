"""One elastic bar along x: the virtual joint model of a link (Salisbury 1980, as used in Eq. 1)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from vjm import checks
from vjm.chain import Chain, Element, Joint, Role
from vjm.frames import Array
from vjm.mechanism import ElasticChain
from vjm.mechanisms.parallelogram import STATION, SpringAt, elastic_bar


@dataclass(frozen=True, eq=False)
class Bar:
    """A bar whose base is clamped, or pinned about y; its tip is the platform point.

    length: mm. bar_stiffness: (6, 6) at the tip, base clamped. Base frame and bar frame coincide.
    ValueError for a length that is not positive or a stiffness that is not symmetric positive definite.
    """

    length: float
    bar_stiffness: Array
    base: Literal["clamped", "pinned"] = "clamped"
    spring_at: SpringAt = "tip"

    def __post_init__(self) -> None:
        checks.positive("length", self.length)
        if self.base not in ("clamped", "pinned"):
            raise ValueError(f"base must be 'clamped' or 'pinned', got {self.base!r}")
        object.__setattr__(
            self, "bar_stiffness", checks.stiffness_matrix("bar_stiffness", self.bar_stiffness)
        )

    @cached_property
    def chains(self) -> tuple[ElasticChain, ...]:
        """One chain: the base hinge if there is one, then the six springs."""
        elements, stiffness = elastic_bar(self.length, self.bar_stiffness, STATION[self.spring_at])
        hinges: tuple[Element, ...] = (
            (Joint("rotation", (0.0, 1.0, 0.0), Role.PASSIVE),) if self.base == "pinned" else ()
        )
        chain = Chain(hinges + elements)
        return (ElasticChain(chain, stiffness, np.zeros(chain.size)),)

    @property
    def unloaded_pose(self) -> Array:
        """(6,) base frame."""
        return np.array([self.length, 0.0, 0.0, 0.0, 0.0, 0.0])
