"""Creep under load in series: a standard linear solid that goes on giving while the load stays."""

from __future__ import annotations

import numpy as np

from vjm.forms.base import Form, Quantity, by_tests
from vjm.forms.creep import Lagging, kept
from vjm.frames import Array
from vjm.laws import Law


class CreepInSeries(Form):
    """y under the load x of a spring and, beside it, another one whose force relaxes over load steps."""

    name = "creep_in_series"
    title = "creep under load"
    equation = "x = (y + m (y - h)) / s, h following y over n steps"
    limits = "counts load steps, not time"
    places = ("series",)
    amplitudes = (Quantity("give", 1, -1, "displacement per load when it has crept", positive=True),)
    shapes = (
        Quantity("relaxing", 0, 0, "stiffness that relaxes over the one that stays", True, span=(1e-3, 1e2)),
        Quantity("steps", 0, 0, "load steps over which it creeps", positive=True, span=(0.2, 100.0)),
    )
    memory = True
    begins_at = ((0.3, 1.0), (0.3, 3.0), (0.3, 10.0), (1.0, 1.0), (1.0, 3.0), (1.0, 10.0))

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        more, keep = float(shapes[0]), kept(shapes[1])
        history, places = by_tests(x, first)
        out, held = np.zeros(history.shape), np.zeros(len(history))
        for step in range(history.shape[1]):
            out[:, step] = (history[:, step] + more * keep * held) / (1.0 + more * keep)
            held = keep * held + (1.0 - keep) * out[:, step]
        return np.asarray(out.reshape(-1)[places][:, None])

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        stays = 1.0 / float(amplitudes[0])
        return Lagging(stays, float(shapes[0]) * stays, kept(shapes[1]))
