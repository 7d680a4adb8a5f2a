"""A dial on the platform: what it reads by beam theory, and what its entry may say."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import BadCampaign, Campaign, read, write
from pipeline.compare.models import compare_models

EI, LENGTH, ARM, SIGMA = 1.04e8, 300.0, (50.0, 0.0, 0.0), 1e-3
HEAD = f"""schema = 1
name = "two dials"

[rig]
kind = "bar"
length_mm = {LENGTH}
bar = {{ EA_N = 1.3e7, EIy_Nmm2 = {EI}, EIz_Nmm2 = 1.04e9, GJ_Nmm2 = 1.56e8 }}

[noise]
near_mm = {SIGMA}
far_mm = {SIGMA}
fz_N = 1e-4
"""
GAUGE = '\n[[gauges]]\nname = "{name}"\non = "platform"\noffset_mm = [{x}, 0.0, 0.0]\ndirection = "z"\n'
GAUGES = GAUGE.format(name="near", x=0.0) + GAUGE.format(name="far", x=ARM[0])
TEST = """
[[tests]]
id = "load"
role = "fit"
control = { x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }
"""


def campaign(folder: Path, gauges: str = GAUGES, head: str = HEAD) -> Campaign:
    """Deflection F L³/(3 EI) and slope F L²/(2 EI) of a cantilever under a force at its tip, read with 1 µm."""
    force = np.linspace(-20.0, 20.0, 21)
    near = force * LENGTH**3 / (3.0 * EI)
    far = near + ARM[0] * force * LENGTH**2 / (2.0 * EI)
    near, far = (
        it + SIGMA * np.random.default_rng(seed).normal(size=21) for seed, it in enumerate((near, far))
    )
    rows = "".join(
        f"load,{k},{float(near[k])!r},{float(far[k])!r},{float(force[k])!r}\n" for k in range(force.size)
    )
    (folder / "campaign.toml").write_text(head + gauges + TEST)
    (folder / "measurements.csv").write_text("test,step,near_mm,far_mm,fz_N\n" + rows)
    return read(folder)


def test_two_dials_on_a_tip_see_its_deflection_and_its_slope(tmp_path: Path) -> None:
    it = compare_models(campaign(tmp_path))
    # 42 readings of unit variance: the root mean square scatters by 11 % about 1.
    assert {model.model: 0.7 < model.fit < 1.3 for model in it.models} == dict.fromkeys(
        ("lin", "vjm", "fea"), True
    )


def test_a_campaign_with_a_dial_on_the_platform_is_written_and_read_again(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    first = campaign(tmp_path / "a")
    write(tmp_path / "b", first)
    again = read(tmp_path / "b")
    assert again.gauges == first.gauges and again.gauges[1].offset == ARM
    np.testing.assert_array_equal(again.tests[0].data.gauges, first.tests[0].data.gauges)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("offset_mm = [50.0, 0.0, 0.0]\n", "", "offset_mm is missing, a gauge on the platform needs it"),
        ("offset_mm = [50.0, 0.0, 0.0]", "offset_mm = [50.0, 0.0]", "offset_mm.2: is missing"),
        ("offset_mm = [50.0, 0.0, 0.0]", "station = 1.0\noffset_mm = [50.0, 0.0, 0.0]", "bar or station is given"),
        ('on = "platform"\noffset_mm = [50.0', 'offset_mm = [50.0', "station is missing, a gauge on a bar needs it"),
        ('on = "platform"\noffset_mm = [50.0', 'station = 1.0\noffset_mm = [50.0', 'only with on = "platform"'),
        ('name = "far"\non = "platform"', 'name = "far"\non = "base"', "on: is 'base', allowed is: 'bar' or"),
    ],
)  # fmt: skip
def test_an_entry_that_has_no_place_is_said(tmp_path: Path, old: str, new: str, said: str) -> None:
    assert GAUGES.count(old) == 1
    with pytest.raises(BadCampaign, match="gauge 'far'") as caught:
        campaign(tmp_path, GAUGES.replace(old, new))
    assert said in str(caught.value), caught.value
