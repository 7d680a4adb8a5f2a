"""Dry friction that goes with the axial load of the bar, as in a bushing: what slips bears more under load.

The load is that at the end of the load step before, N', so that nothing holds in the first one. Limits and reaches are
told at the greatest axial load that was seen, N0, and go with the load.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from vjm.forms.base import Form, Quantity, by_tests
from vjm.forms.coulomb import REACH
from vjm.frames import Array
from vjm.laws import Law
from vjm.under_load import UnderLoad

AT = Quantity("at", 0, 0, "axial load at which the limit is told", positive=True, of_load=1)


class FrictionByLoad(Form):
    """y = T N'/N0 s, s a slider of reach r N'/N0."""

    name = "friction_by_load"
    title = "dry friction that goes with the axial load"
    equation = "abs(y) <= T N'/N0, dy = T/r dx while it sticks, N' the axial load a step before"
    limits = "the load acts one load step later: fine steps are told best"
    places = ("parallel",)
    amplitudes = (Quantity("limit", 1, 0, "while it slips under the load N0", positive=True),)
    shapes: ClassVar[tuple[Quantity, ...]] = (REACH, AT)
    fixed = ("at",)
    memory = True
    loaded = True
    grows = "linear"
    begins_at = ((0.01, 1.0), (0.06, 1.0), (0.3, 1.0))

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        return _followed(x, first, UnderLoad(0.0, 1.0, *shapes), axial)

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return UnderLoad(0.0, float(amplitudes[0]), *shapes)

    def under(self, shapes: Array, load: float) -> Array:
        return np.array([shapes[0], load])


class SlipByLoad(Form):
    """x = w + z, y = g w, z a slider of stiffness b that holds T N'/N0 at most."""

    name = "slip_by_load"
    title = "slip beside a spring, with friction that goes with the axial load"
    equation = "x = y/g + z, abs(z) <= T N'/N0, dz = b/g dy while it sticks, N' the axial load a step before"
    limits = "the load acts one load step later: fine steps are told best"
    places = ("series",)
    amplitudes = (Quantity("give", 1, -1, "displacement per load of the spring", positive=True),)
    shapes = (
        Quantity("limit", 0, 1, "friction while it slips under the load N0", True, span=(1e-4, 10.0)),
        Quantity("stick", 0, 0, "stiffness that sticks over that of the spring", True, span=(0.1, 300.0)),
        AT,
    )
    fixed = ("at",)
    memory = True
    loaded = True
    begins_at = ((0.1, 3.0, 1.0), (0.1, 20.0, 1.0), (0.5, 3.0, 1.0), (0.5, 20.0, 1.0))

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        return _followed(x, first, self._unit(shapes), axial, driven=True)

    def _unit(self, shapes: Array, give: float = 1.0) -> UnderLoad:
        limit, stick, at = (float(each) for each in shapes)
        return UnderLoad(1.0 / give, limit, limit * give / stick, at)

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return self._unit(shapes, float(amplitudes[0]))

    def under(self, shapes: Array, load: float) -> Array:
        return np.array([*shapes[:2], load])


def _followed(
    x: Array, first: np.ndarray, law: UnderLoad, axial: Array | None, driven: bool = False
) -> Array:
    """(R, 1) forces along displacements x (R,), or driven by loads x the displacements, of tests that begin relaxed.

    axial: (R,) loads of the bar, default none at all.
    """
    history, places = by_tests(x, first)
    loads = by_tests(np.zeros(x.shape) if axial is None else np.abs(axial), first)[0]
    out, memory = np.zeros(history.shape), np.zeros((len(history), 2))
    for step in range(history.shape[1]):
        here = history[:, step]
        u = _displacement(law, here, memory) if driven else here
        answer = law.respond(u[:, None], memory)
        out[:, step] = u if driven else answer.force[:, 0]
        memory = answer.memory.copy()
        memory[:, 0] = loads[:, step]
    return np.asarray(out.reshape(-1)[places][:, None])


def _displacement(law: UnderLoad, load: Array, memory: Array) -> Array:
    """(T,) at which a law of positive stiffness carries the loads (T,)."""
    slope, most = law.limit / law.reach, law.limit * memory[:, 0] / law.at
    sticks = (load + slope * memory[:, 1]) / (law.stiffness + slope)
    held = np.clip(slope * (sticks - memory[:, 1]), -most, most)
    return np.asarray((load - held) / law.stiffness)
