"""The linkage as lines: in its place unloaded, moved as its platform is, and by as much as can be seen."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reports.campaign.linkage import SHARE, lines, scale_of

LENGTH, WIDTH = 310.0, 80.0


def loaded(kind: str, q_deg: float, poses: list[list[float | None]]) -> dict[str, Any]:
    width = WIDTH if kind == "parallelogram" else None
    rig = {"kind": kind, "length_mm": LENGTH, "width_mm": width}
    return {"rig": rig, "q_deg": q_deg, "measured_pose": poses}


def test_unloaded_it_stands_where_the_conventions_say() -> None:
    """Platform point at (L cos q, 0, -L sin q), bar 1 at z = -d/2 from there."""
    one, two, platform = lines(loaded("parallelogram", 30.0, []), None, 1.0)
    point = np.array([LENGTH * np.cos(np.pi / 6), 0.0, -LENGTH / 2])
    np.testing.assert_allclose(platform.mean(axis=0), point, atol=1e-9)
    np.testing.assert_allclose(one[[0, -1]], [[0, 0, -WIDTH / 2], point - [0, 0, WIDTH / 2]], atol=1e-9)
    np.testing.assert_allclose(two - one, np.tile([0.0, 0.0, WIDTH], (len(one), 1)), atol=1e-9)


def test_bars_leave_the_base_along_themselves_and_reach_the_moved_platform() -> None:
    """Guided sideways: clamped at both ends, so half of the travel in the middle and no slope at either end."""
    one, _, platform = lines(loaded("parallelogram", 0.0, []), [0.0, 2.0, 0.0, 0.0, 0.0, 0.0], 5.0)
    assert one[-1].tolist() == platform[0].tolist() and one[-1, 1] == pytest.approx(10.0)
    assert one[len(one) // 2, 1] == pytest.approx(5.0)
    slopes = np.gradient(one[:, 1], one[:, 0], edge_order=2)
    assert abs(slopes[[0, -1]]).max() < 0.02 * slopes.max()


def test_a_turned_platform_takes_the_bar_with_it() -> None:
    (bar,) = lines(loaded("bar", 0.0, []), [0.0, 0.0, 0.0, 0.0, 0.0, 0.01], 10.0)
    slopes = np.gradient(bar[:, 1], bar[:, 0], edge_order=2)
    assert slopes[-1] == pytest.approx(np.sin(0.1), rel=0.05) and abs(slopes[0]) < 0.005


def test_what_is_not_measured_does_not_move() -> None:
    (bar,) = lines(loaded("bar", 0.0, []), [None] * 6, 100.0)
    assert abs(bar[:, 1:]).max() == 0.0


def test_a_platform_is_a_cross_where_it_stands() -> None:
    rig = {"kind": "manipulator", "length_mm": LENGTH, "place_mm": [5.0, 0.0, 0.0], "lines": []}
    arms = lines({"rig": rig, "q_deg": 0.0}, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 3.0)
    assert len(arms) == 3 and all(arm.mean(axis=0).tolist() == [8.0, 0.0, 0.0] for arm in arms)


@pytest.mark.parametrize("largest", [1e-4, 0.02, 0.9, 6.0, 500.0])
def test_the_scale_is_round_and_shows_the_largest_displacement(largest: float) -> None:
    scale = scale_of(loaded("parallelogram", 0.0, [[0.1 * largest] * 3 + [None] * 3, [largest] + [0.0] * 5]))
    assert float(f"{scale:.0e}") == scale and f"{scale:.0e}"[0] in "125"
    shown = scale * largest
    assert scale == 1.0 or SHARE * LENGTH / 2.5 <= shown <= SHARE * LENGTH
