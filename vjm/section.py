"""Sections of fibres: what they miss of their elastic stress, and their strains within a segment."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm.fibres import Fibres
from vjm.frames import Array

_ITERATIONS = 60
_TOLERANCE = 1e-12
_HALVINGS = 6


@dataclass(frozen=True, eq=False)
class Missing:
    """What plastic strains take from S sections.

    stress: (..., S, 3) force and moments about y and z, N, N·mm. slope: (..., S, 3, 3) of them by the strains.
    plastic: (..., S, f) strains of the fibres.
    """

    stress: Array
    slope: Array
    plastic: Array


@dataclass(frozen=True, eq=False)
class Section:
    """Fibres at `places` (2, f), y and z in mm, with `weights` (f,) of sum one.

    rigidity: (3,) D: EA, N, and EI about y and about z, N·mm². Strains of a section (..., 3): extension, curvatures
    about y and about z, rad/mm.
    """

    fibres: Fibres
    places: Array
    weights: Array
    rigidity: Array

    @cached_property
    def arms(self) -> Array:
        """(3, f) strain of a fibre by those of the section."""
        y, z = self.places
        return np.stack([np.ones_like(y), z, -y])

    def largest(self, strain: Array) -> Array:
        """(...) largest magnitude of the strain of a fibre at strains (..., 3): fibres lie at all four corners."""
        return np.asarray(np.abs(strain) @ np.max(np.abs(self.arms), axis=1))

    @cached_property
    def _products(self) -> Array:
        """(f, 9) stiffness of each fibre by the strains of the section."""
        squares = self.arms[:, None] * self.arms[None]
        return (self.rigidity[0] * self.weights * squares).reshape(9, -1).T

    def missing(self, strain: Array, before: Array) -> Missing:
        """At strains (..., S, 3), from plastic strains (..., S, f)."""
        plastic, slope = self.fibres.plastic(strain @ self.arms, before)
        return Missing(self._stress(plastic), (slope @ self._products).reshape(*strain.shape, 3), plastic)

    def _stress(self, plastic: Array) -> Array:
        return np.asarray(plastic @ (self.rigidity[0] * self.weights * self.arms).T)

    def strains(self, elastic: Array, before: Array, relief: Array) -> Array:
        """Strains e (N, S, 3) with e - D^-1 m + relief m = elastic, m the missing stress; NaN where not found.

        elastic: (N, S, 3). before: (N, S, f). relief: (N, 3 S, 3 S). Newton's method with halved steps. The
        equations are piecewise linear and, since fibres harden, nowhere singular.
        """
        # If nothing yields any further the equations are linear.
        held = self._stress(before)
        strain = elastic + held / self.rigidity - (relief @ _column(held)).reshape(elastic.shape)
        active = np.arange(len(elastic))
        for _ in range(_ITERATIONS):
            past, aim, by = before[active], elastic[active], relief[active]
            residual, missing = self._residual(strain[active], past, aim, by)
            going = self._norm(residual) > _TOLERANCE * self.fibres.limit
            active, residual = active[going], residual[going]
            if not active.size:
                return strain
            step = -np.linalg.solve(self.matrix(missing.slope[going], by[going]), _column(residual))
            step = step.reshape(residual.shape)
            share = np.ones((active.size, 1, 1))
            for _ in range(_HALVINGS):
                there = strain[active] + share * step
                ahead, _ = self._residual(there, past[going], aim[going], by[going])
                worse = self._norm(ahead) > (1.0 - 1e-4 * share[:, 0, 0]) * self._norm(residual)
                if not np.any(worse):
                    break
                share[worse] *= 0.5
            strain[active] += share * step
        strain[active] = np.nan
        return strain

    def matrix(self, slope: Array, relief: Array) -> Array:
        """(N, 3 S, 3 S) derivative of e - D^-1 m + relief m by e, with m' = slope (N, S, 3, 3)."""
        count, stations = slope.shape[:2]
        by_strain = np.zeros((count, stations, 3, stations, 3))
        every = np.arange(stations)
        by_strain[:, every, :, every, :] = np.moveaxis(slope, 1, 0)
        whole = by_strain.reshape(relief.shape)
        return np.eye(3 * stations) - whole / np.tile(self.rigidity, stations)[:, None] + relief @ whole

    def _residual(self, strain: Array, before: Array, elastic: Array, relief: Array) -> tuple[Array, Missing]:
        missing = self.missing(strain, before)
        eased = (relief @ _column(missing.stress)).reshape(strain.shape)
        return strain - missing.stress / self.rigidity + eased - elastic, missing

    def _norm(self, strain: Array) -> Array:
        """(N,) largest strain of the fibres at the radii of gyration."""
        return np.max(np.abs(strain) * np.sqrt(self.rigidity / self.rigidity[0]), axis=(-2, -1))


def _column(stations: Array) -> Array:
    return stations.reshape(len(stations), -1, 1)
