"""`python -m pipeline add`: the model is kept with the campaign, and nothing else there is touched."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from pipeline.add.command import add_effects
from pipeline.campaign import write
from pipeline.errors import InputError
from pipeline.inference.model_reading import read_model_file
from tests.conftest import Done
from tests.pipeline.bench import bench
from tests.pipeline.campaign.example import BAR, BAR_CSV, laid

OWN = """
from vjm.effects.base import Effect, Parameter, for_bars

class Softened(Effect):
    name = "softened_bars"
    title = equation = signature = limits = source = "for a test"
    parameters = (Parameter("share", "1", 0.0, 0.05, -0.5, 0.5, "of the stiffness that is missing"),)

    def change(self, rig, values):
        return for_bars(rig, lambda link: link.stiffened(1.0 - values["share"]))
"""


def contents(folder: Path) -> dict[str, bytes]:
    return {p.name: p.read_bytes() for p in folder.iterdir() if p.name != "model.toml"}


def test_effects_are_added_one_after_the_other(
    pipeline_command: Callable[..., Done], command_here: Callable[..., Done], tmp_path: Path
) -> None:
    folder = tmp_path / "bench"
    write(folder, bench("modulus_error.scale", 0.95))
    before = contents(folder)
    done = pipeline_command("add", "bench", "bar_geometric_nonlinearity", "--quiet", cwd=tmp_path)
    assert done.code == 0 and done.out.startswith("unknown: what is left is no noise"), done.err
    done = command_here("add", "bench", "modulus_error", "--json", "a.json", "--out", "o", cwd=tmp_path)
    assert done.code == 0 and not done.err
    assert "within_noise: " in done.out and "next: python -m pipeline compare bench" in done.out
    saved = read_model_file(folder / "model.toml")
    assert saved.model.names == ("bar_geometric_nonlinearity", "modulus_error")
    answer = json.loads((tmp_path / "a.json").read_text())
    assert answer == json.loads((tmp_path / "o" / "answer.json").read_text())
    value = answer["parameters"]["modulus_error.scale"]
    assert saved.model.values.tolist() == [value["value"]]
    assert saved.uncertainty["modulus_error.scale"].low95 == value["low95"]
    assert saved.campaign == "small" and saved.versions["numpy"]
    assert contents(folder) == before
    done = command_here("add", "bench", "modulus_error", cwd=tmp_path)
    assert (
        done.code == 2 and "modulus_error is in the model already" in done.err and "Traceback" not in done.err
    )


def test_an_effect_of_ones_own_is_added_and_remembered(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(OWN)
    folder = tmp_path / "bench"
    write(folder, bench("modulus_error.scale", 0.95))
    add_effects(folder, ["softened_bars"], effects_from=[tmp_path / "own.py"], quiet=True)
    assert 'effects_from = ["../own.py"]' in (folder / "model.toml").read_text()
    # The file is found from the model alone.
    add_effects(folder, ["bar_geometric_nonlinearity"], quiet=True)
    saved = read_model_file(folder / "model.toml")
    share, it = saved.model.values[0], saved.uncertainty["softened_bars.share"]
    assert it.std is not None and abs(share - 0.05) < 4.0 * it.std


def test_an_effect_of_ones_own_that_fails_is_said(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(OWN.replace('values["share"]', 'values["shre"]'))
    folder = tmp_path / "bench"
    write(folder, bench())
    with pytest.raises(InputError, match="softened_bars cannot be applied to the rig: KeyError: 'shre'"):
        add_effects(folder, ["softened_bars"], effects_from=[tmp_path / "own.py"], quiet=True)
    assert not (folder / "model.toml").exists()


BAD = {
    "unknown": (["joint_frction"], "effect 'joint_frction' is unknown, did you mean 'joint_friction'?"),
    "nothing near": (["magic"], "effect 'magic' is unknown, allowed: actuator_compliance, "),
    "twice": (["load_offset", "load_offset"], "effect load_offset is named twice, allowed is each once"),
    "rig": (
        ["joint_friction", "bar_length_mismatch"],
        "bar_length_mismatch needs a rig of kind parallelogram",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_names_are_refused_and_nothing_is_written(case: str, tmp_path: Path) -> None:
    names, said = BAD[case]
    folder = laid(tmp_path / "ruler", BAR, BAR_CSV)
    with pytest.raises(InputError) as caught:
        add_effects(folder, names, quiet=True)
    assert said in str(caught.value)
    assert sorted(p.name for p in folder.iterdir()) == ["campaign.toml", "measurements.csv"]


def test_a_model_elsewhere_is_the_start_and_is_left_alone(tmp_path: Path) -> None:
    folder, other = tmp_path / "bench", tmp_path / "other.toml"
    write(folder, bench("modulus_error.scale", 0.95))
    other.write_text(
        'schema = 1\nbase = "vjm"\nfixed = ["modulus_error.scale"]\n'
        '[[effects]]\nname = "modulus_error"\n[effects.values]\nscale = 0.95\n'
    )
    text = other.read_text()
    add_effects(folder, ["bar_geometric_nonlinearity"], model_file=other, quiet=True)
    saved = read_model_file(folder / "model.toml")
    assert saved.model.terms[0].values == {"scale": 0.95} and saved.model.fixed == {"modulus_error.scale"}
    assert other.read_text() == text
    with pytest.raises(InputError, match=r"gone\.toml: is missing"):
        add_effects(folder, ["load_offset"], model_file=tmp_path / "gone.toml", quiet=True)
