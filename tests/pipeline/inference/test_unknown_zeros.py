"""Unknown zeros take what they can make of the residuals, no more, whatever they depend on."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import read
from pipeline.compare.error import Discrepancy
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from tests.pipeline.inference.manipulators import campaign


@pytest.mark.parametrize("order", [[0, 1, 2, 3, 4], [2, 0, 1, 3, 4], [3, 2, 4, 1, 0]])
def test_zeros_that_depend_on_each_other_take_their_span(order: list[int]) -> None:
    """Columns of five zeros: one of a channel without a reading, one that is the sum of two others."""
    found = unfitted(Model(), load_cases(campaign())).residual
    generator = np.random.default_rng(4)
    count = len(found.rows)
    columns = generator.normal(size=(count, 5))
    columns[:, 2], columns[:, 3] = 0.0, columns[:, 0] - 2.0 * columns[:, 1]
    offsets = np.zeros((*found.values.shape, 5))
    offsets[found.rows[:, 0], found.rows[:, 1]] = columns[:, order]
    values = generator.normal(size=count)
    whole = np.zeros(found.values.shape)
    whole[found.rows[:, 0], found.rows[:, 1]] = values
    best = np.linalg.lstsq(columns, values, rcond=1e-9)[0]
    it = replace(found, offsets=offsets, values=whole)
    np.testing.assert_allclose(it.free(it.values), values - columns @ best, atol=1e-12)
    assert it.zeros.shape == (count, 3)


def test_a_fit_and_its_table_have_one_chi_square(tmp_path: Path) -> None:
    """A bar of which not every channel is read in every test, its zeros all unknown."""
    (tmp_path / "campaign.toml").write_text(BAR)
    (tmp_path / "measurements.csv").write_text(ROWS)
    cases = load_cases(read(tmp_path))
    found = unfitted(Model(), cases)
    size = Discrepancy(cases, found.prediction).size()
    assert size is not None
    assert found.chi_square == pytest.approx(size.statistic, rel=1e-9)
    assert found.degrees == size.degrees


TEST = '\n[[tests]]\nid = "{0}"\nrole = "fit"\nzero = "fitted"\ncontrol = {{ x = "{1}", y = "force", z = "{2}" }}\n'
BAR = (
    """schema = 1
name = "zeros"

[rig]
kind = "bar"
length_mm = 200.0
bar = { EA_N = 6.12e5, EIy_Nmm2 = 1.62e6, EIz_Nmm2 = 3.645e5, GJ_Nmm2 = 8.91e4 }
tip = "guided"

[noise]
x_mm = 2e-3
z_mm = 2e-3
fx_N = 6.12
fy_N = 2.0
fz_N = 2.0
mx_Nmm = 0.01
mz_Nmm = 0.01
"""
    + TEST.format("a", "force", "displacement")
    + TEST.format("b", "displacement", "force")
)
ROWS = """test,step,x_mm,z_mm,fx_N,fy_N,fz_N,mx_Nmm,mz_Nmm
a,0,0,-0.001,-7.5,0.8,,-0.02,-0.01
a,1,0.196,-0.0005,608.8,-5.0,,-0.01,-0.006
a,2,-0.006,0.001,-20,0.1,,-0.005,-0.01
b,0,0.002,-0.0046,,,,,0.009
b,1,0.033,0.0012,,,,,
b,2,0.063,-0.0015,,,,,0.008
b,3,0.099,0.0013,,,,,-0.009
"""
