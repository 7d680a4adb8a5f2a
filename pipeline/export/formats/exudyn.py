"""Exudyn: a Python module with `build(mbs)`, which adds the bar or the linkage to a system.

A bar is a spring-damper of rigid bodies with its whole 6x6, at its tip. The linkage has five bodies: each bar between
its base hinge and the spring, an end between the spring and the tip hinge, and the platform.
"""

from __future__ import annotations

from pathlib import Path
from pprint import pformat
from typing import Any

from pipeline.export.content import UNITS as BASE_UNITS
from pipeline.export.content import Export, Linkage, commented, head, lost_by_mechanism
from vjm.frames import rotation_y

ONE = True
MASS = 1e-3
UNITS = f"{BASE_UNITS} Masses in t, time in s."

_SHARED = '''
import exudyn as exu
import numpy as np
from exudyn import itemInterface as item

MASS = {mass!r}  # t, of every body: a placeholder
TO_HINGE = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
# Turns z, about which Exudyn's hinge turns, into y.


def body(mbs, place, arm):
    """A rigid body at a place, mm; its placeholder of an inertia is that of its mass on an arm, mm."""
    node = mbs.AddNode(item.NodeRigidBodyEP(referenceCoordinates=[*place, 1.0, 0.0, 0.0, 0.0]))
    inertia = [MASS * arm**2] * 3 + [0.0] * 3
    return mbs.AddObject(item.ObjectRigidBody(physicsMass=MASS, physicsInertia=inertia, nodeNumber=node))


def marker(mbs, of, place=(0.0, 0.0, 0.0)):
    """A frame on a body, at a place in its axes, mm."""
    return mbs.AddMarker(item.MarkerBodyRigid(bodyNumber=of, localPosition=list(place)))


def spring(mbs, first, second, stiffness, turn):
    """A 6x6 between two frames, in axes that are turned by (3, 3) against those of the first."""
    return mbs.AddObject(
        item.ObjectConnectorRigidBodySpringDamper(
            markerNumbers=[first, second],
            stiffness=np.array(stiffness),
            rotationMarker0=np.array(turn),
            rotationMarker1=np.array(turn),
        )
    )
'''

_BAR = '''

def build(mbs, number=0):
    """Adds a bar to a system, its base fixed; returns numbers of its objects and markers by name."""
    bar = BARS[number]
    ground = mbs.AddObject(item.ObjectGround())
    tip = body(mbs, bar["point_mm"], bar["point_mm"][0])
    ends = marker(mbs, ground, bar["point_mm"]), marker(mbs, tip)
    made = spring(mbs, *ends, bar["stiffness"], np.eye(3))
    return {"ground": ground, "body": tip, "spring": made, "point": ends[1]}
'''

_LINKAGE = '''

def hinge(mbs, first, second):
    """Two frames that turn against each other about y."""
    return mbs.AddObject(
        item.ObjectJointRevoluteZ(
            markerNumbers=[first, second], rotationMarker0=TO_HINGE, rotationMarker1=TO_HINGE
        )
    )


def build(mbs):
    """Adds the linkage to a system, its base fixed; returns numbers of its objects and markers by name."""
    made = {"ground": mbs.AddObject(item.ObjectGround())}
    point = np.array(POINT)
    made["platform"] = body(mbs, point, LENGTHS[0])
    made["point"] = marker(mbs, made["platform"])
    bars = zip(STIFFNESS, BASES, TIPS, LENGTHS, TURNS)
    for k, (stiffness, base, tip, length, turn) in enumerate(bars, 1):
        base, tip = np.array(base), np.array(tip)
        bar, end = body(mbs, base, length), body(mbs, tip, length)
        hinge(mbs, marker(mbs, made["ground"], base), marker(mbs, bar))
        made[f"spring_{k}"] = spring(mbs, marker(mbs, bar, tip - base), marker(mbs, end), stiffness, turn)
        hinge(mbs, marker(mbs, end), marker(mbs, made["platform"], tip - point))
        made[f"bar_{k}"], made[f"end_{k}"] = bar, end
    return made
'''

_MAIN = """

if __name__ == "__main__":
    system = exu.SystemContainer().AddSystem()
    print(build(system))
    system.Assemble()
"""


def lost(it: Export) -> tuple[str, ...]:
    """What the file cannot hold."""
    return (
        *lost_by_mechanism(it),
        f"Masses ({MASS:g} t a body) and inertias are placeholders; there is no gravity and no damping.",
        "The spring counts rotations as three angles in turn: a rotation vector only while they are small.",
    )


def files(it: Export, out: Path) -> dict[Path, bytes]:
    """One file, a Python module that needs exudyn and numpy."""
    shared, linkage = _SHARED.format(mass=MASS), it.linkage
    if linkage is None:
        bars = [{"stiffness": bar.matrix.tolist(), "point_mm": bar.point.tolist()} for bar in it.bars]
        values, build = {"BARS": bars}, _BAR
    else:
        values, build = _of_linkage(linkage), _LINKAGE
    named = "\n".join(f"{name} = {pformat(value, width=100)}" for name, value in values.items())
    top = "\n".join(commented("# ", head(it, UNITS, lost(it))))
    return {out: f"{top}\n{shared}\n\n{named}\n{build}{_MAIN}".encode()}


def _of_linkage(it: Linkage) -> dict[str, Any]:
    """Constants of the module."""
    return {
        "STIFFNESS": [bar.matrix.tolist() for bar in it.bars],
        "LENGTHS": [bar.length for bar in it.bars],
        "BASES": it.bases.tolist(),
        "TIPS": it.tips.tolist(),
        "POINT": it.point.tolist(),
        "TURNS": [rotation_y(angle).tolist() for angle in it.angles],
    }
