"""URDF: links and joints alone; the stiffness stands in a .json beside it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree as Tree

import numpy as np

from pipeline.export.content import Export, Linkage, head, lost_by_mechanism
from pipeline.export.formats import json
from pipeline.export.si import METRE
from pipeline.export.si import UNITS as LENGTHS
from vjm.frames import Array

ONE = True
UNITS = f"{LENGTHS} The .json beside it: N, mm, rad."


def lost(it: Export) -> tuple[str, ...]:
    """What the file cannot hold."""
    said = ["Not in the .urdf: stiffness, masses and inertias; the .json beside it has the stiffness."]
    if it.linkage is not None:
        said.append(
            "URDF holds no loop: the base hinge of bar 1 drives the others as mimic joints, which for rigid bars of "
            "equal length is the same motion."
        )
        first, second = (bar.length for bar in it.linkage.bars)
        if first != second:
            said.append(
                f"The bars differ ({first:.9g} and {second:.9g} mm): the loop is closed at this angle alone."
            )
    return (*lost_by_mechanism(it), *said)


def files(it: Export, out: Path) -> dict[Path, bytes]:
    """Two files. ValueError for a name that the .json needs itself."""
    beside = out.with_suffix(".json")
    if beside == out:
        beside = out.with_name(f"{out.stem}_stiffness.json")
    robot = Tree.Element("robot", name=out.stem or "parastiff")
    lines = (*head(it, UNITS, lost(it)), f"Stiffness: {beside.name}")
    robot.append(Tree.Comment("\n" + "\n".join(line.replace("--", "- -") for line in lines) + "\n"))
    Tree.SubElement(robot, "link", name="base")
    if it.linkage is None:
        for number, bar in enumerate(it.bars, 1):
            _link(robot, f"bar_{number}", bar.length)
            _joint(robot, f"base_{number}", "fixed", ("base", f"bar_{number}"), np.zeros(3))
            Tree.SubElement(robot, "link", name=f"tip_{number}")
            _joint(robot, f"end_{number}", "fixed", (f"bar_{number}", f"tip_{number}"), bar.point)
    else:
        _linkage(robot, it.linkage)
    Tree.indent(robot)
    text = Tree.tostring(robot, encoding="utf-8", xml_declaration=True) + b"\n"
    return {out: text, **json.files(it, beside)}


def _linkage(robot: Tree.Element, it: Linkage) -> None:
    """The tree that remains when bar 2 is taken off the platform; joints at zero are the linkage at its angle."""
    for number, (base, spring, angle) in enumerate(zip(it.bases, it.bars, it.angles, strict=True), 1):
        bar, end = f"bar_{number}", "platform_hinge" if number == 1 else "end_of_bar_2"
        _link(robot, bar, spring.length)
        hinge = _joint(robot, f"base_hinge_{number}", "continuous", ("base", bar), base, angle)
        if number == 2:
            _mimic(hinge, 1.0)
        Tree.SubElement(robot, "link", name=end)
        _mimic(_joint(robot, f"tip_hinge_{number}", "continuous", (bar, end), spring.point, -angle), -1.0)
        if number == 1:
            Tree.SubElement(robot, "link", name="platform")
            _joint(robot, "platform_point", "fixed", (end, "platform"), it.point - it.tips[0])


def _link(robot: Tree.Element, name: str, length: float) -> None:
    """A bar along x, drawn as a cylinder."""
    visual = Tree.SubElement(Tree.SubElement(robot, "link", name=name), "visual")
    middle = _text([0.5 * METRE * length, 0.0, 0.0])
    Tree.SubElement(visual, "origin", xyz=middle, rpy=_text([0.0, 0.5 * np.pi, 0.0]))
    shape = Tree.SubElement(visual, "geometry")
    Tree.SubElement(shape, "cylinder", length=_text([METRE * length]), radius="0.003")


def _joint(
    robot: Tree.Element, name: str, kind: str, links: tuple[str, str], place: Array, turn: float = 0.0
) -> Tree.Element:
    """A joint about y from a parent to a child, at a place, mm, and an angle about y, rad, of the parent's frame."""
    joint = Tree.SubElement(robot, "joint", name=name, type=kind)
    Tree.SubElement(joint, "origin", xyz=_text(METRE * place), rpy=_text([0.0, turn, 0.0]))
    Tree.SubElement(joint, "parent", link=links[0])
    Tree.SubElement(joint, "child", link=links[1])
    if kind != "fixed":
        Tree.SubElement(joint, "axis", xyz="0 1 0")
    return joint


def _mimic(joint: Tree.Element, multiplier: float) -> None:
    Tree.SubElement(joint, "mimic", joint="base_hinge_1", multiplier=repr(multiplier), offset="0.0")


def _text(values: Array | Sequence[float]) -> str:
    return " ".join(repr(float(value)) for value in values)
