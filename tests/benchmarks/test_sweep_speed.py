"""Rate of a sweep of 100 000 postures, and two workers against one. Off by default; wants an idle machine."""

from __future__ import annotations

import os
import resource
import time
from pathlib import Path

import pytest

from pipeline.manipulator.description import read
from pipeline.manipulator.grid import Grid
from pipeline.manipulator.sweep import RESULT, sweep
from pipeline.pools import pool

pytestmark = pytest.mark.long

GRID = Grid((-80.0,) * 3, (80.0,) * 3, (47, 47, 46))


def busy() -> bool:
    """Whether something else computes here: then two workers cannot show what they are worth."""
    return os.getloadavg()[0] > 0.5 or (os.cpu_count() or 1) < 2


def seconds(folder: Path, workers: int) -> float:
    """Of one sweep into an empty folder, the start of the workers included."""
    start = time.perf_counter()
    with pool(workers) as computed:
        sweep(read("orthoglide"), GRID, folder, computed)
    return time.perf_counter() - start


@pytest.mark.skipif(busy(), reason="wants two idle cores")
def test_two_workers_and_memory(tmp_path: Path) -> None:
    """Best of two each, interleaved; a worker holds a chunk at a time, whatever the size of the grid."""
    runs = [(w, seconds(tmp_path / f"{w}-{run}", w)) for run in range(2) for w in (1, 2)]
    one, two = (min(spent for w, spent in runs if w == workers) for workers in (1, 2))
    largest = max(
        resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    print(f"{GRID.size / one:.0f} postures a second, two workers x{one / two:.2f}, {largest / 1024:.0f} MB")
    assert (tmp_path / "1-0" / RESULT).read_bytes() == (tmp_path / "2-0" / RESULT).read_bytes()
    assert one / two > 1.7
    assert largest < 500 * 1024
