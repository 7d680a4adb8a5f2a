"""Supports of a bar, the equivalent bar beside the loop, and what the record says where there is no answer."""

from __future__ import annotations

import numpy as np
import pytest

from tests.vjm.beams import SLENDER
from tests.vjm.pseudo_rigid import pseudo_rigid_bar
from tests.vjm.strategies import LENGTH, WIDTH
from vjm import paper
from vjm.branch import buckled_path
from vjm.chain import Chain, Fixed
from vjm.critical import critical_load
from vjm.equilibrium import equilibrium
from vjm.frames import exp
from vjm.increments import LOST_STABILITY
from vjm.mechanism import ElasticChain
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.refined import Refined
from vjm.stability import negative_eigenvalues
from vjm.stiffness import unloaded_stiffness

K = SLENDER.stiffness(LENGTH)
EULER_Y, EULER_Z = (np.pi**2 * ei / LENGTH**2 for ei in (SLENDER.ei_y, SLENDER.ei_z))


@pytest.mark.parametrize(
    ("base", "tip", "held", "load"),
    [
        ("clamped", "free", (), EULER_Z / 4),
        ("clamped", "guided", (), EULER_Z),
        ("clamped", "pinned", (), 4 * EULER_Z),
        ("pinned", "guided", ("z",), EULER_Z),
        ("pinned", "pinned", (), 4 * EULER_Z),
    ],
)
def test_supports_of_a_bar(base: str, tip: str, held: tuple, load: float) -> None:
    """A hinge about y leaves the bar clamped about z: it gives way sideways first."""
    bar = Bar(LENGTH, K, base, tip=tip, bar=Refined(8))  # type: ignore[arg-type]
    found = critical_load(bar, (*bar.held, *held), max_strain=0.02)
    assert -found.load == pytest.approx(load, rel=3e-3)


def test_a_pinned_tip_buckles_in_the_plane_of_its_hinges() -> None:
    """Clamped and pinned: the first root of tan x = x, P = 4.4934² EI / L²."""
    stout = K.copy()
    for i, j in ((1, 1), (1, 5), (5, 1), (5, 5)):
        stout[i, j] *= 100
    bar = Bar(LENGTH, stout, tip="pinned", bar=Refined(8))
    found = critical_load(bar, bar.held, max_strain=0.02)
    assert -found.load == pytest.approx(4.49341**2 * SLENDER.ei_y / LENGTH**2, rel=8e-3)


def test_unknown_supports_are_refused() -> None:
    for change in ({"base": "loose"}, {"tip": "welded"}):
        with pytest.raises(ValueError, match="must be one of"):
            Bar(LENGTH, K, **change)  # type: ignore[arg-type]


def carried(elastic: ElasticChain, pose: np.ndarray) -> ElasticChain:
    """The chain behind a rigid foot, as a link of a manipulator."""
    foot = Fixed(np.array([120.0, 30.0, -50.0]), exp([0.2, -0.3, 0.4]))
    chain = Chain((foot, *elastic.chain.elements), foot.rotation @ elastic.chain.reference)
    return ElasticChain(chain, elastic.stiffness, elastic.rest)


@pytest.mark.parametrize("degrees", [0, 30])
def test_the_equivalent_bar_replaces_the_loop_in_a_manipulator(degrees: int) -> None:
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, np.radians(degrees))
    totals = []
    for mechanism in (linkage, pseudo_rigid_bar(linkage)):
        chains = [carried(chain, mechanism.unloaded_pose) for chain in mechanism.chains]
        assembled = type("Assembled", (), {})()
        pose = chains[0].chain.pose(chains[0].rest)
        assembled.chains, assembled.unloaded_pose, assembled.length = tuple(chains), pose, LENGTH
        totals.append(unloaded_stiffness(assembled))
    np.testing.assert_allclose(totals[1], totals[0], atol=1e-9 * np.max(np.abs(totals[0])))


def second_order(degrees: float, motion: np.ndarray, size: float) -> np.ndarray:
    """Even part of the load of loop less equivalent bar, over size²: the difference of second order."""
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, np.radians(degrees))
    loads = []
    for mechanism in (linkage, pseudo_rigid_bar(linkage)):
        moves = mechanism.unloaded_pose + np.array([[size], [-size]]) * motion
        loads.append(np.sum(equilibrium(mechanism, moves, follow=True).load, axis=0) / 2)
    return (loads[0] - loads[1]) / size**2


