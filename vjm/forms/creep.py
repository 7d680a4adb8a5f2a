"""Creep and relaxation over load steps: a standard linear solid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm.forms.base import Form, Quantity, by_tests
from vjm.frames import Array
from vjm.laws import Law, Response


@dataclass(frozen=True, eq=False)
class Lagging:
    """F = k u + c (u - h), h following u by h <- a h + (1 - a) u a step. memory: h."""

    slow: float
    more: float
    keep: float

    @property
    def initial_memory(self) -> Array:
        return np.zeros(1)

    def respond(self, strain: Array, memory: Array) -> Response:
        new = self.keep * memory + (1.0 - self.keep) * strain
        force = self.slow * strain + self.more * (strain - new)
        slope = self.slow + self.more * self.keep
        tangent = np.full((*strain.shape, 1), slope)
        return Response(0.5 * (force * strain)[..., 0], force, tangent, new)


class Creep(Form):
    """y = k x + c (x - h), h following x over n load steps: at a joint its force relaxes."""

    name = "creep"
    title = "relaxation over load steps"
    equation = "y = k x + c (x - h), h following x over n steps"
    limits = "counts load steps, not time"
    places = ("parallel",)
    amplitudes = (
        Quantity("slope", 1, -1, "slope when it has relaxed", positive=True),
        Quantity("relaxing", 1, -1, "slope that relaxes", positive=True),
    )
    shapes = (Quantity("steps", 0, 0, "load steps over which it follows", positive=True, span=(0.2, 100.0)),)
    memory = True
    begins_at = ((1.0,), (3.0,), (10.0,))

    def columns(self, x: Array, first: np.ndarray, shapes: Array, axial: Array | None = None) -> Array:
        return np.column_stack([x, x - lagged(x, first, kept(shapes[0]))])

    def law(self, amplitudes: Array, shapes: Array, series: bool) -> Law:
        return Lagging(float(amplitudes[0]), float(amplitudes[1]), kept(shapes[0]))


def kept(steps: float) -> float:
    """Part of a distance that is left after a load step, of one that is followed over so many."""
    return float(np.exp(-1.0 / steps))


def lagged(x: Array, first: np.ndarray, keep: float) -> Array:
    """(R,) h along x (R,), zero before each test."""
    history, places = by_tests(x, first)
    out, held = np.zeros(history.shape), np.zeros(len(history))
    for step in range(history.shape[1]):
        held = keep * held + (1.0 - keep) * history[:, step]
        out[:, step] = held
    return np.asarray(out.reshape(-1)[places])
