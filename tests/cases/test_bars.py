"""Bars of other people's programs: critical loads, torsion and pairs of modes, as a solid of the case file has them.

c12: column of CalculiX issue 74. c13: strip of MYSTRAN issue 130. c14: square bar of KoFEM pull request 297, by
Saint-Venant's 0.1406 a⁴ G / L. n_tube: a steel tube, whose modes come in pairs.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fem.beam import stepped_stiffness
from fem.euler import bending_of
from fem.mode_formulas import bending_modes
from pipeline.progress import Progress
from pipeline.validation.case import load_case
from pipeline.validation.detail import COARSE
from pipeline.validation.stages.buckling import modes_of
from pipeline.validation.stages.specimen import Specimen, specimen
from pipeline.validation.workshop import Workshop

DATA = Path(__file__).parent / "data"


def bar(case: str, folder: Path) -> Specimen:
    found, _ = specimen(
        load_case(str(DATA / case / "case.toml")), COARSE, Workshop(folder, Progress(quiet=True))
    )
    return found


@pytest.mark.parametrize(
    ("case", "loads"),
    # 480.6 kN by Euler less 0.2 % by shear; pi² EI / (2 L)² in both planes.
    [("c12_ccx74_column", (479.4e3, 479.4e3)), ("c13_mystran130_thin", (0.2285, 0.9139))],
)
def test_a_column_with_a_free_end(tmp_path: Path, case: str, loads: tuple[float, float]) -> None:
    s = bar(case, tmp_path)
    body, length = s.segments[0], s.bar.length
    stiffness = stepped_stiffness(s.segments)
    formulas = [
        bending_modes(bending_of(stiffness, length, plane, shear), plane, "free", 1)[0].load
        for plane, shear in (("xy", body.GAy), ("xz", body.GAz))
    ]
    # The strip of c13 is given without shear, 0.06 % of it.
    np.testing.assert_allclose(sorted(formulas), loads, rtol=1e-3)
    # Faces that cannot contract make its ends a little stiffer.
    modes = [mode.load for mode in modes_of(s.model, s.bar.length, "free", 2)]
    np.testing.assert_allclose(modes, loads, rtol=3e-3)


def test_a_square_bar_that_is_twisted(tmp_path: Path) -> None:
    s = bar("c14_square_torsion", tmp_path)
    shear = 210000.0 / (2.0 * 1.3)
    expected = 0.1406 * 100.0**4 * shear / 1000.0
    assert pytest.approx(expected, rel=5e-4) == s.segments[0].GJ / 1000.0
    # The ends do not warp, and a mesh of four cells across is 2 % stiff; never softer.
    assert 0.999 < s.model.stiffness[3, 3] / expected < 1.03


def test_guided_modes_of_a_tube_come_in_pairs(tmp_path: Path) -> None:
    s = bar("n_tube", tmp_path)
    loads = [mode.load for mode in modes_of(s.model, s.bar.length, "guided", 6)]
    np.testing.assert_allclose(loads[::2], loads[1::2], rtol=1e-3)
    assert len(loads) == 6
