"""A load cell that reads at another point than the platform's, in a turned frame, or of the other sign.

f = sign R f_read and m = sign R m_read + r x f, with R the rotation by the rotation vector `turned_deg` and r the point
of the cell from that of the platform, base frame.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from pipeline.campaign.mapped.mapping import FORCES, MOMENTS
from pipeline.campaign.mapped.schema import CellTable
from pipeline.toml.complaints import Complaints

Array = NDArray[np.float64]
ROUNDING = 1e-12


def at_platform(
    cell: CellTable, read: dict[str, Array], lines: Sequence[int], complaints: Complaints
) -> dict[str, Array]:
    """Forces and moments (N,) at the platform by their names; a component that enters and was not read is named.

    lines: of the rows, for one in which a component is missing.
    """
    turn = cell.sign * Rotation.from_rotvec(cell.turned_deg, degrees=True).as_matrix()
    turn[np.abs(turn) < ROUNDING] = 0.0
    x, y, z = cell.at_mm
    lever = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    of_force = np.hstack([turn, np.zeros((3, 3))])
    of_moment = np.hstack([lever @ turn, turn])
    out: dict[str, Array] = {}
    every = (*FORCES, *MOMENTS)
    for name, row in zip(every, np.vstack([of_force, of_moment]), strict=True):
        own = FORCES if name in FORCES else MOMENTS
        mine = [c for c, share in zip(every, row, strict=True) if share and c in own]
        # A force without any reading of its kind was not measured: nothing is wrong with that.
        if not any(c in read for c in mine):
            continue
        absent = [c for c, share in zip(every, row, strict=True) if share and c not in read]
        if absent:
            said = f"{name} at the platform needs {', '.join(absent)} of the cell as well, which is not read"
            complaints.add("[cell]", said)
            continue
        _told_in_full(
            name, [c for c, share in zip(every, row, strict=True) if share], read, lines, complaints
        )
        out[name] = np.sum([share * read[c] for c, share in zip(every, row, strict=True) if share], axis=0)
    return out


def _told_in_full(
    name: str, enter: list[str], read: dict[str, Array], lines: Sequence[int], complaints: Complaints
) -> None:
    """A complaint about the first row in which some of the components that enter were read, and not all."""
    there = np.array([np.isfinite(read[c]) for c in enter])
    partly = np.flatnonzero(there.any(axis=0) & ~there.all(axis=0))
    if partly.size:
        k = int(partly[0])
        absent = ", ".join(c for c, mine in zip(enter, there[:, k], strict=True) if not mine)
        complaints.add(
            "[cell]", f"{name} at the platform needs {absent} as well, which is not read here", lines[k]
        )
