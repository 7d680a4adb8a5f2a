"""The linkage as lines, deformed as much as can be seen: for a view that can be turned.

Lengths in mm, base frame. Bars are drawn through their ends and as they are held there: out of the plane clamped at
the base and turned with the platform at the tip; in the plane they turn freely. The legs of a manipulator stay up to
their first passive joint and are straight from there to the moved platform.
"""

from collections.abc import Sequence
from math import floor, log10

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

from reports.load import Json

Floats = npt.NDArray[np.float64]
POINTS = 25
PLATFORM = 0.06
"""Of its characteristic length, the half size of the cross that a manipulator's platform is drawn as."""
SHARE = 0.15
"""Of the bars' length, that the largest displacement of a test is drawn with."""


def lines(test: Json, pose: Sequence[float | None] | None, scale: float) -> list[Floats]:
    """Lines (n, 3) of the bars and of the platform; pose: displacement times `scale`, None: unloaded."""
    rig, q = test["rig"], np.radians(test["q_deg"])
    known = np.zeros(6) if pose is None else np.array([value or 0.0 for value in pose]) * scale
    turn = Rotation.from_rotvec(known[3:])
    if rig.get("place_mm") is not None:
        return _manipulator(rig, known[:3], turn)
    along = np.array([np.cos(q), 0.0, -np.sin(q)])
    tip = rig["length_mm"] * along + known[:3]
    half = 0.5 * (rig["width_mm"] or 0.0)
    sides = (-half, half) if half else (0.0,)
    ends = [tip + turn.apply([0.0, 0.0, side]) for side in sides]
    # More than this would draw a knot instead of a bar.
    slope = float(np.clip(turn.apply(along)[1], -0.8, 0.8))
    bars = [_bar(np.array([0.0, 0.0, side]), end, slope) for side, end in zip(sides, ends, strict=True)]
    return [*bars, np.array(ends)] if len(ends) > 1 else bars


def _manipulator(rig: Json, shift: Floats, turn: Rotation) -> list[Floats]:
    """The legs, each point as far as it follows the platform, and a cross for the platform."""
    at = np.array(rig["place_mm"])
    drawn = []
    for line in rig["lines"]:
        points = np.array(line["points"])
        taken = at + shift + turn.apply(points - at)
        drawn.append(points + np.array(line["share"])[:, None] * (taken - points))
    arms = PLATFORM * rig["length_mm"] * np.eye(3)
    return [*drawn, *(at + shift + turn.apply(np.array([-arm, arm])) for arm in arms)]


def scale_of(test: Json) -> float:
    """1, 2 or 5 times a power of ten by which the largest measured displacement of a test is seen; at least 1."""
    reach = test["rig"]["length_mm"]
    turned = 0.5 * (test["rig"]["width_mm"] or reach)
    sizes = [abs(v or 0.0) for pose in test["measured_pose"] for v in pose[:3]]
    sizes += [turned * abs(v or 0.0) for pose in test["measured_pose"] for v in pose[3:]]
    wanted = SHARE * reach / max([*sizes, 1e-9])
    decade = 10.0 ** floor(log10(max(wanted, 1.0)))
    return max(1.0, max(step * decade for step in (1.0, 2.0, 5.0) if step * decade <= max(wanted, 1.0)))


def _bar(base: Floats, end: Floats, slope: float) -> Floats:
    """A bar from its base hinge to its end: straight, but out of the plane a cubic."""
    s = np.linspace(0.0, 1.0, POINTS)[:, None]
    line = base + s * (end - base)
    length = float(np.linalg.norm(end - base))
    line[:, 1] = (end[1] * (3.0 * s**2 - 2.0 * s**3) + slope * length * (s**3 - s**2))[:, 0]
    return line
