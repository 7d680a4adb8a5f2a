"""Sweeps: the same file however it is computed, interrupted or not; what a point is, reached or not."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pipeline.errors import InputError
from pipeline.manipulator.description import Description, describe, read
from pipeline.manipulator.grid import Grid
from pipeline.manipulator.mapping import coarse, critical_at, critical_map, mapped
from pipeline.manipulator.question import FOUND, REST, SINGULAR, UNREACHED, Question
from pipeline.manipulator.reasons import no_critical_load, numbers_of, reasons_of
from pipeline.manipulator.sweep import HEAD, RESULT, Sweep, sweep
from pipeline.manipulator.sweep_summary import summary
from pipeline.manipulator.table import measured, vjm_stiffness
from pipeline.pools import Call, pool
from reports.workspace.draw import draw
from tests.pipeline.manipulator.machines import PRS, TRIPTERON
from tests.pipeline.manipulator.test_description import OTHER
from vjm.manipulator import legs
from vjm.manipulator.freedom import LOOSE, RIGID
from vjm.manipulator.legs import UNSOLVED

GRID = Grid((-60.0, -60.0, -60.0), (60.0, 60.0, 60.0), (4, 4, 3))


class Killed:
    """A pool that dies at the call with this number."""

    def __init__(self, at: int) -> None:
        self.left = at

    def __call__(self, calls: Iterable[Call]) -> Iterator[Any]:
        for call in calls:
            self.left -= 1
            if self.left < 0:
                raise KeyboardInterrupt
            yield call()


def said(done: Sweep) -> list[str]:
    """The reason of each point, by the list in the sweep's own file."""
    reasons = json.loads((done.folder / HEAD).read_text(encoding="utf-8"))["reasons"]
    return [reasons[int(number)] for number in done.values[:, done.columns.index("reason")]]


@pytest.fixture(scope="module")
def orthoglide() -> Description:
    return read("orthoglide")


