"""The command simulate: a campaign that can be read, a sealed answer, and nothing told."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from pipeline.campaign import read
from pipeline.cli import app
from pipeline.errors import InputError
from pipeline.simulate import sealed, simulate


def test_a_campaign_and_its_answer(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "hidden-01"
    campaign = simulate(out, ["modulus_error=1.07", "bar_initial_bow.bow_y_mm=0.4"], seed=3, quiet=True)
    said = capsys.readouterr().out
    assert str(sealed(out)) in said and not any(word in said for word in ("modulus", "bow", "1.07", "0.4"))
    answer = json.loads(sealed(out).read_text())
    assert answer["effects"] == ["modulus_error", "bar_initial_bow"] and answer["seed"] == 3
    assert answer["parameters"]["modulus_error.scale"] == 1.07
    assert answer["parameters"]["bar_initial_bow.bow_z_mm"] == 0.0
    assert answer["commit"] and answer["versions"]["numpy"] == np.__version__
    found = read(out)
    assert found.remarks == () and [t.id for t in found.tests] == [t.id for t in campaign.tests]
    assert np.array_equal(found.tests[0].data.wrench, campaign.tests[0].data.wrench)
    text = (out / "campaign.toml").read_text() + (out / "measurements.csv").read_text()
    assert "modulus" not in text and "bow" not in text
    # The stiffness is felt: 7 % of the sag under 4 kN against a noise of 1 µm.
    x, fx = found.tests[0].data.displacement[:, 0], found.tests[0].data.wrench[:, 0]
    assert np.polyfit(fx, x, 1)[0] == pytest.approx(1.0 / (1.07 * 4.4e4), rel=0.01)


def test_the_seed_is_all_that_is_random_and_nothing_is_overwritten(tmp_path: Path) -> None:
    texts = []
    for name, seed in (("a", 1), ("b", 1), ("c", 2)):
        simulate(tmp_path / name / "x", ["load_offset"], seed, quiet=True)
        texts.append((tmp_path / name / "x" / "measurements.csv").read_text())
    assert texts[0] == texts[1] != texts[2]
    one, other = (json.loads((tmp_path / n / "x.sealed.json").read_text())["parameters"] for n in "ac")
    assert one != other
    with pytest.raises(InputError, match="exists, allowed is a folder without a campaign"):
        simulate(tmp_path / "a" / "x", [], 1, quiet=True)
    (tmp_path / "a" / "x" / "campaign.toml").unlink()
    (tmp_path / "a" / "x" / "measurements.csv").unlink()
    with pytest.raises(InputError, match=r"x.sealed.json exists"):
        simulate(tmp_path / "a" / "x", [], 1, quiet=True)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("joint_fiction", "did you mean 'joint_friction'"),
        ("joint_friction.torque=3", "did you mean 'torque_Nmm'"),
        ("joint_friction=abc", "torque_Nmm is abc, allowed are numbers from 0"),
        ("joint_friction=", "torque_Nmm is empty"),
        ("modulus_error=9", "allowed are numbers from 0.3 to 3"),
        ("modulus_error=nan", "scale is nan"),
        ("joint_friction.torque_Nmm", "has no value"),
        ("bar_geometric_nonlinearity=1", "is there or not"),
    ],
)
def test_what_cannot_be_hidden_is_one_sentence(tmp_path: Path, asked: str, said: str) -> None:
    ran = CliRunner().invoke(app, ["simulate", str(tmp_path / "out"), "--effect", asked])
    assert ran.exit_code == 2 and said in ran.output and list(tmp_path.iterdir()) == []


def test_what_the_bench_does_not_survive_is_exit_code_3(tmp_path: Path) -> None:
    """Bars at a third of their stiffness buckle under the axial tests of 4 kN: 9.2 kN / 3 guided."""
    ran = CliRunner().invoke(app, ["simulate", str(tmp_path / "out"), "--effect", "modulus_error=0.3"])
    assert ran.exit_code == 3 and "buckled" in ran.output and list(tmp_path.iterdir()) == []
