"""Sweeps: the same file however it is computed, interrupted or not; what a point is, reached or not."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pipeline.errors import InputError
from pipeline.executors import Serial, executor
from pipeline.manipulator.description import Description, describe, read
from pipeline.manipulator.grid import Grid
from pipeline.manipulator.mapping import coarse, critical_at, critical_map
from pipeline.manipulator.question import FOUND, REST, SINGULAR, UNREACHED
from pipeline.manipulator.sweep import HEAD, RESULT, sweep
from pipeline.manipulator.table import measured, vjm_stiffness
from tests.pipeline.manipulator.test_description import OTHER

GRID = Grid((-60.0, -60.0, -60.0), (60.0, 60.0, 60.0), (4, 4, 3))


class Killed(Serial):
    """Dies at the call with this number."""

    def __init__(self, at: int) -> None:
        self.left = at

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        self.left -= 1
        if self.left < 0:
            raise KeyboardInterrupt
        return super().submit(fn, *args, **kwargs)


@pytest.fixture(scope="module")
def orthoglide() -> Description:
    return read("orthoglide")


@pytest.fixture(scope="module")
def whole(orthoglide: Description, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("whole")
    done = sweep(orthoglide, GRID, folder, Serial(), chunk=10)
    assert (done.computed, done.found, done.postures) == (5, 0, GRID.size)
    return folder


def test_every_point_is_what_one_point_is(whole: Path) -> None:
    values = np.load(whole / RESULT)
    assert values.shape == (GRID.size, len(REST))
    np.testing.assert_array_equal(values[:, :3], GRID.points(0, GRID.size))
    assert np.all(values[:, 3] == FOUND)
    manipulator = read("orthoglide").manipulator
    for row in values[::17]:
        tran, rot = measured(vjm_stiffness(manipulator, row[:3]))
        assert row[4] <= tran <= row[5] and row[6] <= rot <= row[7]
        assert 5e3 < row[8] < 1e4 and row[9] in (0, 1, 2)


def test_killed_and_resumed_is_the_same_file(orthoglide: Description, whole: Path, tmp_path: Path) -> None:
    nodes = -(-coarse(GRID).size // 5)
    with pytest.raises(KeyboardInterrupt):
        sweep(orthoglide, GRID, tmp_path, Killed(nodes + 3), chunk=10)
    assert not (tmp_path / RESULT).exists()
    again = sweep(orthoglide, GRID, tmp_path, Serial(), chunk=10)
    assert again.computed + again.found == 5 and 0 < again.found < 5
    # The last chunk, of eight points, was not there yet.
    assert again.postures == 10 * again.computed - 2
    assert (tmp_path / RESULT).read_bytes() == (whole / RESULT).read_bytes()
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(p.name for p in whole.iterdir())
    assert sweep(orthoglide, GRID, tmp_path, Killed(0), chunk=10).computed == 0


def test_two_processes_write_the_same_file(orthoglide: Description, whole: Path, tmp_path: Path) -> None:
    with executor(workers=2) as (pool, count):
        assert count == 2
        sweep(orthoglide, GRID, tmp_path, pool, count, chunk=10)
    assert (tmp_path / RESULT).read_bytes() == (whole / RESULT).read_bytes()


def test_a_dask_cluster_writes_the_same_file(orthoglide: Description, whole: Path, tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    with executor(workers=2, dask="local") as (pool, count):
        sweep(orthoglide, GRID, tmp_path, pool, count, chunk=10)
    assert (tmp_path / RESULT).read_bytes() == (whole / RESULT).read_bytes()


def test_a_folder_of_another_sweep_is_refused(orthoglide: Description, whole: Path) -> None:
    before = (whole / HEAD).read_bytes()
    with pytest.raises(InputError, match="is of another sweep"):
        sweep(orthoglide, Grid(GRID.low, GRID.high, (4, 4, 4)), whole, Killed(0), chunk=10)
    assert (whole / HEAD).read_bytes() == before


def test_points_out_of_reach_are_marked(orthoglide: Description, tmp_path: Path) -> None:
    done = sweep(orthoglide, Grid((0.0, 0.0, 0.0), (0.0, 0.0, 320.0), (1, 1, 3)), tmp_path, Serial())
    assert done.values[:, 3].tolist() == [FOUND, FOUND, UNREACHED]
    assert not done.values[2, 4:].any()


def test_an_arm_that_moves_without_load_is_marked(tmp_path: Path) -> None:
    """Without a warning, too: a leg of one spring leaves five motions free."""
    arm = describe(OTHER, "other.toml")
    done = sweep(arm, Grid((0.0, 0.0, 50.0), (100.0, 0.0, 50.0), (2, 1, 1)), tmp_path, Serial())
    assert done.values[:, 3].tolist() == [UNREACHED, SINGULAR]
    assert not done.values[:, 4:].any()


def test_critical_forces_between_nodes(orthoglide: Description) -> None:
    """The coarse map is interpolated: at points off its nodes it meets the direct figure to 0.5 %."""
    nodes = coarse(Grid(GRID.low, GRID.high, (40, 40, 40)))
    assert nodes.counts == (5, 5, 5)
    points = np.array([[15.0, -15.0, 45.0], [-45.0, 44.0, 16.0]])
    force = critical_at(orthoglide.manipulator, nodes.points(0, nodes.size))
    found = critical_map(nodes, force).at(points)
    np.testing.assert_allclose(found, critical_at(orthoglide.manipulator, points), rtol=5e-3)


def test_a_grid_of_a_million_points_is_only_its_edges() -> None:
    grid = Grid((0.0, 0.0, 0.0), (99.0, 99.0, 99.0), (100, 100, 100))
    assert grid.size == 10**6
    np.testing.assert_allclose(grid.points(999_998, 10**6), [[99.0, 99.0, 98.0], [99.0, 99.0, 99.0]])


@pytest.mark.parametrize(
    ("low", "high", "counts", "said"),
    [
        (0.0, -1.0, 2, "a lower and a higher edge"),
        (0.0, np.inf, 2, "a lower and a higher edge"),
        (0.0, 1.0, 0, "0 points, allowed are 1 or more"),
        (0.0, 1.0, 10_000, "points, allowed are up to"),
    ],
)
def test_bad_grids(low: float, high: float, counts: int, said: str) -> None:
    with pytest.raises(InputError, match=said):
        Grid((low,) * 3, (high,) * 3, (counts,) * 3)


def test_bad_executors() -> None:
    with pytest.raises(InputError, match="workers is 0"), executor(0):
        pass
