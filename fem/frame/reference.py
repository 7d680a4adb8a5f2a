"""Unloaded elements of bars: lengths, stiffness of each element, initial bow."""

from dataclasses import dataclass

import numpy as np

from fem.frame.local import Reference, strains
from fem.frame.motion import relative
from fem.frame.section import Section
from fem.frame.so3 import exp
from meshes.solid import Floats

_RIGID_MARGIN = 1.5
_POINTS = np.array([-1.0, 0.0, 1.0]) * np.sqrt(0.6)
_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0


@dataclass(frozen=True, eq=False)
class Bars:
    """Bars of many tests: (B, K, ...) over tests and bars.

    EA N, GJ N mm² (B, K); EI, GA (B, K, 2) about y and about z; ends (B, K, 2, 2): rigid stretch of each plane at base
    and tip over the length; grid (B, K, n + 1): nodes from 0 to 1; bow (B, K, 2): half sine along y and z, mm.
    """

    EA: Floats
    GJ: Floats
    EI: Floats
    GA: Floats
    ends: Floats
    grid: Floats
    bow: Floats

    @staticmethod
    def of(sections: list[list[Section]], bow: Floats, elements: int) -> "Bars":
        """Bars of the sections of each test and bar, half sines (B, 2) mm, `elements` a bar (a power of two)."""
        planes = [[(s.about_y, s.about_z) for s in row] for row in sections]
        ends = np.array([[[(p.base, p.tip) for p in pair] for pair in row] for row in planes])
        count = len(sections[0])
        return Bars(
            np.array([[s.EA for s in row] for row in sections]),
            np.array([[s.GJ for s in row] for row in sections]),
            np.array([[[p.EI for p in pair] for pair in row] for row in planes]),
            np.array([[[p.GA for p in pair] for pair in row] for row in planes]),
            ends,
            _grid(ends, elements),
            np.repeat(bow[:, None, :], count, axis=1),
        )


def _grid(ends: Floats, elements: int) -> Floats:
    """(B, K, n + 1) nodes: even, but end elements that are half as long again as the longest rigid end in them."""
    even = 1.0 / elements
    first, last = np.moveaxis(np.maximum(even, _RIGID_MARGIN * ends.max(axis=2)), -1, 0)
    inner = np.linspace(0.0, 1.0, elements - 1)
    middle = first[..., None] + (1.0 - first - last)[..., None] * inner
    zero = np.zeros((*first.shape, 1))
    return np.concatenate((zero, middle, zero + 1.0), axis=-1)


def bowed_axis(bars: Bars, length: Floats) -> tuple[Floats, Floats]:
    """Nodes (B, K, n + 1, 3) mm and tangent triads (B, K, n + 1, 3, 3) of the unloaded bars in their bar frames."""
    x = np.zeros((*bars.grid.shape, 3))
    x[..., 0] = bars.grid * length[..., None]
    wave = np.pi * bars.grid[..., None]
    x[..., 1:] = bars.bow[:, :, None, :] * np.sin(wave)
    x[..., -1, 1:] = 0.0
    slope = bars.bow[:, :, None, :] * np.pi / length[..., None, None] * np.cos(wave)
    steep = np.sqrt((slope**2).sum(-1))
    angle = np.arctan(steep) / np.where(steep > 0.0, steep, 1.0)
    turn = np.stack((0.0 * steep, -angle * slope[..., 1], angle * slope[..., 0]), axis=-1)
    return x, exp(turn)


def reference(bars: Bars, length: Floats) -> Reference:
    """Elements of bars of these unloaded lengths (B, K), mm."""
    x, R = bowed_axis(bars, length)
    motion = relative(x[..., :-1, :], R[..., :-1, :, :], x[..., 1:, :], R[..., 1:, :, :])
    strain, _, _ = strains(motion.d, motion.phi)
    s = bars.grid * length[..., None]
    h = np.diff(s)
    low = np.repeat(s[..., :-1, None], 2, axis=-1)
    high = np.repeat(s[..., 1:, None], 2, axis=-1)
    middle = 0.5 * (low + high)
    low[..., 0, :] = bars.ends[..., 0] * length[..., None]
    high[..., -1, :] = (1.0 - bars.ends[..., 1]) * length[..., None]
    extent, centre = high - low, 0.5 * (low + high) - middle
    EI = bars.EI[..., None, :]
    amount = extent / EI
    slender = amount * extent**2 / 12.0
    spread = slender + h[..., None] / bars.GA[..., None, :]
    bend = np.empty((*extent.shape, 2, 2))
    bend[..., 0, 0] = 1.0 / amount + centre**2 / spread
    bend[..., 0, 1] = bend[..., 1, 0] = centre / spread
    bend[..., 1, 1] = 1.0 / spread
    ones = np.ones_like(h)
    return Reference(
        h,
        bars.EA[..., None] * ones,
        bars.GJ[..., None] * ones,
        bend,
        _string(h, low - middle, high - middle, centre, slender, spread),
        strain[..., 0],
        strain[..., 1:3],
        strain[..., 3:],
        centre,
        extent,
    )


def _string(h: Floats, low: Floats, high: Floats, centre: Floats, slender: Floats, spread: Floats) -> Floats:
    """(..., 2, 2, 2) second derivative of the mean of (v' - chord)²/2 for (φ, hβ), of the exact bending line.

    The line turns by φ u + (centre φ + hβ) p against the mean frame: u = τ/f and p = (f²/4 - τ²) / (2 EI spread) over
    the flexible stretch (low to high about the element's middle, τ from its centre), ±½ and 0 on the rigid ends.
    The means are Gauss sums over the three stretches, exact for these polynomials.
    """
    extent = high - low
    half = 0.5 * h[..., None]
    edges = np.stack(
        (-half + 0.0 * low, np.clip(low, -half, half), np.clip(high, -half, half), half + 0.0 * low), -1
    )
    width = np.diff(edges)[..., None] / h[..., None, None, None]
    t = 0.5 * (edges[..., :-1, None] + edges[..., 1:, None]) + 0.5 * np.diff(edges)[..., None] * _POINTS
    tau = t - centre[..., None, None]
    f = extent[..., None, None]
    inside = np.array([False, True, False])[:, None]
    u = np.where(inside, tau / f, 0.5 * np.sign(tau))
    # slender = f³ / (12 EI).
    shape = 6.0 * (0.25 * f**2 - tau**2) / f**3 * (slender / spread)[..., None, None]
    p = np.where(inside, shape, 0.0)
    weight = width * _WEIGHTS

    def covariance(a: Floats, b: Floats) -> Floats:
        means = ((weight * a).sum((-1, -2)), (weight * b).sum((-1, -2)))
        return np.asarray((weight * a * b).sum((-1, -2)) - means[0] * means[1])

    uu, up, pp = covariance(u, u), covariance(u, p), covariance(p, p)
    out = np.empty((*extent.shape, 2, 2))
    out[..., 0, 0] = uu + 2.0 * centre * up + centre**2 * pp
    out[..., 0, 1] = out[..., 1, 0] = up + centre * pp
    out[..., 1, 1] = pp
    return out
