"""The paper that the models follow, and where its print errs.

A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, "Stiffness modelling of parallelogram-based parallel
manipulators", New Trends in Mechanism Science: Analysis and Design (EUCOMES 2010), Springer.

Printed numbers carry three digits: an entry agrees when it differs by less than half a unit of the last one,
which is at most 0.5 %.
"""

from __future__ import annotations

import numpy as np
import pytest

from vjm import closed_forms, paper, stiffness
from vjm.critical import critical_load
from vjm.equilibrium import equilibrium
from vjm.lumped import STATION
from vjm.paper_errata import eq_6_step, errata, example, moving_last_factor

EVIDENCE = {erratum.number: erratum.evidence for erratum in errata()}
GUIDED = ("y", "z", "rx", "ry", "rz")


def test_errata_are_numbered_and_complete() -> None:
    assert list(EVIDENCE) == [1, 2, 3, 4, 5, 6, 7]
    assert all(np.all(np.isfinite(list(evidence.values()))) for evidence in EVIDENCE.values())


def test_erratum_1_last_factor_of_equation_1_is_constant() -> None:
    linkage = example(0.0)
    moving = moving_last_factor(linkage)
    assert stiffness.rank(moving, paper.LENGTH) == 4
    # Exactly zero but for rounding: the platform slips along x past the hinges.
    assert abs(moving[0, 0]) < 1e-9 * paper.BAR_STIFFNESS[0, 0]
    constant = stiffness.unloaded_stiffness(linkage)
    assert stiffness.rank(constant, paper.LENGTH) == 5
    np.testing.assert_allclose(
        constant, stiffness.closed_form(paper.BAR_STIFFNESS, paper.WIDTH, 0.0), rtol=1e-9, atol=1e-6
    )


def test_erratum_1_holds_at_an_angle_too() -> None:
    linkage = example(np.pi / 6)
    assert stiffness.rank(moving_last_factor(linkage), paper.LENGTH) == 4
    assert stiffness.rank(stiffness.unloaded_stiffness(linkage), paper.LENGTH) == 5


@pytest.mark.parametrize("q", [0.0, np.pi / 6])
def test_erratum_2_equation_6_needs_the_inverse(q: float) -> None:
    linkage = example(q)
    pose = linkage.unloaded_pose + np.array([-0.05, 0.2, 0.0, 1e-3, 0.0, 1e-3])
    expected = equilibrium(linkage, pose)
    for i, chain in enumerate(linkage.chains):
        gaps = {}
        for inverted in (True, False):
            coordinates = chain.rest
            for _ in range(12 if inverted else 3):
                multiplier, coordinates = eq_6_step(chain, pose, coordinates, inverted)
            gaps[inverted] = np.linalg.norm(chain.chain.pose(coordinates)[:3] - pose[:3])
            if inverted:
                np.testing.assert_allclose(multiplier, expected.multipliers[i], rtol=1e-6, atol=1e-3)
        assert gaps[True] < 1e-9
        assert gaps[False] > 1e3


def test_erratum_2_mended_equation_10_is_the_slope_of_the_load() -> None:
    assert EVIDENCE[2]["Eq. 10 against central differences, relative"] < 1e-6


def test_erratum_2_dropping_the_cross_hessian_is_wrong() -> None:
    """Row 1 of Eq. 9 needs H_theta_q: without it Eq. 10 misses the geometric stiffness."""
    linkage = example(np.pi / 6, "middle")
    pose = linkage.unloaded_pose + np.array([-0.05, 0.2, 0.0, 1e-3, 0.0, 1e-3])
    state = equilibrium(linkage, pose)
    without = np.zeros((6, 6))
    for chain, x, multiplier in zip(linkage.chains, state.coordinates, state.multipliers, strict=True):
        kinematics = chain.chain.kinematics(x, multiplier)
        h, v, p = kinematics.hessian, chain.virtual, chain.passive
        j = kinematics.jacobian
        without += stiffness.eliminate(
            j[:, v], j[:, p], chain.stiffness, h[np.ix_(v, v)], hessian_q=h[np.ix_(p, p)]
        )
    loaded = stiffness.loaded_stiffness(state, linkage.q)
    without = stiffness.in_bar_frame(without, linkage.q)
    # Along z of the bar frame there is no elastic stiffness to hide the error: all of it is geometric.
    assert abs(without[2, 2] / loaded[2, 2] - 1.0) > 0.05


def test_errata_3_and_4_equation_13_is_equation_11_at_30_degrees() -> None:
    printed = paper.HALF_PARALLELOGRAM_STIFFNESS
    at_30 = 0.5 * stiffness.closed_form(paper.BAR_STIFFNESS, paper.WIDTH, np.radians(30.0))
    np.testing.assert_allclose(at_30, printed, rtol=5e-3, atol=1e-9)
    straight = 0.5 * stiffness.closed_form(paper.BAR_STIFFNESS, paper.WIDTH, 0.0)
    for entry, error in (((3, 3), 0.13), ((3, 5), 1.0), ((4, 4), 0.33), ((5, 5), 0.012)):
        assert abs(straight[entry] / printed[entry] - 1.0) == pytest.approx(error, rel=0.03)


