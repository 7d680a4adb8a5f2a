"""Negative eigenvalues are counted by pivots: as many as there are, without a search for them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest

from vjm.chain import Chain, Fixed, Joint, Role
from vjm.equilibrium import equilibrium
from vjm.frames import POSE_NAMES
from vjm.gauges import Gauge
from vjm.mechanism import ElasticChain
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.newton import negatives, solve_symmetric
from vjm.paper import BAR_STIFFNESS
from vjm.sensors import Sensor

AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, eq=False)
class TwoLegs:
    """A mechanism of two chains, nothing more."""

    chains: tuple[ElasticChain, ...]
    unloaded_pose: np.ndarray = field(default_factory=lambda: np.array([100.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
    length: float = 100.0
    sensors: tuple[Sensor, ...] = ()
    gauges: tuple[Gauge, ...] = ()


@pytest.mark.parametrize("size", [1, 2, 6, 21, 40])
@pytest.mark.parametrize("diagonal", [1.0, 0.0])
def test_as_many_as_the_spectrum_has(size: int, diagonal: float) -> None:
    """Without a diagonal no single pivot is regular."""
    some = np.random.default_rng(size).standard_normal((100, size, size))
    symmetric = some + np.swapaxes(some, -1, -2)
    symmetric[:, range(size), range(size)] *= diagonal
    counted = np.sum(np.linalg.eigvalsh(symmetric) < 0.0, axis=-1)
    np.testing.assert_array_equal(negatives(symmetric), counted)


@pytest.mark.parametrize("closures", [6, 12])
def test_each_constraint_on_a_stable_body_is_one(closures: int) -> None:
    rng = np.random.default_rng(closures)
    root = rng.standard_normal((50, 20, 20))
    border = rng.standard_normal((50, closures, 20))
    none = np.zeros((50, closures, closures))
    whole = np.block([[root @ np.swapaxes(root, -1, -2), np.swapaxes(border, -1, -2)], [border, none]])
    assert set(negatives(whole)) == {closures}


def test_what_is_rounding_beside_the_rest_is_none() -> None:
    """A swing that meets no stiffness: of positive semidefinite matrices, whatever their rounding."""
    root = np.random.default_rng(7).standard_normal((200, 6, 5))
    assert set(negatives(root @ np.swapaxes(root, -1, -2))) == {0}


@pytest.mark.parametrize("q", np.linspace(-1.2, 1.2, 13))
def test_a_linkage_that_swings_freely_is_not_unstable(q: float) -> None:
    """At rest and without a load: nothing is held, or x and z are free. It stays where it is."""
    linkage = Parallelogram(250.0, 80.0, BAR_STIFFNESS, q)
    for held in ((), ("y", "rx", "ry", "rz"), ("y", "rx", "rz")):
        given = np.where([name in held for name in POSE_NAMES], linkage.unloaded_pose, 0.0)
        found = equilibrium(linkage, given[None, :], held)
        assert found.converged.all() and found.unstable.max() == 0
        np.testing.assert_allclose(found.pose[0], linkage.unloaded_pose, rtol=0, atol=1e-9)


def on_two_legs(first: np.ndarray, passive: int, second: np.ndarray) -> TwoLegs:
    """A platform on two elastic links 100 mm long, the second one on so many passive joints about one axis."""

    def leg(stiffness: np.ndarray, joints: int) -> ElasticChain:
        virtual = [Joint(kind, axis, Role.VIRTUAL) for kind in ("translation", "rotation") for axis in AXES]
        free = [Joint("rotation", AXES[1], Role.PASSIVE)] * joints
        chain = Chain((*free, Fixed(np.array([100.0, 0.0, 0.0])), *virtual))
        return ElasticChain(chain, stiffness, np.zeros(chain.size))

    return TwoLegs((leg(first, 0), leg(second, passive)))


@pytest.mark.parametrize("stiffness", [9e3, -1e4])
def test_directions_are_not_counted_beside_a_leg_that_is_singular(stiffness: float) -> None:
    """Two joints on one axis turn against each other; with one of them its stiffness counts."""
    stiff = np.diag([1e4, 1e4, 1e4, 1e8, 1e8, 1e8])
    own = np.diag([1e4, stiffness - 1e4, 1e4, 1e8, 1e8, 1e8])
    one, two = (equilibrium(on_two_legs(stiff, joints, own), np.zeros(6), ()) for joints in (1, 2))
    assert one.converged and one.unstable == int(stiffness < 0.0)
    assert not two.converged and two.unstable == -1


@pytest.mark.parametrize("counted", [[], [1], [3, 0], [2, 0, 4, 1, 3]])
def test_solved_and_counted_by_the_same_factors(counted: list[int]) -> None:
    """Whether some members are counted, all or none; the last two matrices are singular."""
    generator = np.random.default_rng(4)
    matrices = generator.normal(size=(5, 6, 6))
    matrices = matrices + np.swapaxes(matrices, -1, -2)
    matrices[3, 2, :] = matrices[3, :, 2] = matrices[4] = 0.0
    right = generator.normal(size=(5, 6, 2))
    found, regular, below = solve_symmetric(matrices, right, np.array(counted, dtype=int))
    np.testing.assert_array_equal(regular, [True, True, True, False, False])
    np.testing.assert_allclose(matrices[:3] @ found[:3], right[:3], atol=1e-12)
    np.testing.assert_array_equal(found[3:], 0.0)
    values = np.linalg.eigvalsh(matrices[counted])
    np.testing.assert_array_equal(below, np.sum(values < -1e-12, axis=-1))


def test_none_of_no_member_and_none_of_zeros() -> None:
    assert negatives(np.zeros((0, 3, 3))).shape == (0,)
    assert list(negatives(np.zeros((2, 3, 3)))) == [0, 0]
