"""The catalogue and its pages on the terminal."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from pipeline.cli import app
from pipeline.terminal import WIDTH
from vjm.effects import catalogue

OWN = '''
from vjm.effects.base import Effect, Parameter

class Drift(Effect):
    """Own."""
    name = "own_drift"
    title = "a drift of one's own"
    equation = "x -> x + drift"
    signature = "grows"
    limits = "none"
    source = "a test"
    parameters = (Parameter("rate", "mm/step", 0.0, 0.1, -1.0, 1.0, "per step"),)

    def change(self, rig, values):
        return rig
'''


def output(*arguments: str, code: int = 0) -> str:
    ran = CliRunner().invoke(app, ["effects", *arguments])
    assert ran.exit_code == code, ran.output
    assert max(map(len, ran.output.splitlines())) <= WIDTH or code
    return ran.output


def test_the_table_has_every_effect_and_parameter() -> None:
    text = output()
    for name, effect in catalogue().items():
        assert name in text
        assert all(parameter.name in text for parameter in effect.parameters)


@pytest.mark.parametrize("name", sorted(catalogue()))
def test_a_page_says_everything(name: str) -> None:
    text = " ".join(output(name).split())
    effect = catalogue()[name]
    for said in (effect.title, effect.equation, effect.signature, effect.limits, effect.source):
        assert " ".join(said.split()) in text
    assert f"vjm/effects/{name}.py" in text
    for p in effect.parameters:
        assert p.name in text and f"{p.low:.6g}" in text and f"{p.high:.6g}" in text


def test_a_wrong_name_is_answered_with_the_right_one() -> None:
    assert "did you mean 'joint_friction'?" in output("joint_fiction", code=2)
    assert "allowed: actuator_compliance, " in output("zzz", code=2)


def test_an_effect_of_ones_own(tmp_path: Path) -> None:
    file = tmp_path / "own.py"
    file.write_text(OWN)
    assert "rate [mm/step]" in output("--effects-from", str(file))
    assert str(file) in output("own_drift", "--effects-from", str(file)).replace("\n  ", "")
    assert "no file" in output("--effects-from", str(tmp_path / "none.py"), code=2)
