"""One element: its energy does not feel a rigid motion; force and tangent are the derivatives of that energy."""

from __future__ import annotations

import numpy as np
import pytest

from fem.frame.base import base_coordinates, base_forces
from fem.frame.element import energy, force_and_tangent, turned_over
from fem.frame.fibres import Fibres, grid, yielded
from fem.frame.local import Reference
from fem.frame.motion import geometric, rates, relative, to_ends
from fem.frame.reference import Bars, bowed_axis, reference
from fem.frame.section import section_of
from fem.frame.so3 import exp, log
from meshes.solid import Floats
from tests.fem.frame.rigs import LENGTH, ORTHOGLIDE

SECTION = section_of(ORTHOGLIDE, LENGTH)
LENGTHS = np.full((1, 1), LENGTH)


@pytest.fixture
def bar() -> tuple[Reference, Floats, Floats]:
    """Eight bowed elements, bent, stretched and twisted at random by up to a tenth of a radian an element."""
    bars = Bars.of([[SECTION]], np.array([[2.0, 3.0]]), 8)
    x, R = bowed_axis(bars, LENGTHS)
    rng = np.random.default_rng(3)
    x = x + rng.normal(size=x.shape) * 0.3
    return reference(bars, LENGTHS), x, exp(rng.normal(size=x.shape) * 0.05) @ R


def moved(x: Floats, R: Floats, step: Floats) -> tuple[Floats, Floats]:
    return x + step[..., :3], exp(step[..., 3:]) @ R


def at_elements(step: Floats) -> Floats:
    return np.concatenate((step[..., :-1, :], step[..., 1:, :]), axis=-1)


def directions(shape: tuple[int, ...], seed: int) -> Floats:
    step = np.random.default_rng(seed).normal(size=(*shape[:-1], 6))
    step[..., 3:] *= 0.1
    return step


def test_a_rigid_motion_costs_nothing(bar: tuple[Reference, Floats, Floats]) -> None:
    ref, x, R = bar
    Q = exp(np.array([0.4, -2.0, 1.1]))
    turned_x, turned_R = x @ Q.T + [100.0, -50.0, 7.0], Q @ R
    # Rounding of coordinates of some 400 mm: 6e-14 mm x 1e4 N of axial force, of some 1e5 N mm of energy.
    np.testing.assert_allclose(energy(turned_x, turned_R, ref), energy(x, R, ref), rtol=1e-10)
    force, tangent = force_and_tangent(x, R, ref)
    turned_force, turned_tangent = force_and_tangent(turned_x, turned_R, ref)
    Q12 = np.kron(np.eye(4), Q)
    np.testing.assert_allclose(turned_force, force @ Q12.T, atol=1e-9 * np.abs(force).max())
    np.testing.assert_allclose(turned_tangent, Q12 @ tangent @ Q12.T, atol=1e-9 * np.abs(tangent).max())


def test_an_unloaded_bowed_bar_has_no_force() -> None:
    bars = Bars.of([[SECTION]], np.array([[2.0, 3.0]]), 8)
    force, _ = force_and_tangent(*bowed_axis(bars, LENGTHS), reference(bars, LENGTHS))
    assert np.abs(force).max() == 0.0


def test_forces_are_in_balance_over_an_element(bar: tuple[Reference, Floats, Floats]) -> None:
    ref, x, R = bar
    force, _ = force_and_tangent(x, R, ref)
    np.testing.assert_allclose(force[..., :3], -force[..., 6:9], atol=1e-9 * np.abs(force).max())
    lever = np.cross(x[..., 1:, :] - x[..., :-1, :], force[..., 6:9])
    np.testing.assert_allclose(force[..., 3:6] + force[..., 9:] + lever, 0.0, atol=1e-9 * np.abs(force).max())


def test_swapping_the_ends_changes_no_more_than_a_sign() -> None:
    rng = np.random.default_rng(5)
    x, R = rng.normal(size=(2, 3)), exp(rng.normal(size=(2, 3)) * 0.3)
    there, back = relative(x[0], R[0], x[1], R[1]), relative(x[1], R[1], x[0], R[0])
    np.testing.assert_allclose(there.d, -back.d, atol=1e-14)
    np.testing.assert_allclose(there.phi, -back.phi, atol=1e-14)


def test_rates_of_the_relative_motion() -> None:
    rng = np.random.default_rng(6)
    x, R = rng.normal(size=(2, 3)), exp(rng.normal(size=(2, 3)) * 0.3)
    motion = relative(x[0], R[0], x[1], R[1])
    step, size = directions((2, 3), 7), 1e-5
    up, down = (moved(x, R, s * size * step) for s in (1, -1))
    ends = [relative(a[0], A[0], a[1], A[1]) for a, A in (up, down)]
    found = np.concatenate((ends[0].d - ends[1].d, ends[0].phi - ends[1].phi)) / (2 * size)
    spin = step[:, 3:] @ motion.frame
    y = np.concatenate(((step[1, :3] - step[0, :3]) @ motion.frame, spin.mean(0), spin[1] - spin[0]))
    # Central differences: size² times a third derivative of order one.
    np.testing.assert_allclose(found, rates(motion)[0] @ y, atol=1e-9)