def test_erratum_4_no_other_width_fits_the_print() -> None:
    """Entry 55, printed 2.64e7, is d² cos² q K11 / 4: 80.0 mm at 30 degrees, 69.3 mm at 0."""
    printed, k11 = paper.HALF_PARALLELOGRAM_STIFFNESS[4, 4], paper.BAR_STIFFNESS[0, 0]
    assert 2 * np.sqrt(printed / k11) / np.cos(np.pi / 6) == pytest.approx(paper.WIDTH, rel=2e-3)
    straight = 2 * np.sqrt(printed / k11)
    assert straight == pytest.approx(69.28, abs=0.01)
    other = 0.5 * stiffness.closed_form(paper.BAR_STIFFNESS, straight, 0.0)
    assert other[3, 5] == 0.0 and paper.HALF_PARALLELOGRAM_STIFFNESS[3, 5] > 0.0


def test_erratum_5_table_1_differs_by_up_to_seven_percent() -> None:
    found = [value for name, value in EVIDENCE[5].items() if name.endswith("percent")]
    np.testing.assert_allclose(found, [-3.0, 5.6, -6.9, -0.2], atol=0.06)
    assert EVIDENCE[5]["K_tran, parallelogram over two bars, ratio"] < 1.0
    assert EVIDENCE[5]["K_rot, parallelogram over two bars, ratio"] == pytest.approx(33.3, abs=0.05)


def test_erratum_6_equation_12_is_no_uniform_bar() -> None:
    evidence = EVIDENCE[6]
    assert evidence["-K26/K22, mm"] == pytest.approx(156.9, abs=0.05)
    assert evidence["K35/K33, mm"] == pytest.approx(159.0, abs=0.05)
    assert evidence["K22 K66 / K26²"] == pytest.approx(1.313, abs=5e-4)
    low, high = (evidence[f"K22 K66 / K26², {end} within print rounding"] for end in ("lowest", "highest"))
    assert low == pytest.approx(1.303, abs=5e-4) and high == pytest.approx(1.322, abs=5e-4)
    assert high < evidence["least ratio of a uniform bar"]
    assert evidence["radius of gyration about z, mm"] == pytest.approx(2.57, abs=5e-3)
    assert evidence["radius of gyration about y, mm"] == pytest.approx(5.35, abs=5e-3)


def test_erratum_7_spring_place_changes_the_critical_load_and_not_the_stiffness() -> None:
    reference = stiffness.closed_form(paper.BAR_STIFFNESS, paper.WIDTH, 0.0)
    loads = {}
    for place in STATION:
        linkage = example(0.0, place)
        np.testing.assert_allclose(stiffness.unloaded_stiffness(linkage), reference, rtol=1e-9, atol=1e-6)
        found = critical_load(linkage, GUIDED, -1)
        loads[place] = found.load
        expected = closed_forms.in_plane_critical(linkage).compression
        assert found.found == (expected is not None)
        assert expected is None or found.load == pytest.approx(expected, rel=1e-6)
    assert np.isnan(loads["tip"])
    assert loads["base"] == pytest.approx(-5.67e3, rel=1e-3)
    assert loads["middle"] == pytest.approx(-14.59e3, rel=1e-3)
    tension = critical_load(example(0.0, "tip"), GUIDED, 1)
    # 12.3 kN with axially rigid springs, and 0.1 % more because the bar stretches first.
    assert tension.load == pytest.approx(12.313e3, rel=1.1e-3)


def test_erratum_7_two_link_column_of_the_middle_spring() -> None:
    """17.4 kN, the value of two rigid halves on one hinge, needs a rigid transverse spring."""
    hinge = closed_forms.middle_hinge_only(paper.BAR_STIFFNESS, paper.LENGTH)
    assert hinge == pytest.approx(-17.4e3, rel=2e-3)
    assert critical_load(example(0.0, "middle"), GUIDED, -1).load > hinge


def test_fea_loads_lie_below_and_above_the_base_placement() -> None:
    """'Both lower and higher than in the VJM-modelling' holds against the springs at the base."""
    base = -critical_load(example(0.0, "base"), GUIDED, -1).load
    k, length = paper.BAR_STIFFNESS, paper.LENGTH
    exact = closed_forms.euler_loads(k[2, 2] * length**3 / 12, k[1, 1] * length**3 / 12, length)
    assert -exact.cantilever < base < min(-exact.guided, -exact.clamped, -exact.in_plane)
