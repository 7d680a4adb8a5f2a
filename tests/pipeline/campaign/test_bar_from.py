"""`bar_from`: K_b, K_g and both bands of a computed bar are nominal values and tolerances of a campaign."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fem.beam import uniform_stiffness
from pipeline.campaign import BadCampaign, read, write
from pipeline.campaign.bar_from import bar_from
from pipeline.campaign.tolerance import SHARE
from pipeline.errors import InputError
from pipeline.init.command import init
from pipeline.simulate import sealed, simulate
from tests.conftest import ROOT
from vjm.refined import Refined

LENGTH = 250.0
K_B = uniform_stiffness(LENGTH, 5e6, 3e8, 8e7, 5e7)
CSV = "test,step,z_mm,fz_N\ntest-1,0,0.0,0.0\ntest-1,1,0.1,2.0\n"


def record(**changes: Any) -> dict[str, Any]:
    geometric = np.diag([1 / LENGTH, 1.2 / LENGTH, 1.2 / LENGTH, 36.0 / LENGTH, 33.0, 33.0])
    own = {
        "kind": "bar",
        "length_mm": LENGTH,
        "width_mm": 70.0,
        "stiffness": K_B.tolist(),
        "geometric": geometric.tolist(),
        "numerical_band": {"K11": 0.001, "K22": 0.002, "K26": 0.003, "K33": 0.001, "K44": 0.04},
        "modelling_band": {"K11": 0.03, "K66": 0.01, "K44": 0.3},
    }
    return {**own, **changes}


def written(folder: Path, kind: str = "parallelogram", **changes: Any) -> Path:
    """A campaign that `init` made from the record."""
    folder.mkdir(parents=True, exist_ok=True)
    source = folder / "bar.json"
    source.write_text(json.dumps(record(**changes)))
    out = folder / "campaign"
    init(out, None, kind, str(source))
    text = (out / "campaign.toml").read_text().replace('q_deg = "?"', "q_deg = 0.0")
    (out / "campaign.toml").write_text(text)
    (out / "measurements.csv").write_text(CSV)
    return out


@pytest.mark.parametrize("kind", ["bar", "parallelogram"])
def test_all_of_it_comes_from_the_file(kind: str, tmp_path: Path) -> None:
    out = written(tmp_path, kind)
    campaign = read(out)
    rig = campaign.rig
    np.testing.assert_array_equal(rig.stiffness, 0.5 * (K_B + K_B.T))
    assert rig.length == LENGTH and rig.spread == (70.0 if kind == "parallelogram" else None)
    # Root of the sum of squares of the usual 2 %, the mesh and the tie, each the largest of its entries.
    expected = {
        "EA": np.sqrt(0.02**2 + 0.001**2 + 0.03**2),
        "EIy": np.sqrt(0.02**2 + 0.001**2),
        "EIz": np.sqrt(0.02**2 + 0.003**2 + 0.01**2),
        "GJ": SHARE,
        "ends": 0.005,
    }
    assert {k: campaign.tolerance[k] for k in expected} == pytest.approx(expected)
    # K_g: the twist is stiffened as by this radius, r² = K_g44 L.
    assert rig.mechanism(()).refined().bar == Refined(polar_radius=6.0)
    assert any("bar.json adds its bands" in remark for remark in campaign.remarks)
    assert dict(campaign.digests).keys() == {"campaign.toml", "bar.json", "measurements.csv"}


def test_a_simulated_bench_keeps_the_file(tmp_path: Path) -> None:
    """Its bands stay those of a computation, which `predict` counts apart, and its K_g stays known."""
    source = written(tmp_path)
    simulate(tmp_path / "hidden", ("joint_friction",), 4, True, source)
    found, known = read(tmp_path / "hidden"), read(source)
    assert found.rig.computed_bands == known.rig.computed_bands and found.rig.computed_bands["EIz"] > 0.0
    assert found.tolerance == pytest.approx(known.tolerance)
    assert found.rig.mechanism(()).refined().bar == Refined(polar_radius=6.0)
    np.testing.assert_array_equal(found.rig.stiffness, known.rig.stiffness)
    assert (tmp_path / "hidden" / "bar.json").read_bytes() == (source / "bar.json").read_bytes()
    assert 'bar_from = "bar.json"' in (tmp_path / "hidden" / "campaign.toml").read_text()


def test_a_campaign_is_written_with_the_file_that_it_names(tmp_path: Path) -> None:
    campaign = read(written(tmp_path))
    write(tmp_path / "again", campaign)
    again = read(tmp_path / "again")
    assert again.rig.computed_bands == campaign.rig.computed_bands and again.tolerance == campaign.tolerance
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "bar.json").write_text("{}")
    with pytest.raises(InputError, match="is there already and is another file"):
        write(tmp_path / "other", campaign)
    assert sorted(p.name for p in (tmp_path / "other").iterdir()) == ["bar.json"]


def test_what_a_campaign_says_itself_counts(tmp_path: Path) -> None:
    out = written(tmp_path)
    path = out / "campaign.toml"
    path.write_text(path.read_text().replace("[tolerance] ", "[tolerance]\nbar = { EA = 0.01 } #"))
    found = read(out).tolerance
    assert found["EA"] == 0.01 and found["GJ"] == SHARE


def test_the_shipped_result_of_run() -> None:
    path = ROOT / "reports" / "validation" / "result.json"
    found = bar_from(path)
    raw = json.loads(path.read_text())["bar"]
    np.testing.assert_allclose(found.stiffness, raw["stiffness"])
    assert found.numerical["GJ"] == raw["convergence"]["band"]["K44"]
    assert found.polar_radius == pytest.approx(np.sqrt(raw["axial"]["solid"][3][3] * 310.0))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"length_mm": 0.0}, "its length is 0 mm"),
        ({"stiffness": (-K_B).tolist()}, "its stiffness K55 is"),
        ({"stiffness": "none"}, "is no result of run or bar"),
        ({"numerical_band": None}, "is no result of run or bar"),
        ({"kind": "else"}, "is no result of run or bar"),
    ],
)
def test_what_is_no_bar_is_a_sentence(changes: dict[str, Any], said: str, tmp_path: Path) -> None:
    path = tmp_path / "bar.json"
    path.write_text(json.dumps(record(**changes)))
    with pytest.raises(InputError, match=said):
        bar_from(path)


def test_a_length_that_is_not_the_bars_and_a_file_that_is_not_there(tmp_path: Path) -> None:
    out = written(tmp_path)
    path = out / "campaign.toml"
    text = path.read_text()
    path.write_text(text.replace("length_mm = 250.0", "length_mm = 251.0"))
    with pytest.raises(
        BadCampaign, match=r"campaign.toml line \d+, rig.bar_from: .*bar of 250 mm, but length_mm is 251"
    ):
        read(out)
    path.write_text(text.replace('"bar.json"', '"other.json"'))
    with pytest.raises(BadCampaign, match=r"rig.bar_from: .*other.json: is missing"):
        read(out)
    path.write_text(text.replace("\nbar_from", "\nbar_stiffness = [[1.0]]\nbar_from"))
    with pytest.raises(BadCampaign, match="bar_stiffness"):
        read(out)


@pytest.mark.long
def test_a_virtual_bench_of_that_rig_feels_its_bars(tmp_path: Path) -> None:
    """From a campaign that is not filled in, and from the record itself: the same bench."""
    folder = written(tmp_path)
    text = (folder / "campaign.toml").read_text().replace("q_deg = 0.0", 'q_deg = "?"')
    (folder / "campaign.toml").write_text(text)
    one = simulate(tmp_path / "one", [], 1, True, folder)
    other = simulate(tmp_path / "other", [], 1, True, tmp_path / "bar.json")
    assert (tmp_path / "one" / "measurements.csv").read_bytes() == (
        tmp_path / "other" / "measurements.csv"
    ).read_bytes()
    np.testing.assert_allclose(one.rig.stiffness, K_B, atol=1e-9 * K_B.max())
    data = one.tests[0].data
    assert np.polyfit(data.wrench[:, 0], data.displacement[:, 0], 1)[0] == pytest.approx(
        LENGTH / 1e7, rel=0.02
    )
    assert json.loads(sealed(tmp_path / "other").read_text())["rig"] == str(tmp_path / "bar.json")
    assert [t.id for t in other.tests] == [t.id for t in one.tests]


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("nowhere", "is missing"),
        ("bar", "rig.kind is 'bar', allowed is"),
        ("narrow.json", "says no width"),
    ],
)
def test_a_bench_that_cannot_be_had(source: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "bar").mkdir()
    (tmp_path / "bar" / "campaign.toml").write_text('[rig]\nkind = "bar"\n')
    (tmp_path / "narrow.json").write_text(json.dumps(record(width_mm=None)))
    with pytest.raises(InputError, match=said):
        simulate(tmp_path / "out", [], 1, True, tmp_path / source)
    assert not (tmp_path / "out").exists()