def test_second_derivatives_of_the_relative_motion() -> None:
    """Of force·d + moment·φ, at half a radian, where every term counts."""
    rng = np.random.default_rng(9)
    x, R = rng.normal(size=(2, 3)), exp(np.array([[0.1, 0.2, -0.3], [0.4, 0.1, 0.1]]))
    force, moment = rng.normal(size=(2, 3))

    def work(s: Floats) -> float:
        a, A = moved(x, R, s.reshape(2, 6))
        now = relative(a[0], A[0], a[1], A[1])
        return float(force @ now.d + moment @ now.phi)

    motion = relative(x[0], R[0], x[1], R[1])
    b, spin, turn = rates(motion)
    _, found = to_ends(motion, np.zeros(9), geometric(motion, force, moment, spin, turn))
    size = 1e-3
    step = size * np.eye(12)
    second = [[work(a + b) - work(a - b) - work(b - a) + work(-a - b) for b in step] for a in step]
    # Central differences: size² times a fourth derivative of order one.
    np.testing.assert_allclose(found, np.array(second) / (4 * size**2), atol=3e-6)
    assert b.shape == (6, 9)


def test_base_springs_are_the_derivatives_of_their_energy() -> None:
    X, R = np.array([[0.1, -0.2, 0.3]]), exp(np.array([[0.02, -0.03, 0.04]]))
    stiffness = np.array([[1.0, 2.0, 3.0, 40.0, 50.0, 60.0]])

    def work(s: Floats) -> float:
        theta = log(exp(s[3:]) @ R[0])
        return 0.5 * float(stiffness[0] @ (np.concatenate((X[0] + s[:3], theta)) ** 2))

    coordinates = base_coordinates(X, R)
    force, tangent = base_forces(coordinates, stiffness * coordinates, stiffness)
    size = 1e-3
    step = size * np.eye(6)
    first = np.array([work(a) - work(-a) for a in step]) / (2 * size)
    second = [[work(a + b) - work(a - b) - work(b - a) + work(-a - b) for b in step] for a in step]
    # Size² of the differences, and the neglected fourth power of the angle over 12.
    np.testing.assert_allclose(force[0], first, atol=1e-5)
    np.testing.assert_allclose(tangent[0], np.array(second) / (4 * size**2), atol=1e-4)


def test_force_is_the_slope_of_the_energy(bar: tuple[Reference, Floats, Floats]) -> None:
    ref, x, R = bar
    step, size = directions(x.shape, 1), 1e-4
    up, down = (energy(*moved(x, R, s * size * step), ref).sum() for s in (1, -1))
    force, _ = force_and_tangent(x, R, ref)
    # Measured at 1e-2, 1e-3, 1e-4: the error falls with the square, to 2e-9.
    assert (up - down) / (2 * size) == pytest.approx((force * at_elements(step)).sum(), rel=1e-8)


def test_tangent_is_the_second_derivative_of_the_energy(bar: tuple[Reference, Floats, Floats]) -> None:
    ref, x, R = bar
    one, two, size = directions(x.shape, 1), directions(x.shape, 2), 1e-3
    second = 0.0
    for a in (1, -1):
        for b in (1, -1):
            second += a * b * energy(*moved(x, R, size * (a * one + b * two)), ref).sum() / (4 * size**2)
    _, tangent = force_and_tangent(x, R, ref)
    np.testing.assert_array_equal(tangent.shape, (1, 1, 8, 12, 12))
    np.testing.assert_allclose(
        tangent, np.swapaxes(tangent, -1, -2), rtol=0, atol=1e-12 * np.abs(tangent).max()
    )
    product = np.einsum("ei,eij,ej->", at_elements(one)[0, 0], tangent[0, 0], at_elements(two)[0, 0])
    # size² times a fourth derivative, some ten times the second.
    assert second == pytest.approx(product, rel=1e-5)


def test_tangent_of_yielding_elements(bar: tuple[Reference, Floats, Floats]) -> None:
    ref, x, R = bar
    y, z, weight = grid(6.0, 8.0, SECTION.EA, SECTION.about_y.EI, SECTION.about_z.EI)
    fibres = Fibres(y[None], z[None], weight[None], np.array([1e-3]))
    before = np.random.default_rng(8).normal(size=(1, 1, 8, 3, 49)) * 1e-4

    def correct(strain: Floats, eps: Floats, rate: Floats) -> tuple[Floats, Floats]:
        return yielded(fibres, ref, before, strain, eps, rate)[:2]

    force, tangent = force_and_tangent(x, R, ref, correct)
    assert np.abs(force - force_and_tangent(x, R, ref)[0]).max() > 1e-2 * np.abs(force).max()
    # A short step: one fibre that starts to yield within it makes a kink.
    step, size = directions(x.shape, 4), 1e-8
    ends = at_elements(step)
    up, down = (
        (force_and_tangent(*moved(x, R, s * size * step), ref, correct)[0] * ends).sum() for s in (1, -1)
    )
    product = np.einsum("ei,eij,ej->", ends[0, 0], tangent[0, 0], ends[0, 0])
    assert (up - down) / (2 * size) == pytest.approx(product, rel=1e-5)


def test_an_element_that_points_backwards_is_seen(bar: tuple[Reference, Floats, Floats]) -> None:
    """Its strains are those of one that points forwards, its energy is none; bent bars have no such element."""
    _, x, R = bar
    assert not turned_over(x, R).any()
    straight = Bars.of([[SECTION]], np.zeros((1, 2)), 8)
    x, R = bowed_axis(straight, LENGTHS)
    x[..., 4:, :] -= 2.0 * (x[..., 4:5, :] - x[..., 3:4, :])
    assert np.abs(energy(x, R, reference(straight, LENGTHS))).max() < 1e-9
    assert turned_over(x, R)[0, 0].tolist() == [False, False, False, True, False, False, False, False]
