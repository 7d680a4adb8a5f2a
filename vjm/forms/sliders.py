"""Sliders beside a spring: dry friction with elastic starts, at one level, several, or spread as in Iwan's model.

Each slider holds against its coordinate with at most its limit T, which it reaches after the displacement r:
F = k u + sum of T_i clip(u - slip_i, ±r_i) / r_i (W. D. Iwan, Journal of Applied Mechanics 33 (1966) 893-900).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm.forms.base import by_tests
from vjm.frames import Array
from vjm.laws import Response

ROUNDS = 60


@dataclass(frozen=True, eq=False)
class Sliders:
    """stiffness: k >= 0. limits, reaches: (n,), reaches above zero. memory: (n,) slips.

    ValueError for others, and where nothing holds at all.
    """

    stiffness: float
    limits: Array
    reaches: Array

    def __post_init__(self) -> None:
        if not (self.stiffness >= 0.0 and np.all(self.limits >= 0.0) and np.all(self.reaches > 0.0)):
            raise ValueError("sliders need limits and a stiffness of at least zero and reaches above it")

    @property
    def initial_memory(self) -> Array:
        return np.zeros(self.limits.size)

    def respond(self, strain: Array, memory: Array) -> Response:
        trial = strain - memory
        held = np.clip(trial, -self.reaches, self.reaches)
        slope = self.limits / self.reaches
        sticks = np.abs(trial) < self.reaches
        force = self.stiffness * strain[..., 0] + held @ slope
        tangent = self.stiffness + np.where(sticks, slope, 0.0).sum(axis=-1)
        energy = 0.5 * self.stiffness * strain[..., 0] ** 2 + 0.5 * (held**2) @ slope
        return Response(energy, force[..., None], tangent[..., None, None], strain - held)


def followed(x: Array, first: np.ndarray, reaches: Array) -> Array:
    """(R, n) sliders, -1 to 1, of these reaches (n,) along coordinates (R,) of tests that begin relaxed."""
    history, places = by_tests(x, first)
    out, slip = np.zeros((*history.shape, reaches.size)), np.zeros((len(history), reaches.size))
    for step in range(history.shape[1]):
        here = history[:, step, None]
        held = np.clip(here - slip, -reaches, reaches)
        slip = here - held
        out[:, step] = held / reaches
    return np.asarray(out.reshape(-1, reaches.size)[places])


def driven(x: Array, first: np.ndarray, law: Sliders) -> Array:
    """(R,) displacements at which a law of positive stiffness carries the loads x (R,), test by test from its rest."""
    history, places = by_tests(x, first)
    out, slip = np.zeros(history.shape), np.zeros((len(history), law.limits.size))
    u = np.zeros(len(history))
    slope = law.limits / law.reaches
    stiff = law.stiffness + slope.sum()
    for step in range(history.shape[1]):
        load = history[:, step]
        # Each side of the last step is concave or convex: from where all stick, Newton's steps come from one side.
        u = u + (load - _force(law, u, slip)) / stiff
        for _ in range(ROUNDS):
            held = u[:, None] - slip
            tangent = law.stiffness + np.where(np.abs(held) < law.reaches, slope, 0.0).sum(axis=1)
            off = load - _force(law, u, slip)
            u = u + off / tangent
            if np.all(np.abs(off) <= 1e-12 * np.maximum(np.abs(load), 1e-300)):
                break
        slip = u[:, None] - np.clip(u[:, None] - slip, -law.reaches, law.reaches)
        out[:, step] = u
    return np.asarray(out.reshape(-1)[places])


def _force(law: Sliders, u: Array, slip: Array) -> Array:
    held = np.clip(u[:, None] - slip, -law.reaches, law.reaches)
    return np.asarray(law.stiffness * u + held @ (law.limits / law.reaches))
