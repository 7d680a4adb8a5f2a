"""What was written down about a rig and may be off: each tolerance against a closed form."""

from __future__ import annotations

import numpy as np
import pytest

from fem.beam import uniform_stiffness
from tests.vjm.test_refined import entrywise
from vjm.effects.bar_section_error import BarSectionError
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.refined import Refined
from vjm.stiffness import unloaded_stiffness
from vjm.tolerances import tolerances
from vjm.tolerances.angle import Angle
from vjm.tolerances.end_softness import EndSoftness
from vjm.tolerances.section import Section

EA, EIY, EIZ, GJ, LENGTH = 6.82e6, 1.98e8, 4.51e7, 1.08e7, 310.0


def bar() -> Bar:
    return Bar(LENGTH, uniform_stiffness(LENGTH, EA, EIY, EIZ, GJ))


def stiffness(of: Bar) -> np.ndarray:
    return of.links[0].stiffness


@pytest.mark.parametrize(
    "of", [it for it in tolerances() if "parallelogram" in it.kinds], ids=lambda it: it.name
)
def test_at_its_nominal_values_nothing_changes(of: EndSoftness) -> None:
    rig = Parallelogram(LENGTH, 80.0, uniform_stiffness(LENGTH, EA, EIY, EIZ, GJ))
    assert of.apply(rig, of.nulls) is rig


@pytest.mark.parametrize("of", tolerances(), ids=lambda it: it.name)
def test_every_number_has_a_key_and_a_deviation_within_its_bounds(of: EndSoftness) -> None:
    assert set(of.keys) == {p.name for p in of.parameters}
    assert set(of.keys.values()) == set(of.deviations)
    for p in of.parameters:
        reach = 5.0 * of.width[p.name]
        assert p.low < p.null - reach and p.null + reach < p.high


def test_a_section_with_other_stiffnesses_is_that_section() -> None:
    scales = {"ea": 1.1, "eiy": 0.9, "eiz": 1.05, "gj": 0.8}
    expected = uniform_stiffness(LENGTH, 1.1 * EA, 0.9 * EIY, 1.05 * EIZ, 0.8 * GJ)
    for it in (Section(), BarSectionError()):
        np.testing.assert_allclose(stiffness(it.apply(bar(), scales)), expected, rtol=1e-13, atol=1e-6)


def test_equal_factors_are_one_modulus() -> None:
    found = stiffness(Section().apply(bar(), dict.fromkeys(("ea", "eiy", "eiz", "gj"), 1.07)))
    np.testing.assert_allclose(found, 1.07 * stiffness(bar()), rtol=1e-13, atol=1e-6)


def test_soft_ends_are_springs_in_series() -> None:
    """Under a force at the tip: the bar, both ends' own give along y, and the base end turned times the lever."""
    shares = EndSoftness().nulls | {"y": 0.02, "rz": 0.03}
    found = np.linalg.inv(stiffness(EndSoftness().apply(bar(), shares)))
    deflection, turn = LENGTH**3 / (3.0 * EIZ), LENGTH / EIZ
    assert found[1, 1] == pytest.approx(
        deflection + 2.0 * 0.02 * deflection + 0.03 * turn * LENGTH**2, rel=1e-12
    )
    assert found[5, 5] == pytest.approx(turn + 2.0 * 0.03 * turn, rel=1e-12)
    assert found[1, 5] == pytest.approx(LENGTH**2 / (2.0 * EIZ) + 0.03 * turn * LENGTH, rel=1e-12)


def test_ends_may_be_stiffer_than_the_bar_says_and_no_spring_is_negative() -> None:
    shares = dict.fromkeys(EndSoftness().nulls, -0.02)
    found = stiffness(EndSoftness().apply(bar(), shares))
    assert np.linalg.eigvalsh(found).min() > 0.0
    assert np.all(np.diag(found) > np.diag(stiffness(bar())))
    softer = EndSoftness().apply(bar(), shares).refined(4)
    assert np.all(np.linalg.eigvalsh(softer.chains[0].stiffness) > 0.0)


@pytest.mark.parametrize("direction", EndSoftness().nulls)
def test_nothing_jumps_where_the_ends_are_as_written(direction: str) -> None:
    """A uniform bar stands on the border between one with shear and one with rigid ends: its segments take a give of
    either sign alike, so that a line through them says what both do."""

    def compliances(share: float) -> np.ndarray:
        (link,) = EndSoftness().apply(bar(), EndSoftness().nulls | {direction: share}).links
        return np.asarray(np.linalg.inv(Refined(6).shares(link).stiffness))

    sizes = np.sqrt(np.diagonal(compliances(0.0)[0]))
    less, same, more = (compliances(share) / np.outer(sizes, sizes) for share in (-1e-4, 0.0, 1e-4))
    slope = np.abs(more - less).max()
    assert slope > 1e-5
    assert np.abs(more - 2.0 * same + less).max() < 0.01 * slope


@pytest.mark.parametrize("share", [-0.02, 0.02])
def test_the_segments_of_a_bar_with_other_ends_are_that_bar(share: float) -> None:
    of = EndSoftness().apply(bar(), dict.fromkeys(EndSoftness().nulls, share))
    assert entrywise(unloaded_stiffness(of.refined(4)), stiffness(of)) < 1e-9


def test_an_angle_is_of_the_tests_and_no_change_of_a_mechanism() -> None:
    rig = Parallelogram(LENGTH, 80.0, uniform_stiffness(LENGTH, EA, EIY, EIZ, GJ))
    turned = Angle().apply(rig, {"posture": 1.0, "mount": 0.0})
    np.testing.assert_array_equal(turned.unloaded_pose, rig.unloaded_pose)
    assert not turned.mount.any()


def test_a_mount_is_turned_with_all_that_stands_on_it() -> None:
    rig = Parallelogram(LENGTH, 80.0, uniform_stiffness(LENGTH, EA, EIY, EIZ, GJ))
    turned = Angle().apply(rig, {"posture": 0.0, "mount": 2.0})
    assert turned.mount.tolist() == [0.0, 2e-3, 0.0]
