"""A base that is far softer than usual, under a linkage whose own stiffness is small in that direction."""

from __future__ import annotations

import pytest

from pipeline.inference.model import Model
from pipeline.selection.diagnosis import diagnose
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

RZ = "base_compliance.rz_rad_per_Nmm"


@pytest.mark.parametrize("compliance", [3e-7, pytest.param(1e-6, marks=pytest.mark.long)])
def test_a_base_hundreds_of_times_softer_than_usual_is_named_and_certain(compliance: float) -> None:
    """No sum of a bow, a section and a load in its place, of which every number is of a usual size."""
    found = diagnose(bench(RZ, compliance), Model(), catalogue())
    typical = next(p for p in catalogue()["base_compliance"].parameters if p.name == "rz_rad_per_Nmm").typical
    assert compliance > 100.0 * typical
    assert found.verdict == "identified"
    assert [set(names) for names in found.sets] == [{"bar_geometric_nonlinearity", "base_compliance"}]
    assert found.certain == ("base_compliance",)
    values = dict(zip((f.name for f in found.fit.model.free), found.fit.model.values, strict=True))
    assert values[RZ] == pytest.approx(compliance, rel=0.02)
