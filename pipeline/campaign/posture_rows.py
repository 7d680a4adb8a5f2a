"""Postures as columns: the rows of one test of a manipulator, parted into a test at each point of its platform."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.head import Description, Head
from pipeline.campaign.measured import Measured
from pipeline.campaign.model import Vector
from pipeline.campaign.names import PLACES
from pipeline.campaign.rigs.manipulator import ManipulatorRig
from pipeline.toml.complaints import Complaints, shown


def parted(
    measured: Measured, description: Description, complaints: Complaints
) -> tuple[Measured, Description]:
    """The rows with a test of its own for each posture, and a head for each of these, named `id 1`, `id 2` ...

    A posture begins where the point differs from that of the row before it in the same test. Tests that say `at_mm`
    themselves stay as they are. Complaints about a test that has no point, or two.
    """
    given = [column for column in PLACES if column in measured.values]
    if not isinstance(description.rig, ManipulatorRig):
        for column in given:
            complaints.add(f"column {column}", 'is of a manipulator, allowed only with kind = "manipulator"')
        return measured, description
    whole, tests = description.rig, np.array(measured.tests, dtype=object)
    points = np.column_stack([measured.of(column) for column in PLACES])
    heads: list[Head] = []
    rigs: dict[Vector, ManipulatorRig] = {}
    for head in description.heads:
        rows = np.flatnonzero(tests == head.id)
        if said := _refused(head, points[rows]):
            complaints.add(
                f"test {shown(head.id)}", said, int(measured.lines[rows[0]]) if rows.size else None
            )
            continue
        if head.rig.point is not None:
            heads.append(head)
            continue
        for number, mine in enumerate(_runs(points, rows), start=1):
            name, point = f"{head.id} {number}", _vector(points[mine[0]])
            if why := whole.unreached(point):
                said = f"the platform is to stand at {list(point)} mm: {why}"
                complaints.add(f"test {shown(head.id)}", said, int(measured.lines[mine[0]]))
            if name in (other.id for other in description.heads):
                said = f"is the name of a posture of {shown(head.id)} too, allowed is another name"
                complaints.add(f"test {shown(name)}", said)
            tests[mine] = name
            rig = rigs.setdefault(point, replace(whole, at=point))
            heads.append(replace(head, id=name, rig=rig))
    values = {column: values for column, values in measured.values.items() if column not in PLACES}
    return replace(measured, tests=tuple(tests), values=values), replace(description, heads=tuple(heads))


def _refused(head: Head, points: NDArray[np.float64]) -> str:
    """Why a test has no point, or two; empty where it has one. points: (N, 3) of its rows, NaN where there is none."""
    there = np.isfinite(points)
    if head.rig.point is not None:
        return f"has at_mm and columns {', '.join(PLACES)}, allowed is one of the two" if there.any() else ""
    if not there.any():
        return (
            "at_mm is missing, a manipulator needs the point where its platform stands: in campaign.toml, or as "
            f"columns {', '.join(PLACES)}"
        )
    return "" if there.all() else f"has rows without {', '.join(PLACES)}, allowed is one for each row"


def _runs(points: NDArray[np.float64], rows: NDArray[np.int64]) -> Iterator[NDArray[np.int64]]:
    """Rows one after the other with the same point."""
    if rows.size:
        ends = np.flatnonzero(np.any(np.diff(points[rows], axis=0) != 0.0, axis=1)) + 1
        yield from np.split(rows, ends)


def _vector(point: NDArray[np.float64]) -> Vector:
    x, y, z = point.tolist()
    return x, y, z
