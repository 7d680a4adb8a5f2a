"""Fewer points for a swept surface: stretches along the bar are merged, its section stays as it is."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

# A VTU may hold single precision: some 1e-5 mm at the end of a bar, 1e-6 mm across it.
X_DECIMALS, YZ_DECIMALS = 3, 4


@dataclass(frozen=True)
class Triangles:
    """`corners` (m, 3) count within `points`, the numbers of the original points that are kept."""

    points: Ints
    corners: Ints


def thin(points: Floats, corners: Ints, limit: int) -> Triangles:
    """The surface on as many stations along x as `limit` points allow; all of it if it is not swept.

    points (n, 3) in mm; corners (m, 3). Stations where the outline changes (ends, lugs) are always kept.
    """
    _, at = np.unique(np.round(points[:, 0], X_DECIMALS), return_inverse=True)
    kept = stations_within(np.bincount(at), limit)
    target = nearest_on_line(points, kept[at])
    moved = target[corners]
    moved = moved[(moved != np.roll(moved, 1, axis=1)).all(axis=1)]
    used, numbered = np.unique(moved, return_inverse=True)
    return Triangles(used, numbered.reshape(-1, 3))


def stations_within(counts: Ints, limit: int) -> npt.NDArray[np.bool_]:
    """Which stations stay, given their numbers of points: every second, third, .. until `limit` is met."""
    change = np.ones(len(counts), dtype=bool)
    change[1:-1] = (counts[1:-1] != counts[:-2]) | (counts[1:-1] != counts[2:])
    kept = np.ones_like(change)
    for step in range(1, len(counts)):
        kept = change | (np.arange(len(counts)) % step == 0)
        if counts[kept].sum() <= limit:
            break
    return kept


def nearest_on_line(points: Floats, kept: npt.NDArray[np.bool_]) -> Ints:
    """For each point the nearest kept one with the same y and z; itself where that line has none."""
    target = np.arange(len(points))
    _, line = np.unique(np.round(points[:, 1:], YZ_DECIMALS), axis=0, return_inverse=True)
    for members in np.split(np.argsort(line, kind="stable"), np.cumsum(np.bincount(line))[:-1]):
        stay = members[kept[members]]
        if len(stay):
            distance = np.abs(points[members, None, 0] - points[None, stay, 0])
            target[members] = stay[distance.argmin(axis=1)]
    return target
