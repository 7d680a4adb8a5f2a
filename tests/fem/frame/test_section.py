"""Sections inferred from a 6x6 give it back: alone, and as a single bar pushed and turned at its tip."""

from __future__ import annotations

import numpy as np
import pytest

from fem.beam import Segment, stepped_stiffness
from fem.frame.rig import Rig
from fem.frame.section import Section, section_of, uniform
from meshes.solid import Floats
from tests.fem.frame.rigs import LENGTH, ORTHOGLIDE, measure

SHEAR = stepped_stiffness([Segment(LENGTH, 6.8e6, 1.97e8, 4.85e7, 1e7, 1.6e6, 1.4e6)])
LUGS = stepped_stiffness(
    [Segment(n, k * 6.8e6, k * 2e8, k * 4.5e7, k * 1e7) for n, k in ((10, 50), (290, 1), (10, 50))]
)
LONG_LUG = stepped_stiffness(
    [Segment(n, k * 6.8e6, k * 2e8, k * 4.5e7, k * 1e7) for n, k in ((90, 1e3), (220, 1))]
)
SLENDER = stepped_stiffness([Segment(LENGTH, 6.8e6, 1.97e8, 4.85e7, 1e7)])
CASES = {"Eq. 12": ORTHOGLIDE, "shear": SHEAR, "lugs": LUGS, "one long lug": LONG_LUG, "slender": SLENDER}


def stiffness_at_rest(bar: Section | Floats) -> Floats:
    """(6, 6) by central differences of 1e-4 mm and 1e-6 rad."""
    size = np.array([1e-4] * 3 + [1e-6] * 3)
    values = np.concatenate((np.diag(size), -np.diag(size)))
    rows = [
        measure(Rig("bar", LENGTH, bar), ("x", "y", "z", "rx", "ry", "rz"), v[None]).wrench[0] for v in values
    ]
    return np.array([(rows[i] - rows[6 + i]) / (2 * size[i]) for i in range(6)]).T


@pytest.mark.parametrize("case", CASES)
def test_the_bar_gives_back_its_stiffness(case: str) -> None:
    bar = CASES[case]
    root = np.sqrt(np.diag(bar))
    # Newton's limit of 1e-6 N over forces of 2e-3 N would be 5e-4; its last step is quadratic, measured below 1e-8.
    np.testing.assert_allclose(
        stiffness_at_rest(bar) / np.outer(root, root), bar / np.outer(root, root), atol=1e-6
    )


def test_what_is_inferred() -> None:
    section = section_of(SHEAR, LENGTH)
    found = (section.EA, section.about_z.GA, section.about_y.EI)
    assert found == pytest.approx((6.8e6, 1.6e6, 1.97e8), rel=1e-6)
    assert abs(section.about_y.base) + abs(section.about_y.tip) < 1e-9
    lugs = section_of(LUGS, LENGTH)
    assert np.isinf(lugs.about_z.GA)
    assert 8.0 < lugs.about_z.base * LENGTH < 10.0
    paper = section_of(ORTHOGLIDE, LENGTH)
    # K22 K66 / K26² = 1.313 is below 4/3, K33 K55 / K35² = 1.338 above.
    assert np.isinf(paper.about_z.GA) and paper.about_z.base + paper.about_z.tip > 0.0
    assert np.isfinite(paper.about_y.GA) and paper.about_y.base == pytest.approx(-paper.about_y.tip)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda k: k[:5], "symmetric 6x6"),
        (lambda k: k + np.eye(6, k=1) * 1e3, "symmetric 6x6"),
        (lambda k: k + (np.eye(6, k=1) + np.eye(6, k=-1)) * 200.0, r"K\d\d of the bar couples by"),
        (lambda k: k - np.diag([3e4, 0, 0, 0, 0, 0]), "positive definite"),
    ],
)
def test_what_is_no_straight_beam(change: object, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        section_of(change(ORTHOGLIDE), LENGTH)  # type: ignore[operator]


def test_couplings_that_a_mesh_leaves_are_left_out() -> None:
    """Tetrahedra of parts with two planes of symmetry leave up to 6e-4 of the root of the diagonal."""
    size = np.sqrt(np.diag(ORTHOGLIDE))
    noise = np.zeros((6, 6))
    noise[4, 5] = noise[5, 4] = 6e-4 * size[4] * size[5]
    assert section_of(ORTHOGLIDE + noise, LENGTH) == section_of(ORTHOGLIDE, LENGTH)


def test_rigidities_are_positive() -> None:
    with pytest.raises(ValueError, match="EIz"):
        uniform(1.0, 1.0, 0.0, 1.0)
