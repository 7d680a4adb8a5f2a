"""Cross-sections: their moments against polygons by Green's theorem, and one sentence for every bad dimension."""

from __future__ import annotations

from math import inf, nan, pi

import numpy as np
import pytest

from meshes.section import ISection, Patch, Rectangle, Round, Section, Tube

SECTIONS = [Rectangle(6.0, 10.0), ISection(12.0, 2.2, 15.5, 4.0), Round(10.0), Tube(12.0, 2.0)]


def outline(patch: Patch, points: int = 400) -> np.ndarray:
    """Closed polygon (n, 2) around a patch, its arcs cut into chords."""
    parts = []
    for i, arc in enumerate(patch.arcs):
        a, b = np.array(patch.corners[i]), np.array(patch.corners[(i + 1) % 4])
        t = np.linspace(0.0, 1.0, points, endpoint=False)[:, None]
        line = a + t * (b - a)
        radius = np.linalg.norm(a)
        parts.append(line / np.linalg.norm(line, axis=1)[:, None] * radius if arc else line)
    return np.concatenate(parts)


def polygon_moments(p: np.ndarray) -> tuple[float, float, float]:
    """Area, ∫z² dA, ∫y² dA of a counter-clockwise polygon (Green's theorem)."""
    (y0, z0), (y1, z1) = p.T, np.roll(p, -1, axis=0).T
    cross = y0 * z1 - y1 * z0
    return (
        float(cross.sum() / 2),
        float((cross * (z0**2 + z0 * z1 + z1**2)).sum() / 12),
        float((cross * (y0**2 + y0 * y1 + y1**2)).sum() / 12),
    )


# A round patch uses inner corners as a square, the ring's arcs as circles: chords of 90/400 degrees miss 1.3e-6.
@pytest.mark.parametrize("section", SECTIONS, ids=lambda s: type(s).__name__)
def test_patches_fill_the_section(section: Section) -> None:
    assert isinstance(section, Section)
    total = np.sum([polygon_moments(outline(patch)) for patch in section.patches()], axis=0)
    np.testing.assert_allclose(total, (section.area, *section.second_moments), rtol=1e-5)
    points = np.concatenate([outline(patch) for patch in section.patches()])
    np.testing.assert_allclose(np.ptp(points, axis=0), section.size, rtol=1e-4)


def test_moments_of_bar_p_by_hand() -> None:
    """Two flanges 12 x 2.2 at 6.65 mm from the middle and a web 4 x 11.1, by the parallel-axis theorem."""
    section = ISection(12.0, 2.2, 15.5, 4.0)
    assert section.area == pytest.approx(2 * 26.4 + 44.4, rel=1e-14)
    iy = 2 * (12 * 2.2**3 / 12 + 26.4 * 6.65**2) + 4 * 11.1**3 / 12
    iz = 2 * 2.2 * 12**3 / 12 + 11.1 * 4**3 / 12
    np.testing.assert_allclose(section.second_moments, (iy, iz), rtol=1e-14)


def test_tube_closes_to_a_round() -> None:
    assert Tube(10.0, 4.9999).area == pytest.approx(Round(10.0).area, rel=1e-8)
    assert Tube(12.0, 2.0).second_moments[0] == pytest.approx(pi * (12**4 - 8**4) / 64, rel=1e-14)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Rectangle(0.0, 1.0), "width is 0, allowed is a length above 0 mm"),
        (lambda: Rectangle(1.0, -2.0), "height is -2, allowed is a length above 0 mm"),
        (lambda: Rectangle(nan, 1.0), "width is nan, allowed is a length above 0 mm"),
        (lambda: Round(inf), "diameter is inf, allowed is a length above 0 mm"),
        (
            lambda: ISection(12.0, 2.0, 15.0, 12.0),
            "web is 12 mm, allowed is less than flange_width = 12 mm",
        ),
        (
            lambda: ISection(12.0, 7.5, 15.0, 4.0),
            "flange_thickness is 7.5 mm, allowed is less than half of height = 15 mm",
        ),
        (lambda: ISection(12.0, -1.0, 15.0, 4.0), "flange_thickness is -1, allowed is a length above 0 mm"),
        (lambda: Tube(10.0, 5.0), "wall is 5 mm, allowed is less than half of outer_diameter = 10 mm"),
    ],
)
def test_bad_dimensions(make: object, sentence: str) -> None:
    with pytest.raises(ValueError) as caught:
        make()  # type: ignore[operator]
    assert str(caught.value) == sentence