@pytest.fixture(scope="module")
def whole(orthoglide: Description, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("whole")
    done = sweep(orthoglide, GRID, folder, chunk=10)
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


@pytest.mark.long
def test_killed_and_resumed_is_the_same_file(orthoglide: Description, whole: Path, tmp_path: Path) -> None:
    nodes = -(-coarse(GRID).size // 5)
    with pytest.raises(KeyboardInterrupt):
        sweep(orthoglide, GRID, tmp_path, Killed(nodes + 3), chunk=10)
    assert not (tmp_path / RESULT).exists()
    again = sweep(orthoglide, GRID, tmp_path, chunk=10)
    assert again.computed + again.found == 5 and 0 < again.found < 5
    # The last chunk, of eight points, was not there yet.
    assert again.postures == 10 * again.computed - 2
    assert (tmp_path / RESULT).read_bytes() == (whole / RESULT).read_bytes()
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(p.name for p in whole.iterdir())
    assert sweep(orthoglide, GRID, tmp_path, Killed(0), chunk=10).computed == 0


@pytest.mark.long
def test_two_processes_write_the_same_file(orthoglide: Description, whole: Path, tmp_path: Path) -> None:
    with pool(workers=2) as computed:
        sweep(orthoglide, GRID, tmp_path, computed, chunk=10)
    assert (tmp_path / RESULT).read_bytes() == (whole / RESULT).read_bytes()


@pytest.mark.long
def test_a_dask_cluster_writes_the_same_file(orthoglide: Description, whole: Path, tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    with pool(workers=2, dask="local") as computed:
        sweep(orthoglide, GRID, tmp_path, computed, chunk=10)
    assert (tmp_path / RESULT).read_bytes() == (whole / RESULT).read_bytes()


def test_a_folder_of_another_sweep_is_refused(orthoglide: Description, whole: Path) -> None:
    before = (whole / HEAD).read_bytes()
    with pytest.raises(InputError, match="is of another sweep"):
        sweep(orthoglide, Grid(GRID.low, GRID.high, (4, 4, 4)), whole, Killed(0), chunk=10)
    assert (whole / HEAD).read_bytes() == before


def test_points_out_of_reach_are_marked(orthoglide: Description, tmp_path: Path) -> None:
    done = sweep(orthoglide, Grid((0.0, 0.0, 0.0), (0.0, 0.0, 320.0), (1, 1, 3)), tmp_path)
    assert done.values[:, 3].tolist() == [FOUND, FOUND, UNREACHED]
    assert not done.values[2, 4:-1].any()
    assert said(done)[:2] == ["", ""] and "does not reach this pose" in said(done)[2]


def test_an_arm_that_moves_without_load_is_marked(tmp_path: Path) -> None:
    """Without a warning, too: a leg of one spring leaves five motions free."""
    arm = describe(OTHER, "other.toml")
    done = sweep(arm, Grid((0.0, 0.0, 50.0), (100.0, 0.0, 50.0), (2, 1, 1)), tmp_path)
    assert done.values[:, 3].tolist() == [UNREACHED, SINGULAR]
    assert not done.values[:, 4:-1].any()
    assert said(done) == ["leg a does not reach this pose", f"leg a {RIGID}"]


def test_a_machine_of_links_alone_has_a_map(tmp_path: Path) -> None:
    """K_tran of its table, the force over the displacement along it, is the same in all directions of its axes."""
    tripteron = describe(TRIPTERON, "tripteron.toml")
    done = sweep(tripteron, Grid((0.0, 0.0, -1.0), (0.0, 0.0, 1.0), (1, 1, 3)), tmp_path)
    row = dict(zip(done.columns, done.values[1], strict=True))
    compliance = np.linalg.inv(vjm_stiffness(tripteron.manipulator, np.zeros(3)))
    assert row["K_tran_mean"] == pytest.approx(582.348, abs=1e-3)
    np.testing.assert_allclose(1.0 / np.diag(compliance)[:3], row["K_tran_mean"], rtol=1e-9)
    assert said(done) == ["", "", ""] and np.all(np.isfinite(done.values))


def test_a_machine_rigid_in_some_directions_says_so(tmp_path: Path) -> None:
    prs = describe(PRS, "prs.toml")
    done = sweep(prs, Grid((0.0, 0.0, 400.0), (0.0, 1.0, 400.0), (1, 2, 1)), tmp_path)
    assert said(done) == [f"leg a {RIGID}", "leg a does not reach this pose"]
    assert not draw(tmp_path)
    assert any(RIGID in line for line in summary(done, 1.0))


def test_a_leg_without_a_critical_load_is_a_reason(orthoglide: Description, tmp_path: Path) -> None:
    """The map keeps its other numbers; a leg that has a load near one end only has it there only."""
    whole = orthoglide.manipulator
    names = [leg.name for leg in whole.legs]
    (why,) = numbers_of([no_critical_load(names[1], LOOSE)], reasons_of(whole))
    nodes = Grid((-40.0, 0.0, 0.0), (40.0, 0.0, 0.0), (2, 1, 1))
    force, reason = critical_at(whole, nodes.points(0, 2))
    force[1, 1], reason[1, 1] = np.nan, why
    rows = mapped(whole, Question(), critical_map(whole, nodes, force, reason), nodes.points(0, 2))
    by_name = {name: rows[:, k] for k, name in enumerate(REST)}
    assert by_name["state"].tolist() == [FOUND, FOUND] and np.all(by_name["K_tran_min"] > 0.0)
    assert np.isfinite(by_name["critical_N"][0]) and np.isnan(by_name["critical_N"][1])
    assert by_name["leg"][1] == -1.0 and by_name["reason"].tolist() == [0.0, why]


def test_singular_equations_of_buckling_end_no_sweep(
    orthoglide: Description, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All critical loads missing: rows, sentences and pictures are there all the same."""

    def singular(*_: object) -> None:
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr(legs, "linear_path", singular)
    done = sweep(orthoglide, Grid((-9.0, -9.0, 0.0), (9.0, 9.0, 0.0), (2, 2, 1)), tmp_path)
    assert np.all(done.values[:, 3] == FOUND) and np.all(np.isnan(done.values[:, REST.index("critical_N")]))
    assert set(said(done)) == {no_critical_load("x", UNSOLVED)}
    lines = summary(done, 1.0)
    assert f"at 4 of 4 postures: {no_critical_load('x', UNSOLVED)}" in lines
    assert "force that makes a leg buckle: at no posture" in lines
    assert [path.name for path in draw(tmp_path)] == ["slices.png"]


def test_every_reason_has_a_number(orthoglide: Description) -> None:
    """No two sentences of a machine are the same, and one that is not foreseen is the last."""
    reasons = reasons_of(orthoglide.manipulator)
    assert len(set(reasons)) == len(reasons) and reasons[0] == ""
    assert numbers_of(reasons, reasons).tolist() == list(range(len(reasons)))
    assert numbers_of(["news"], reasons).tolist() == [len(reasons) - 1]


@pytest.mark.long
def test_critical_forces_between_nodes(orthoglide: Description) -> None:
    """The coarse map is interpolated: at points off its nodes it meets the direct figure to 0.5 %."""
    nodes = coarse(Grid(GRID.low, GRID.high, (40, 40, 40)))
    assert nodes.counts == (5, 5, 5)
    points = np.array([[15.0, -15.0, 45.0], [-45.0, 44.0, 16.0]])
    whole = orthoglide.manipulator
    found, reason = critical_map(whole, nodes, *critical_at(whole, nodes.points(0, nodes.size))).at(points)
    np.testing.assert_allclose(found, critical_at(whole, points)[0], rtol=5e-3)
    assert not reason.any()


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


def test_bad_pools() -> None:
    with pytest.raises(InputError, match="workers is 0"), pool(0):
        pass
