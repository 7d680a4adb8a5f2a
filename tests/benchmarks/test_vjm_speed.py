"""Equilibria a second on one core, and against a loop of single solves of the same equations.

Off by default. Rates depend on the machine and on what else it does: the best of three runs counts.
"""

from __future__ import annotations

import time
import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import root

from vjm import lagrangian, paper
from vjm.equilibrium import equilibrium
from vjm.mechanism import initial_memory
from vjm.mechanisms.parallelogram import Parallelogram

pytestmark = pytest.mark.long

LINKAGE = Parallelogram(paper.LENGTH, paper.WIDTH, paper.BAR_STIFFNESS, 0.3)


def bench_cases(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Random held and loaded coordinates: 4 kN of tension or 1 kN of compression, turns to 0.06 rad."""
    generator = np.random.default_rng(1)
    held = generator.random((count, 6)) < 0.5
    held[:, 0], held[:, [1, 2]] = False, True
    motion = generator.uniform(-1, 1, (count, 6)) * [0, 6, 10, 0.06, 1e-3, 0.06]
    load = generator.uniform(-1, 1, (count, 6)) * [1, 40, 0, 2e3, 2e3, 4e3]
    load[:, 0] = generator.uniform(-1e3, 4e3, count)
    return np.where(held, LINKAGE.unloaded_pose + motion, load), held


def best(call: Callable[[], object]) -> float:
    """Least seconds of three calls."""
    times = []
    for _ in range(3):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def single(targets: np.ndarray, held: np.ndarray) -> np.ndarray:
    """One load case by scipy on the residual of Eq. 5, with its matrix, from the unloaded state."""
    place = lagrangian.layout(LINKAGE)
    memory, drives = initial_memory(LINKAGE), np.zeros(len(place.drives))

    def residual(scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        unknowns = scaled * place.scale
        chains = lagrangian.all_rows(LINKAGE, unknowns, memory, drives)
        rows = lagrangian.gradient(place, chains, unknowns)
        rows[place.platform] -= np.where(held, 0.0, targets)
        matrix = lagrangian.hessian(place, chains)
        rows, matrix = rows * place.scale / place.energy, place.scale[:, None] * matrix * place.scale
        matrix /= place.energy
        pinned = np.arange(place.size)[place.platform][held]
        rows[pinned] = scaled[pinned] - (targets / place.scale[place.platform])[held]
        matrix[pinned] = np.eye(place.size)[pinned]
        return rows, matrix

    found = root(residual, lagrangian.at_rest(LINKAGE, drives) / place.scale, jac=True, tol=1e-12)
    return np.asarray(found.x * place.scale)[place.platform]


def test_plain_parallelograms() -> None:
    targets, held = bench_cases(20_000)
    state = equilibrium(LINKAGE, targets, held)
    assert np.all(state.converged) and np.all(state.unstable == 0)
    rate = 20_000 / best(lambda: equilibrium(LINKAGE, targets, held))
    print(f"plain parallelogram: {rate:.0f} equilibria a second")
    loop = best(lambda: [single(t, h) for t, h in zip(targets[:60], held[:60], strict=True)]) / 60
    print(f"loop of scipy.optimize.root: {1 / loop:.0f} a second; ratio {rate * loop:.0f}")
    alone = np.stack([single(t, h) for t, h in zip(targets[:60], held[:60], strict=True)])
    np.testing.assert_allclose(alone, state.pose[:60], atol=1e-7)
    assert rate * loop > 50
    assert rate > 10_000


def test_refined_parallelograms_at_bench_accuracy() -> None:
    targets, held = bench_cases(2_000)
    linkage = LINKAGE.refined()
    state = equilibrium(linkage, targets, held)
    fine = equilibrium(LINKAGE.refined(12), targets[:100], held[:100])
    assert np.all(state.converged)
    moved = np.abs(state.pose[:100] - fine.pose)
    assert moved[:, :3].max() < 1e-3 and moved[:, 3:].max() < 20e-6
    assert np.abs(state.load[:100] - fine.load)[:, :3].max() < 1.0
    rate = 2_000 / best(lambda: equilibrium(linkage, targets, held))
    print(f"refined parallelogram: {rate:.0f} equilibria a second")
    assert rate > 1_000


def test_memory_grows_with_the_batch_and_no_faster() -> None:
    peaks = []
    for count in (10_000, 40_000):
        targets, held = bench_cases(count)
        tracemalloc.start()
        equilibrium(LINKAGE, targets, held)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    print(f"peak memory: {peaks[0] / 1e6:.0f} MB for 10 000, {peaks[1] / 1e6:.0f} MB for 40 000")
    assert peaks[1] < 4.4 * peaks[0]
