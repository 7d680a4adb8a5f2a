"""The bar's own frame in the frame of its file: origin at the base point, x to the tip point, y along the hinges."""

from dataclasses import dataclass

import numpy as np

from meshes.facets import written
from meshes.solid import Floats

# Sine of the angle between x and a hinge's normal plane: a hinge that leans more is none of a parallelogram.
LEANING = 1e-3


@dataclass(frozen=True, eq=False)
class BarFrame:
    """`origin` (3,) mm and `turn` (3, 3), rows x, y, z of the bar in the file's frame; `length` mm; `said` how y is."""

    origin: Floats
    turn: Floats
    length: float
    said: str

    def to_bar(self, points: Floats) -> Floats:
        """Points (n, 3) of the file in the bar's frame, mm."""
        return np.asarray((points - self.origin) @ self.turn.T)


def bar_frame(
    base: Floats, tip: Floats, axes: tuple[Floats | None, Floats | None], y: tuple[float, ...] | None
) -> BarFrame:
    """The frame of ends at points (3,) mm with the `axes` of their bores.

    y: declared, else the base's axis, or the tip's, else the axis of the file that is most across the bar.

    ValueError for ends in one place, a y along the bar, or bores whose axes lean towards the bar or each other.
    """
    along = tip - base
    length = float(np.linalg.norm(along))
    if not length > 0.0:
        raise ValueError("base and tip stand in one place, allowed are two ends")
    x = along / length
    for which, axis in zip(("base", "tip"), axes, strict=True):
        if axis is not None and (lean := abs(float(axis @ x))) > LEANING:
            raise ValueError(
                f"the axis of the {which} bore, {written(tuple(axis))}, leans {np.degrees(np.arcsin(lean)):.2f} "
                "degrees from a right angle to the bar, allowed is a hinge across the bar"
            )
    given = [a for a in axes if a is not None]
    if len(given) == 2 and np.linalg.norm(np.cross(given[0], given[1])) > LEANING:
        raise ValueError(
            "the axes of the two bores are not parallel, allowed are the hinges of a parallelogram"
        )
    if y is not None:
        wanted, said = np.array(y, dtype=float), "y as declared"
    elif given:
        wanted, said = given[0], "y along the bores"
    else:
        # Of the file's own axes y first: a part that is drawn as the bar stands keeps its axes.
        order = [1, 2, 0]
        wanted = np.eye(3)[min(order, key=lambda k: round(abs(float(x[k])), 6))]
        said = f"y along the file's {'xyz'[int(np.argmax(wanted))]}"
    across = wanted - (wanted @ x) * x
    if not np.linalg.norm(across) > 1e-6 * np.linalg.norm(wanted):
        raise ValueError(f"y is {written(tuple(wanted))}, along the bar; allowed is a direction across it")
    across /= np.linalg.norm(across)
    return BarFrame(base, np.stack((x, across, np.cross(x, across))), length, said)
