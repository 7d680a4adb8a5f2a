"""What yielding takes from the segments of a refined bar, beside their elastic laws.

A segment with the elastic stiffness K carries the load F = K (v - v_p): v is its coordinates theta with h, the
shortening of `vjm.laws.BeamColumn`, added to the first. Inside the segment F is a tension and, in each plane, a
moment that is linear along the part that bends, whatever yields. At STATIONS along it the strains of the section
are what F does elastically, with D the stiffness of the section, and a plastic part:
    e = D^-1 B F + D^-1 m(e),   v_p = integral of B^T D^-1 m,   m = sum EA w arm eps_p,
B F being the section's forces and m what its fibres miss of their elastic stress. With R = D^-1 B K, the elastic
strains by v, this is e - D^-1 m + R K^-1 (sum R^T m ds) = R v, and what the elastic laws have too much of is
sum R^T m ds, exactly nothing as long as no fibre yields. Interpolating F keeps the plastic zone sharp in few
segments: elements with a linear curvature need ten times as many.
E. Spacone, F. C. Filippou, F. F. Taucer, "Fibre beam-column model for non-linear analysis of R/C frames",
Earthquake Engineering and Structural Dynamics 25 (1996) 711-725.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vjm.fibres import lobatto
from vjm.frames import Array
from vjm.laws import Response, block_diagonal
from vjm.section import Section

STATIONS = 15
"""Along the bending part of a segment, its ends among them, where the largest strains of a bar are. They find where
the plastic zone ends within the segment: the plastic deflection of a cantilever to 5e-4, with nine to 2.4e-3."""
_PLACES, _SHARES = lobatto(STATIONS)


@dataclass(frozen=True, eq=False)
class Yielding:
    """Law on the coordinates of n segments, six each.

    section: of the bar. length: of a segment that yields, mm. stiffness: (n, 6, 6) K of the segments. curvature,
    shape: (n, 6) of `BeamColumn`. rate: (n, STATIONS, 3, 6) R.
    memory: plastic strains, n x STATIONS x fibres. The force is NaN where the sections find no strains.
    """

    section: Section
    length: float
    stiffness: Array
    curvature: Array
    shape: Array
    rate: Array

    @property
    def initial_memory(self) -> Array:
        return np.zeros(len(self.shape) * STATIONS * self.section.weights.size)

    def respond(self, strain: Array, memory: Array) -> Response:
        batch, n = strain.shape[:-1], len(self.shape)
        theta = strain.reshape(-1, n, 6)
        before = memory.reshape(len(theta), n, STATIONS, -1)
        bow = self.curvature * (theta + self.shape)
        v = theta.copy()
        v[..., 0] += 0.5 * np.sum(theta * (bow + self.curvature * self.shape), axis=-1)
        pull, slope, after = np.zeros_like(v), np.zeros((*v.shape, 6)), before.copy()
        yields = self._yields(v, before)
        if yields[0].size:
            pull[yields], slope[yields], after[yields] = self._missing(v, before, yields)
        block = np.zeros_like(slope)
        rates = np.broadcast_to(np.eye(6), slope.shape).copy()
        rates[..., 0, :] += bow
        block[yields] = -np.swapaxes(rates[yields], -1, -2) @ slope[yields] @ rates[yields]
        block[..., range(6), range(6)] -= pull[..., :1] * self.curvature
        force = -(pull + pull[..., :1] * bow)
        energy = np.zeros(len(theta))
        np.add.at(energy, yields[0], self._energy(v[yields], pull[yields], after[yields], yields[1]))
        return Response(
            energy.reshape(batch),
            force.reshape(strain.shape),
            block_diagonal(block).reshape(*strain.shape, 6 * n),
            after.reshape(memory.shape),
        )

    def _yields(self, v: Array, before: Array) -> tuple[np.ndarray, ...]:
        """Members and segments with a plastic strain before, or with one now."""
        elastic = np.einsum("nsij,bnj->bnsi", self.rate, v)
        now = np.max(self.section.largest(elastic), axis=-1) > self.section.fibres.limit
        return np.nonzero(now | np.any(before != 0.0, axis=(-2, -1)))

    def _missing(self, v: Array, before: Array, at: tuple[np.ndarray, ...]) -> tuple[Array, Array, Array]:
        """Sum of R^T m ds (N, 6), its derivative by v (N, 6, 6) and the plastic strains, of segments `at`."""
        segment, past = at[1], before[at]
        rate = self.rate[segment]
        relief = self._relief[segment]
        strain = self.section.strains(np.einsum("nsij,nj->nsi", rate, v[at]), past, relief)
        missing = self.section.missing(strain, past)
        flat = rate.reshape(len(rate), -1, 6)
        strain_slope = np.linalg.solve(self.section.matrix(missing.slope, relief), flat)
        change = missing.slope @ strain_slope.reshape(rate.shape)
        weighted = np.swapaxes(flat * self._lengths[:, None], -1, -2)
        slope = weighted @ change.reshape(flat.shape)
        pull = (weighted @ missing.stress.reshape(len(rate), -1, 1))[..., 0]
        return pull, 0.5 * (slope + np.swapaxes(slope, -1, -2)), missing.plastic

    def _energy(self, v: Array, pull: Array, plastic: Array, segment: np.ndarray) -> Array:
        """(N,) stored energy beyond v^T K v / 2 of segments of these numbers (N,) that yield or did: that of v - v_p,
        and what the fibres hold against each other."""
        ea, weights = self.section.rigidity[0], self.section.weights
        missing = plastic @ (ea * weights * self.section.arms).T
        inner = ea * (plastic**2 @ weights) - np.sum(missing**2 / self.section.rigidity, axis=-1)
        give = np.einsum("ni,nij,nj->n", pull, np.linalg.inv(self.stiffness)[segment], pull)
        held = inner @ (self.length * _SHARES)
        return np.asarray(0.5 * (give + held) - np.sum(pull * v, axis=-1))

    @cached_property
    def _lengths(self) -> Array:
        """(3 S,) length ds that each strain of each station stands for, mm."""
        return self.length * np.repeat(_SHARES, 3)

    @cached_property
    def _relief(self) -> Array:
        """(n, 3 S, 3 S) elastic strains R K^-1 R^T ds by the missing stresses."""
        flat = self.rate.reshape(len(self.rate), -1, 6)
        back = np.swapaxes(flat * self._lengths[:, None], -1, -2)
        return flat @ np.linalg.solve(self.stiffness, back)


def strain_rates(stiffness: Array, rigidity: Array, flexible: Array) -> Array:
    """(n, STATIONS, 3, 6) R: extension and curvatures about y and z by the coordinates (s, phi) of the segments.

    stiffness: (n, 6, 6). rigidity: (3,) of `Section`. flexible: (2,) length that bends in y and in z, mm.
    """
    out = np.zeros((len(stiffness), STATIONS, 3, 6))
    out[:, :, 0] = stiffness[:, None, 0] / rigidity[0]
    for plane, (shift, turn, sign) in enumerate(((1, 5, 1.0), (2, 4, -1.0))):
        lever = 0.5 * sign * flexible[plane] * _PLACES[:, None]
        moment = stiffness[:, None, turn] - lever * stiffness[:, None, shift]
        out[:, :, 2 - plane] = moment / rigidity[2 - plane]
    return out
