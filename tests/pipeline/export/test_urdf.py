"""URDF read back by a reader of XML alone: where its links stand, against the virtual springs' linkage."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.pipeline.export.sources import KEPT, LENGTH, UNEQUAL, WIDTH, campaign, written
from vjm import paper
from vjm.equilibrium import unloaded
from vjm.mechanisms.parallelogram import Parallelogram


def vector(text: str) -> np.ndarray:
    return np.array([float(value) for value in text.split()])


def placed(path: Path, driven: float = 0.0) -> dict[str, np.ndarray]:
    """(4, 4) of every link, m, when the joint that others mimic is turned by an angle, rad."""
    robot = ElementTree.parse(path).getroot()
    joints = robot.findall("joint")
    links = {link.attrib["name"] for link in robot.findall("link")}
    children = {joint.find("child").attrib["link"] for joint in joints}  # type: ignore[union-attr]
    (root,) = links - children
    assert len(children) == len(joints) == len(links) - 1, "a tree"
    out = {root: np.eye(4)}
    while len(out) < len(links):
        for joint in joints:
            parent, child = (joint.find(end).attrib["link"] for end in ("parent", "child"))  # type: ignore[union-attr]
            if parent not in out or child in out:
                continue
            origin, mimic, axis = (joint.find(name) for name in ("origin", "mimic", "axis"))
            assert origin is not None
            here = np.eye(4)
            here[:3, 3] = vector(origin.attrib["xyz"])
            # Fixed axes: roll, pitch, yaw.
            here[:3, :3] = Rotation.from_euler("xyz", vector(origin.attrib["rpy"])).as_matrix()
            if axis is not None:
                factor = 1.0
                if mimic is not None:
                    assert mimic.attrib["joint"] == "base_hinge_1" and float(mimic.attrib["offset"]) == 0.0
                    factor = float(mimic.attrib["multiplier"])
                turned = Rotation.from_rotvec(factor * driven * vector(axis.attrib["xyz"])).as_matrix()
                here[:3, :3] = here[:3, :3] @ turned
            out[child] = out[parent] @ here
    return out


@pytest.mark.parametrize("q", [0.0, 30.0, -47.0])
def test_forward_kinematics(q: float, tmp_path: Path) -> None:
    """At the angle of the file and driven away from it the platform is that of the linkage, and the loop is closed."""
    _, (path, _) = written(KEPT, "urdf", tmp_path / "out.urdf", q)
    for driven in (0.0, 0.4, -0.7):
        at = placed(path, driven)
        wanted = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, q=np.radians(q) + driven).unloaded_pose
        np.testing.assert_allclose(1e3 * at["platform"][:3, 3], wanted[:3], atol=1e-10)
        np.testing.assert_allclose(at["platform"][:3, :3], np.eye(3), atol=1e-14)
        second = 1e3 * at["end_of_bar_2"][:3, 3] - [0.0, 0.0, 0.5 * WIDTH]
        np.testing.assert_allclose(second, wanted[:3], atol=1e-10)


def test_bars_of_different_length_meet_at_their_angle(tmp_path: Path) -> None:
    it, (path, _) = written(
        campaign(tmp_path / "bench", effects=UNEQUAL), "urdf", tmp_path / "out.urdf", 30.0
    )
    at = placed(path)
    # The linkage of the virtual springs, with its bars as they are, without load: the platform tilts.
    drawn = Parallelogram(
        LENGTH,
        WIDTH,
        it.bars[1].matrix,
        q=np.radians(30.0),
        alterations=(lambda k, link: link.lengthened(3.0 - 3.0 * k),),
    )
    pose = unloaded(drawn).pose
    assert abs(pose[4]) > 0.03
    np.testing.assert_allclose(1e3 * at["platform"][:3, 3], pose[:3], atol=1e-9)
    tip = 1e3 * at["end_of_bar_2"][:3, 3]
    half = Rotation.from_rotvec(pose[3:]).apply([0.0, 0.0, 0.5 * WIDTH])
    np.testing.assert_allclose(tip, pose[:3] + half, atol=1e-9)
    assert "at this angle alone" in path.read_text()


def test_a_bar_and_the_stiffness_beside_it(tmp_path: Path) -> None:
    it, (path, beside) = written(campaign(tmp_path / "bench", "bar"), "urdf", tmp_path / "out.urdf")
    np.testing.assert_allclose(1e3 * placed(path)["tip_1"][:3, 3], [LENGTH, 0.0, 0.0], atol=1e-12)
    assert beside == tmp_path / "out.json"
    (stiffness,) = json.loads(beside.read_text())["stiffness"]
    np.testing.assert_array_equal(stiffness["matrix"], it.bars[0].matrix)
    assert "Stiffness: out.json" in path.read_text()
    # A robot that is to be called .json itself does not swallow its stiffness.
    assert {p.name for p in written(KEPT, "urdf", tmp_path / "own.json")[1]} == {
        "own.json",
        "own_stiffness.json",
    }
