"""Random mixed-control load cases to 80 % of the critical load: all solved, balanced, reciprocal, reproducible."""

from __future__ import annotations

from dataclasses import dataclass
from typing import get_args

import numpy as np
import pytest

from tests.vjm.load_paths import load_path
from tests.vjm.strategies import LENGTH, WIDTH
from vjm import paper
from vjm.equilibrium import Equilibrium, equilibrium, unloaded
from vjm.lumped import SpringAt
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.refined import Refined
from vjm.sensitivity import by_targets
from vjm.stability import reduced_modes

# Displacements and loads of the paper's linkage on its bench.
MOTION = np.array([0.05, 3.0, 6.0, 0.02, 5e-4, 0.02])
LOAD = np.array([4e3, 60.0, 200.0, 2e3, 2e4, 5e3])
FACTORS = np.geomspace(0.02, 4.0, 24)


def random_linkage(generator: np.random.Generator) -> Parallelogram:
    """K_b within a factor 3 of Eq. 12, couplings of either sign, q within 60 degrees, a third refined.

    The others have their springs at the tip, in the middle or at the base.
    """
    scale = 3.0 ** generator.uniform(-1, 1, 6)
    k = np.diag(scale * np.diag(paper.BAR_STIFFNESS))
    for i, j in ((1, 5), (2, 4)):
        k[i, j] = k[j, i] = generator.uniform(-0.9, 0.9) * np.sqrt(k[i, i] * k[j, j])
    bar = Refined(int(generator.integers(1, 5))) if generator.random() < 1 / 3 else None
    place = generator.choice(get_args(SpringAt))
    q = generator.uniform(-np.pi / 3, np.pi / 3)
    return Parallelogram(LENGTH, WIDTH, k, q, spring_at=place, bar=bar)


@dataclass(frozen=True)
class Cases:
    """Load cases of one linkage: held (B, 6), and targets (B, 6) as unloaded plus change."""

    linkage: Parallelogram
    held: np.ndarray
    change: np.ndarray

    def targets(self, factor: np.ndarray) -> np.ndarray:
        """Targets at a share (..., B) of the change."""
        return np.where(self.held, self.linkage.unloaded_pose, 0.0) + factor[..., None] * self.change


def random_cases(generator: np.random.Generator, count: int) -> Cases:
    """Random masks that leave no motion free of stiffness, random directions, 80 % or less of the critical.

    The critical share is met by a ramp in 24 steps: the last one before a step that is unstable, has no
    equilibrium, or turns the platform by more than 0.3 rad.
    """
    linkage = random_linkage(generator)
    held = generator.random((4 * count, 6)) < 0.5
    held = held[[stiff(linkage, mask) for mask in held]][:count]
    change = generator.uniform(-1, 1, held.shape) * np.where(held, MOTION, LOAD)
    cases = Cases(linkage, held, change)
    ramp = cases.targets(np.repeat(FACTORS[:, None], len(held), axis=1))
    path = load_path(linkage, ramp, held, follow=True)
    sound = path.converged & (path.unstable <= 0) & (np.max(np.abs(path.pose[..., 3:]), axis=-1) < 0.3)
    steps = np.sum(np.cumprod(sound, axis=0), axis=0)
    last = np.where(steps > 0, FACTORS[np.maximum(steps, 1) - 1], 0.0)
    use = steps > 0
    share = (0.8 * last * generator.uniform(0.3, 1.0, last.size))[use]
    cases = Cases(linkage, held[use], change[use] * share[:, None])
    # A coarse ramp may step over a critical load; a fine one from rest to the load chosen tells.
    fine = cases.targets(np.repeat(np.linspace(0, 1, 26)[:, None], len(cases.held), axis=1))
    path = load_path(linkage, fine, cases.held, follow=True)
    stays = np.all(path.converged & (path.unstable <= 0), axis=0) & continuous(path, cases.change / 25)
    return Cases(linkage, cases.held[stays], cases.change[stays])


