"""A place of a leg where a law may sit in series: one more axis, which a law holds or an input moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np

from vjm.chain import Joint, Role
from vjm.frames import Array
from vjm.laws import Around, Law, Response
from vjm.slides import Giving

_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, eq=False)
class SiteJoint:
    """One axis, along x, y or z (0, 1, 2) or about them (3, 4, 5) of the frame in which it stands.

    law: force, N, or moment, N·mm, as a function of its shift, mm, or turn, rad. None: it
    is rigid and stands where the input `name` puts it, mm or rad, zero by default: a displacement put in at the site.
    apart: whether the base body is one for all bars on it though no law moves it here, so that unknowns are in the
    order of a linkage in which one does.
    """

    axis: int
    law: Law | None = None
    name: str = ""
    apart: bool = False

    @property
    def unloaded(self) -> float:
        """Its shift or turn without load, where gauges are zeroed."""
        return float(self.law.give(np.zeros(()))) if isinstance(self.law, Giving) else 0.0

    @property
    def from_unloaded(self) -> Law | None:
        """Its law as a function of the shift or turn from there."""
        return self.law if self.law is None or self.unloaded == 0.0 else _From(self.law, self.unloaded)

    @property
    def joint(self) -> Joint:
        """Its joint in a chain."""
        kind = "translation" if self.axis < 3 else "rotation"
        role = Role.ACTUATED if self.law is None else Role.VIRTUAL
        return Joint(kind, _AXES[self.axis % 3], role)  # type: ignore[arg-type]


@dataclass(frozen=True, eq=False)
class _From(Around):
    """A law whose strain is known from its force, over the strain beyond that without load."""

    unloaded: float

    def respond(self, strain: Array, memory: Array) -> Response:
        return self.law.respond(strain + self.unloaded, memory)

    def give(self, force: Array) -> Array:
        """Strain at a force; both (...)."""
        return cast(Giving, self.law).give(force) - self.unloaded
