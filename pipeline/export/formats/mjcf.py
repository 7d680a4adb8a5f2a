"""MuJoCo: a bar as six joints at its tip and six fixed tendons, a linkage of two such bars closed by a weld.

A fixed tendon is as long as a linear combination of joint coordinates and has one stiffness, so that tendons along the
eigenvectors of a 6x6 hold it with all its couplings.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from xml.etree import ElementTree as Tree

import numpy as np

from pipeline.export import si
from pipeline.export.content import Export, Linkage, Spring, head, lost_by_mechanism
from pipeline.export.si import METRE
from pipeline.export.si import UNITS as UNITS
from vjm.frames import Array

ONE = True
MASS = 1.0
"""kg of every body: in place of the user's own. With it the inertia m L², so that no rotation is faster than the
fastest displacement."""
STEPS = 100
"""Time steps in a radian of the fastest vibration; the weld is as stiff as two steps allow."""
WELD_STEPS = 2.0
WELD_IMPEDANCE = 0.9999
"""The greatest that MuJoCo takes: what is missing to 1 is the softness of its constraints."""
_AXES = (("x", "1 0 0"), ("y", "0 1 0"), ("z", "0 0 1"))


def lost(it: Export) -> tuple[str, ...]:
    """What the file cannot hold."""
    loop = (
        "MuJoCo's weld is soft: with masses and time step of this file it gives less than 1e-6 of what a bar gives.",
    )
    return (
        *lost_by_mechanism(it),
        f"Masses ({MASS:g} kg a body) and inertias are placeholders; there is no gravity and no damping.",
        "Rotations are three hinges in turn: a rotation vector only while they are small.",
        *(loop if it.linkage else ()),
    )


def files(it: Export, out: Path) -> dict[Path, bytes]:
    """One file."""
    root = Tree.Element("mujoco", model=out.stem)
    root.append(Tree.Comment("\n" + "\n".join(_plain(head(it, UNITS, lost(it)))) + "\n"))
    Tree.SubElement(root, "compiler", angle="radian")
    step = _step(it.bars)
    Tree.SubElement(root, "option", gravity="0 0 0", timestep=_text([step]), integrator="implicitfast")
    world, tendons = Tree.SubElement(root, "worldbody"), Tree.SubElement(root, "tendon")
    if it.linkage is None:
        for number, bar in enumerate(it.bars, 1):
            base = Tree.SubElement(world, "body", name=f"bar_{number}")
            _elastic(base, tendons, bar, number)
    else:
        _linkage(root, world, tendons, it.linkage, step)
    Tree.indent(root)
    return {out: Tree.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"}


def _linkage(
    root: Tree.Element, world: Tree.Element, tendons: Tree.Element, it: Linkage, step: float
) -> None:
    """Ground, hinge, bar, spring at its tip, hinge, platform; bar 2 ends in a body that is welded to the platform."""
    rows = zip(it.bars, it.bases, it.tips, it.angles, strict=True)
    for number, (bar, base, tip, angle) in enumerate(rows, 1):
        body = Tree.SubElement(
            world, "body", name=f"bar_{number}", pos=_text(METRE * base), quat=_about_y(angle)
        )
        _inertial(body, bar)
        _hinge(body, f"base_hinge_{number}")
        end = _elastic(body, tendons, bar, number)
        # The axes of the platform are those of the base frame.
        name = "platform" if number == 1 else "platform_of_bar_2"
        platform = Tree.SubElement(end, "body", name=name, quat=_about_y(-angle))
        _inertial(platform, bar)
        _hinge(platform, f"tip_hinge_{number}")
        Tree.SubElement(
            platform, "site", name=f"{name}_point", pos=_text(METRE * (it.point - tip)), size="0.002"
        )
    stiffness = (WELD_STEPS * step) ** -2
    Tree.SubElement(
        Tree.SubElement(root, "equality"),
        "weld",
        body1="platform",
        body2="platform_of_bar_2",
        solref=_text([-stiffness, -2.0 * np.sqrt(stiffness)]),
        solimp=f"{WELD_IMPEDANCE} {WELD_IMPEDANCE} 0.001",
    )


def _elastic(body: Tree.Element, tendons: Tree.Element, bar: Spring, number: int) -> Tree.Element:
    """The body at the tip of a bar, with its six joints, and the tendons that hold it."""
    tip = Tree.SubElement(body, "body", name=f"tip_{number}", pos=_text([METRE * bar.length, 0.0, 0.0]))
    _inertial(tip, bar)
    joints = []
    for kind, turn in (("slide", ""), ("hinge", "r")):
        for axis, along in _AXES:
            joints.append(f"tip_{number}_{turn}{axis}")
            Tree.SubElement(tip, "joint", name=joints[-1], type=kind, axis=along)
    line = _text([0.0, 0.0, 0.0, METRE * bar.length, 0.0, 0.0])
    Tree.SubElement(
        body, "geom", type="capsule", fromto=line, size="0.003", contype="0", conaffinity="0", mass="0"
    )
    Tree.SubElement(tip, "site", name=f"tip_{number}_point", size="0.002")
    for k, (stiffness, direction) in enumerate(si.terms(bar), 1):
        tendon = Tree.SubElement(
            tendons, "fixed", name=f"spring_{number}_{k}", stiffness=_text([stiffness]), springlength="0"
        )
        for joint, value in zip(joints, direction, strict=True):
            if value:
                Tree.SubElement(tendon, "joint", joint=joint, coef=_text([value]))
    return tip


def _hinge(body: Tree.Element, name: str) -> None:
    Tree.SubElement(body, "joint", name=name, type="hinge", axis="0 1 0")


def _inertial(body: Tree.Element, bar: Spring) -> None:
    inertia = MASS * (METRE * bar.length) ** 2
    Tree.SubElement(body, "inertial", pos="0 0 0", mass=_text([MASS]), diaginertia=_text([inertia] * 3))


def _step(bars: Sequence[Spring]) -> float:
    """s: a part of a radian of the fastest vibration of a tip by itself."""
    stiffest = max(stiffness for bar in bars for stiffness, _ in si.terms(bar))
    return float(np.sqrt(MASS / stiffest) / STEPS)


def _about_y(angle: float) -> str:
    """The quaternion, scalar first."""
    return _text([np.cos(0.5 * angle), 0.0, np.sin(0.5 * angle), 0.0])


def _text(values: Array | Sequence[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _plain(lines: Sequence[str]) -> Iterator[str]:
    """Lines that may stand in a comment of XML, which has no two dashes in a row."""
    for line in lines:
        yield line.replace("--", "- -")
