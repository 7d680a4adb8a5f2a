"""What the curve at a site is like, in words that an engineer knows before any form has a name."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pipeline.discover.bases import KNOTS, REACHES, basis_of, hats, knots
from pipeline.discover.evidence import Evidence, Rest

Array = NDArray[np.float64]
POINTS = 61
LOOP = 0.2
"""Part of the curve's height from which sliders make a loop of it."""
CURVED = 0.1
FLAT = 0.25
"""Slope about zero over that far out, below which there is a dead band, and over whose inverse it is steep there."""
LOPSIDED = 0.25


def band(found: Evidence, rest: Rest, low: float, high: float) -> tuple[Array, Array, Array]:
    """(P,) coordinates over the range that was met, the function there, and its standard deviation. Where it remembers,
    on the way from rest to the upper end, to the lower one and back."""
    at, loop = np.linspace(low, high, POINTS), bool(found.prior.memory)
    if loop:
        at = np.concatenate([at[at >= 0.0], at[::-1], at])
    basis = basis_of(at, np.array([0, at.size]), found.site.largest)
    gram = rest.product(found.site.values, found.site.values)
    root = found.size * found.prior.root
    inner = np.linalg.inv(np.eye(root.shape[1]) + root.T @ gram @ root)
    spread = np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", basis, root @ inner @ root.T, basis), 0.0))
    return at, basis @ found.weights, spread


def described(found: Evidence, coordinate: Array) -> str:
    """The curve in words, over the coordinates (R,) that were met."""
    low, high = float(coordinate.min()), float(coordinate.max())
    at = np.linspace(low, high, POINTS)
    curve = hats(at, knots(found.site.largest)) @ found.weights[:KNOTS]
    # A slider's limit is the sum of those that slip.
    loop = float(np.sum(np.abs(found.weights[KNOTS:]) * np.minimum(1.0, 1.0 / (2.0 * np.array(REACHES)))))
    height = 0.5 * float(curve.max() - curve.min())
    said = []
    if found.prior.memory and loop > LOOP * (height + loop):
        said.append("a loop: it depends on the way there" if height > LOOP * loop else "a loop like friction")
    if height > LOOP * loop:
        said += _of_curve(at, curve)
    return ", ".join(said) or "nearly constant"


def _of_curve(at: Array, curve: Array) -> list[str]:
    """Straight, curved, flat or steep about zero, one-sided."""
    line = np.polyfit(at, curve, 1)
    off = curve - np.polyval(line, at)
    height = float(np.abs(curve - curve.mean()).max()) or 1.0
    if float(np.abs(off).max()) < CURVED * height:
        return ["straight"]
    slopes = np.gradient(curve, at)
    near = np.abs(at) < 0.2 * np.abs(at).max()
    far = np.abs(at) > 0.6 * np.abs(at).max()
    said = []
    both = at.min() < -0.3 * at.max() and at.max() > -0.3 * at.min()
    if both and near.any() and far.any():
        inner, outer = float(np.median(slopes[near])), float(np.median(slopes[far]))
        if abs(inner) < FLAT * abs(outer):
            said.append("flat about zero, then steeper, as a gap or a dead band")
        elif abs(outer) < FLAT * abs(inner):
            said.append("steep about zero, then level, as a contact or a saturation")
        elif abs(outer) < abs(inner):
            said.append("less and less steep")
        else:
            said.append("steeper and steeper")
        ends = [np.abs(slopes[far & side]) for side in (at > 0, at < 0)]
        if all(end.size for end in ends):
            up, down = (float(end.mean()) for end in ends)
            if abs(up - down) > LOPSIDED * (up + down):
                said.append("not the same in both directions")
    return said or ["curved"]
