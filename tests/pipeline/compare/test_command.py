"""The command compare from a folder to the terminal and a file, and what it finds on virtual benches."""

import shutil
from io import StringIO
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console
from typer.testing import CliRunner

from pipeline.campaign import write
from pipeline.cli import app
from pipeline.compare.command import compare
from pipeline.compare.models import compare_models
from pipeline.compare.record import Comparison
from pipeline.compare.table import page, sentence
from pipeline.errors import InputError
from pipeline.inference.model import Model
from pipeline.terminal import WIDTH
from tests.pipeline.bench import bench
from tests.studio.ahead import unmeasured
from vjm.effects import catalogue

FRICTION = bench("joint_friction.torque_Nmm", 800.0)


@pytest.fixture(scope="module")
def plain() -> Comparison:
    return compare_models(FRICTION)


def shown(result: Comparison) -> str:
    console = Console(width=WIDTH, record=True, file=StringIO(), highlight=False)
    console.print(page(result))
    return console.export_text()


def test_the_finite_elements_lack_friction_only(plain: Comparison) -> None:
    """FEA has the geometry of the truth: noise in the tests without swing; LIN and VJM fail sideways as well."""
    fea = plain.model_of("fea")
    for test in fea.tests:
        if test.test.startswith(("axial", "lateral")):
            # 84 residuals: standard deviation 0.08; friction itself loads the axial tests by a few newtons.
            assert test.rms is not None and test.rms < 1.5
        else:
            assert test.rms is not None and test.rms > 3.0
    told = [each for each in fea.findings if each.sentence]
    assert told[0].channel == "fz" and told[0].number == "loop" and told[0].group == "swing"
    for key in ("lin", "vjm"):
        lateral = next(t for t in plain.model_of(key).tests if t.test == "lateral_q+0")
        assert lateral.rms is not None and lateral.rms > 5.0
        assert not plain.model_of(key).within_noise
    assert plain.shown == "vjm" and fea.holdout is not None and fea.holdout < 1.5


def test_without_an_error_the_finite_elements_are_within_the_noise() -> None:
    fea = compare_models(bench()).model_of("fea")
    assert fea.within_noise and fea.findings == () and fea.looks > 100
    assert fea.degrees == sum(c.readings for c in fea.channels.values())


def test_a_saved_model_stands_beside_the_base_models() -> None:
    """Its numbers were fitted, which costs degrees of freedom; its failure is the one that is told."""
    effect = catalogue()["joint_torsional_stiffness"]
    saved = Model().with_effects([effect])
    result = compare_models(FRICTION, saved)
    assert [m.model for m in result.models] == ["lin", "vjm", "saved", "fea"] and result.shown == "saved"
    assert result.model_of("saved").degrees == result.model_of("vjm").degrees - 1
    assert result.model_of("saved").effects == ("joint_torsional_stiffness",)


@pytest.mark.long
def test_a_saved_play_is_compared_as_it_is_fitted() -> None:
    """A force near zero, read with more noise than the play needs, puts each row on the side where it was."""
    known = catalogue()
    saved = Model().with_effects([known["bar_geometric_nonlinearity"], known["joint_clearance"]])
    campaign = bench("joint_clearance.play_mm", 0.01)
    found = compare_models(campaign, saved.at(np.array([0.01]))).model_of("saved")
    assert found.within_noise and found.fit is not None and found.fit < 1.1


def test_the_terminal_fits_and_shows_every_test(plain: Comparison) -> None:
    text = shown(plain)
    assert max(map(len, text.splitlines())) <= WIDTH
    for test in FRICTION.tests:
        assert text.count(test.id) >= 2
    assert "(held out)" in text and "loop of" in text and "LIN" in text and "µm" in text


def test_the_command_writes_a_result_and_leaves_the_campaign(tmp_path: Path) -> None:
    folder = tmp_path / "campaign"
    write(folder, FRICTION)
    before = {p.name: p.read_bytes() for p in folder.iterdir()}
    ran = CliRunner().invoke(
        app, ["compare", str(folder), "--json", str(tmp_path / "one.json"), "--out", str(tmp_path / "out")]
    )
    assert ran.exit_code == 0, ran.output
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == before
    texts = [(tmp_path / "one.json").read_text(), (tmp_path / "out" / "comparison.json").read_text()]
    assert texts[0] == texts[1]
    read = Comparison.model_validate_json(texts[0])
    assert read.tests == len(FRICTION.tests) and read.model_dump_json(indent=1) == texts[0]
    quiet = CliRunner().invoke(app, ["compare", str(folder), "--quiet"])
    assert quiet.exit_code == 0 and len(quiet.output.splitlines()) == 1 and "not within" in quiet.output


def test_bad_input_is_one_sentence_and_exit_code_2(tmp_path: Path) -> None:
    folder = tmp_path / "campaign"
    write(folder, FRICTION)
    (tmp_path / "bad.toml").write_text("schema = 1\nbase = 'vjm'\n[[effects]]\nname = 'joint_fiction'\n")
    for arguments in (
        [str(tmp_path / "none")],
        [str(folder), "--model", str(tmp_path / "none.toml")],
        [str(folder), "--model", str(tmp_path / "bad.toml")],
        [str(folder), "--effects-from", str(tmp_path / "none.py")],
        [str(folder), "--json", str(folder / "campaign.toml")],
    ):
        ran = CliRunner().invoke(app, ["compare", *arguments])
        assert ran.exit_code == 2 and "Traceback" not in ran.output, arguments
        assert "error: " in ran.output and len(ran.output) < 600


@pytest.mark.long
def test_absurd_but_valid_numbers_are_lost_or_failed_with_a_reason(tmp_path: Path) -> None:
    """Loads a hundred thousand times those that buckle the bars: reasons, and no number that is none."""
    folder = tmp_path / "campaign"
    write(folder, FRICTION)
    text = (folder / "measurements.csv").read_text().splitlines()
    column = text[0].split(",").index("fx_N")
    rows = [line.split(",") for line in text]
    for row in rows[1:20]:
        row[column] = "-1e9"
    (folder / "measurements.csv").write_text("\n".join(",".join(row) for row in rows) + "\n")
    result = compare(folder, quiet=True)
    for model in result.models:
        assert model.failed or model.lost
        assert all(lost.reason for lost in model.lost)
    assert "NaN" not in result.model_dump_json() and "Infinity" not in result.model_dump_json()
    shutil.rmtree(folder)
    with pytest.raises(InputError, match="does not exist"):
        compare(folder, quiet=True)


def test_what_is_not_measured_yet_is_no_agreement() -> None:
    found = compare_models(unmeasured())
    assert not any(model.within_noise for model in found.models)
    assert "not measured yet" in sentence(found)
    out = StringIO()
    Console(file=out, width=WIDTH).print(page(found))
    assert "not measured yet" in out.getvalue() and "nothing beyond what noise gives" not in out.getvalue()
