"""Bands by how the ends are tied compare what each tie has on no mesh, in torsion too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fem.section_constants import section_constants
from pipeline.bar.of_file import Placed, place, tied
from pipeline.bar.record import relative_spread
from pipeline.bar.tables import FileCase
from tests.fem import bar_p
from tests.meshes.brought.made import cad
from tests.meshes.brought.test_cad import extruded_bar_p

CLOSE = 0.01
"""Of K44 and its band, to Vlasov's theory."""


@pytest.fixture
def placed(tmp_path: Path) -> Placed:
    """Bar P as a CAD file, on its two meshes."""
    path = cad(tmp_path / "p.step", extruded_bar_p)
    law = {"E_MPa": bar_p.MATERIAL.E, "nu": bar_p.MATERIAL.nu}
    ends = {
        "base": {"plane": [0, 0, 0], "normal": [1, 0, 0]},
        "tip": {"plane": [bar_p.LENGTH, 0, 0], "normal": [1, 0, 0]},
    }
    case = {"schema": 1, "name": "p", "material": law, "bar": {"file": path.name, **ends}}
    return place(FileCase.model_validate(case), path)


def test_the_band_of_torsion_is_that_of_held_and_free_warping(placed: Placed) -> None:
    """An I-bar between plane ends is stiffer than one that warps: K44 = GJ / L / (1 - 2 tanh(kL/2) / kL), k² = GJ / EIw
    (V. Z. Vlasov, Thin-walled Elastic Beams, 1961). Loads that are distributed leave GJ / L.

    The theory knows no shear by warping and no ends that give under the loads: both K44 lie 0.7 % below it. The
    difference of the ties on the coarse mesh, by which the band was formed before, has the mesh of the section in it.
    """
    constants, length = section_constants(bar_p.SECTION, bar_p.MATERIAL.nu), bar_p.LENGTH
    torsion = bar_p.MATERIAL.shear_modulus * constants.J
    k = np.sqrt(torsion / (bar_p.MATERIAL.E * constants.Iw)) * length
    lost = 2.0 * np.tanh(0.5 * k) / k
    rigid, free = tied(placed, "rigid").elastic.value, tied(placed, "distributed").elastic.value
    assert free[3, 3] == pytest.approx(torsion / length, rel=CLOSE)
    assert rigid[3, 3] == pytest.approx(torsion / length / (1.0 - lost), rel=CLOSE)
    assert relative_spread(rigid, {"distributed": free})["K44"] == pytest.approx(lost, rel=CLOSE)
    coarse = placed.bars[0]
    before = rigid + coarse.stiffness("distributed") - coarse.stiffness("rigid")
    assert relative_spread(rigid, {"distributed": before})["K44"] / lost - 1.0 > 2.0 * CLOSE