def test_the_equivalent_bar_is_first_order_only() -> None:
    """A platform driven by z along the width comes nearer by z²/2L cos³ q in the loop, not in the bar.

    Held in x it is stretched by that, with 2 K11: Fx of second order K11 z² / L at q = 0, along the bars.
    """
    z = np.eye(6)[2]
    for size in (0.5, 1.0):
        gap = second_order(0.0, z, size)
        assert gap[0] == pytest.approx(paper.BAR_STIFFNESS[0, 0] / LENGTH, rel=1e-3)
    tilted = second_order(30.0, np.array([0.5, 0, np.sqrt(3) / 2, 0, 0, 0]), 0.5)
    along = tilted[:3] @ [np.sqrt(3) / 2, 0, -0.5]
    assert along == pytest.approx(paper.BAR_STIFFNESS[0, 0] / LENGTH, rel=1e-2)


HELD = ("y", "z", "rx", "ry", "rz")


def test_past_a_critical_load_the_record_says_so() -> None:
    linkage = Parallelogram(LENGTH, WIDTH, K).refined()
    load = np.array([0.0, 0, 0, 0, 0, 0])
    load[0] = 1.2 * critical_load(linkage, HELD).load
    target = np.where([name in HELD for name in ("x", *HELD)], linkage.unloaded_pose, load)
    state = equilibrium(linkage, target, HELD)
    assert state.unstable == negative_eigenvalues(state, HELD) == 4
    assert equilibrium(linkage, np.where(load != 0, 0.5 * load, target), HELD).unstable == 0


@pytest.mark.parametrize("demand", [[1e4, 0, 0], [0, 0, 2e3]])
def test_impossible_demands_fail_with_a_reason(demand: list[float]) -> None:
    """Pushed by far more than the bar can take, or asked to go where the springs cannot follow."""
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS)
    held = np.ones((2, 6), dtype=bool)
    held[0, 0] = demand[0] == 0
    targets = np.tile(linkage.unloaded_pose, (2, 1))
    targets[0, :3] = np.array([1e9, 0, 0]) if demand[0] else linkage.unloaded_pose[:3] + demand
    state = equilibrium(linkage, targets, held)
    assert (state.converged & (state.unstable <= 0)).tolist() == [False, True]
    reason = str(state.reason[0])
    assert state.unstable[0] > 0 or "last equilibrium" in reason or reason.startswith(LOST_STABILITY)
    assert np.all(np.isfinite(state.unknowns))


def test_the_count_of_the_solver_is_that_of_the_eigenvalues() -> None:
    generator = np.random.default_rng(5)
    linkage = Parallelogram(LENGTH, WIDTH, K, 0.3).refined(2)
    held = generator.random((60, 6)) < 0.5
    held[:, 2] = True
    held[:, 0] = False
    load = generator.uniform(-1, 1, (60, 6)) * [3e4, 50, 0, 1e3, 1e3, 1e3]
    targets = np.where(held, linkage.unloaded_pose, load)
    state = equilibrium(linkage, targets, held, follow=True)
    found = np.flatnonzero(state.converged)
    counts = [int(negative_eigenvalues(state.member(int(k)), held[k])) for k in found]
    assert state.unstable[found].tolist() == counts
    assert len(set(counts)) > 2


def test_a_refined_linkage_buckles_in_compression_and_not_in_tension() -> None:
    linkage = Parallelogram(LENGTH, WIDTH, K).refined()
    critical = critical_load(linkage, ("z", "rx", "ry", "rz"), -1)
    branch = buckled_path(critical, [1.005 * critical.displacement, 1.02 * critical.displacement])
    assert np.all(branch.converged) and np.all(branch.unstable == 0)
    # After buckling the load climbs with P / (2 L), the elastica's first order.
    climb = (branch.load[1, 0] - branch.load[0, 0]) / (branch.pose[1, 0] - branch.pose[0, 0])
    assert climb == pytest.approx(-critical.load / (2 * LENGTH), rel=0.03)
    assert not critical_load(linkage, ("z", "rx", "ry", "rz"), 1, max_strain=0.005).found