def continuous(path: Equilibrium, change: np.ndarray) -> np.ndarray:
    """(B,) whether the steps of a path (S, B) follow its slopes: past a critical load they jump."""
    slope = np.einsum("...ij,...j->...i", by_targets(path).pose, np.broadcast_to(change, path.pose.shape))
    size = np.repeat([1.0, LENGTH], 3)
    steps, mean = np.diff(path.pose, axis=0) * size, 0.5 * (slope[1:] + slope[:-1]) * size
    error, total = np.abs(steps - mean).max(axis=-1), np.abs(steps).max(axis=-1) + 1e-6
    return np.asarray(np.all(error < 0.1 * total, axis=0))


def stiff(linkage: Parallelogram, mask: np.ndarray) -> bool:
    if mask.all():
        return True
    values = reduced_modes(unloaded(linkage), mask).values
    return bool(values[0] > 1e-7 * values[-1])


def check(cases: Cases, state: Equilibrium) -> None:
    assert np.all(state.converged), np.unique(state.reason[~state.converged])
    assert np.all(state.unstable <= 0)
    at_end = np.where(cases.held, state.pose, state.load)
    targets = cases.targets(np.ones(len(cases.held)))
    scale = np.maximum(np.where(cases.held, MOTION, LOAD), np.abs(targets))
    # Solving once more from the state leaves its residual unchanged: it is the one of the state.
    again = equilibrium(cases.linkage, targets, cases.held, state, limit=1, tolerance=1e-9)
    assert np.max(np.abs(at_end - targets) / scale) < 1e-8
    assert np.max(again.residual) < 1e-12


def check_reciprocity(state: Equilibrium) -> None:
    """With s = 1 for free and -1 for held coordinates, diag(s) d(output)/d(target) is symmetric."""
    change = by_targets(state)
    response = np.where(state.held[..., None], -change.load, change.pose)
    # A unit of each target that makes all entries comparable.
    unit = np.where(state.held, MOTION, LOAD)
    scaled = unit[..., :, None] * response * unit[..., None, :]
    error = np.abs(scaled - np.swapaxes(scaled, -1, -2))
    assert np.max(error / np.max(np.abs(scaled), axis=(-2, -1), keepdims=True)) < 1e-8


def check_energy(cases: Cases, state: Equilibrium) -> None:
    """The work along the ramp, by Gauss's rule in 24 panels with exact slopes, is the energy at its end."""
    points, weights = np.polynomial.legendre.leggauss(4)
    nodes = ((np.arange(24)[:, None] + 0.5 * (points + 1)) / 24).ravel()
    weights = np.tile(weights, 24) / 24
    share = np.repeat(nodes[:, None], len(cases.held), axis=1)
    path = load_path(cases.linkage, cases.targets(share), cases.held)
    slope = np.einsum(
        "...ij,...j->...i", by_targets(path).pose, np.broadcast_to(cases.change, path.pose.shape)
    )
    work = 0.5 * np.einsum("s,sbi,sbi->b", weights, path.load, slope)
    # The rule's own error where a path bends sharply; on smooth ones it is below 1e-9.
    np.testing.assert_allclose(work, state.energy, rtol=1e-3)
    assert np.quantile(np.abs(work / state.energy - 1), 0.75) < 1e-6


def run(linkages: int, count: int) -> int:
    generator = np.random.default_rng(20)
    solved = 0
    for _ in range(linkages):
        cases = random_cases(generator, count)
        state = equilibrium(cases.linkage, cases.targets(np.ones(len(cases.held))), cases.held)
        check(cases, state)
        check_reciprocity(state)
        check_energy(cases, state)
        solved += len(cases.held)
    return solved


@pytest.mark.long
def test_random_load_cases() -> None:
    assert run(4, 20) >= 48


@pytest.mark.long
def test_ten_thousand_random_load_cases() -> None:
    assert run(250, 50) >= 10_000
