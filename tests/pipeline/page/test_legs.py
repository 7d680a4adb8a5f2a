"""The legs of a manipulator on a page stand where its finite elements have their beams, and follow its platform."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.campaign import ManipulatorRig
from pipeline.manipulator.description import read
from pipeline.manipulator.frame import frame_of
from pipeline.page.legs import lines_of
from pipeline.page.record import Line
from reports.campaign.linkage import lines
from vjm.manipulator.posture import postures

ROUNDED = 1e-4
"""mm: what a page keeps of a place."""


def drawn_at(point: tuple[float, float, float]) -> tuple[Line, ...]:
    manipulator = read("orthoglide").manipulator
    return lines_of(ManipulatorRig(length=manipulator.length, manipulator=manipulator, at=point).legs)


@pytest.mark.parametrize("point", [(0.0, 0.0, 0.0), (50.0, -40.0, 60.0)])
def test_every_beam_of_the_frame_is_drawn(point: tuple[float, float, float]) -> None:
    manipulator = read("orthoglide").manipulator
    found = postures(manipulator, np.array(point))
    frame = frame_of(manipulator, found.pose, found.coordinates)
    drawn = np.array([line.points for line in drawn_at(point)], dtype=float)
    assert len(frame.beams) == 9
    for beam in frame.beams:
        ends = frame.positions[[beam.base, beam.tip]]
        assert np.abs(drawn - ends).max(axis=(1, 2)).min() < ROUNDED


def test_feet_stay_and_tips_move_as_one_body_with_the_platform() -> None:
    every = drawn_at((50.0, -40.0, 60.0))
    rig = {
        "kind": "manipulator",
        "length_mm": 310.0,
        "place_mm": [50.0, -40.0, 60.0],
        "lines": [line.model_dump() for line in every],
    }
    pose = [0.1, 0.2, -0.3, 0.0, 0.0, 0.01]
    moved = lines({"rig": rig, "q_deg": 0.0}, pose, 10.0)
    assert len(moved) == len(every) + 3
    turn = np.array([[np.cos(0.1), -np.sin(0.1), 0.0], [np.sin(0.1), np.cos(0.1), 0.0], [0.0, 0.0, 1.0]])
    at = np.array([50.0, -40.0, 60.0])
    seen = set()
    for line, now in zip(every, moved, strict=False):
        for point, share, end in zip(line.points, line.share, now, strict=True):
            was = np.array(point, dtype=float)
            whole = at + np.array([1.0, 2.0, -3.0]) + turn @ (was - at)
            np.testing.assert_allclose(end, was + share * (whole - was), atol=1e-9)
            seen.add(share)
    # Feet up to the first passive joint, and hinges at the platform; nothing lies between them on this one.
    assert seen == {0.0, 1.0}
