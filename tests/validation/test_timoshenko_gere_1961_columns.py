"""Columns of the textbook against the solid bar.

S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., McGraw-Hill 1961: sections 2.2 to 2.4 (supports;
clamped antisymmetric mode tan u = u, 8.183 EI/L² in section 2.4's fixed-hinged and 2.861 half waves here), section
2.17 (shear, P = P_E / (1 + P_E / GA)).

Bar P has I = 692.8 and 2812.1 mm⁴ and shear areas of 58.8 and 51.8 mm². Tolerance 1 %: the rigid end faces hold
the Poisson contraction (0.2 to 0.3 % up), the mesh of 18 063 unknowns is up to 0.4 % stiff in the fourth mode, and
in the solid the stress also works on the axial slopes of bending, EI (1 - P/EA): 1.1 % down at the highest load, 75 kN.
"""

from __future__ import annotations

from math import pi

import pytest

from tests.fem import bar_p

E = bar_p.MATERIAL.E
G = E / (2 * (1 + bar_p.MATERIAL.nu))
RIGIDITIES = {"xy": (E * 692.8, G * 58.8), "xz": (E * 2812.1, G * 51.8)}
HALF_WAVES = {
    "free": (0.5, 1.5, 2.5, 3.5),
    "guided": (1.0, 2.0, 3.0, 4.0),
    "clamped": (2.0, 2.8606, 4.0, 4.9181),
    "pinned": (1.0, 2.0, 3.0, 4.0),
}


def column(plane: str, waves: float) -> float:
    """Critical load of a bar with this number of half sine waves, N."""
    bending, shear = RIGIDITIES[plane]
    euler = (waves * pi / bar_p.LENGTH) ** 2 * bending
    return euler / (1 + euler / shear)


@pytest.mark.parametrize("supports", HALF_WAVES)
def test_solid_bar_is_a_column(supports: str) -> None:
    """Plane by plane: loads of both planes may lie closer than the tolerance. Pinned about y is clamped about z."""
    compared = 0
    for plane in RIGIDITIES:
        waves = HALF_WAVES["clamped" if (supports, plane) == ("pinned", "xy") else supports]
        found = [m.load for m in bar_p.modes(supports)[:4] if m.plane == plane]
        expected = [column(plane, w) for w in waves[: len(found)]]
        assert found == pytest.approx(expected, rel=1e-2)
        compared += len(found)
    assert compared == 4, "a mode in neither plane"


def test_shear_is_needed() -> None:
    """Without shear the same comparison fails: the pinned bar would be 1.5 % off, the clamped one 6 %."""
    pinned, clamped = bar_p.modes("pinned"), bar_p.modes("clamped")
    in_plane = next(m.load for m in pinned if m.plane == "xz")
    assert in_plane < 0.99 * pi**2 * RIGIDITIES["xz"][0] / bar_p.LENGTH**2
    stocky = next(m.load for m in clamped if m.plane == "xz")
    assert stocky < 0.95 * 4 * pi**2 * RIGIDITIES["xz"][0] / bar_p.LENGTH**2
