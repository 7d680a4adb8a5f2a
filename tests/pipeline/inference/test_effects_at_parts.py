"""Effects of single parts by name, effect@tags, in models, their files and on rigs."""

from pathlib import Path

import numpy as np
import pytest

from pipeline.errors import InputError
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model, Term
from pipeline.inference.model_file import ModelFile, write_model
from pipeline.inference.model_reading import read_model_file
from pipeline.inference.prediction import predict
from pipeline.inference.suitable import check_suitable, known_effects, named_effects, scale_for
from tests.pipeline.bench import bench
from vjm.effects import catalogue, effect_of
from vjm.effects.base import Effect
from vjm.effects.sized import all_sized, sized

SITES = ("1.base", "1.tip", "2.base", "2.tip")
USER = """
from dataclasses import replace

from parastiff import Effect, Parameter


class Spring(Effect):
    name = "own_spring"
    title = "a spring"
    equation = "M = k x turn"
    signature = "a slope"
    limits = "none"
    source = "ours"
    parameters = (Parameter("stiffness_Nmm_per_rad", "N·mm/rad", 0.0, 1e3, 0.0, 1e6, "of one hinge"),)
    hinge = "any"

    def change(self, rig, values):
        return rig
"""


def joint_friction(name: str, torque: float) -> Term:
    return Term(effect_of(name, catalogue()), {"torque_Nmm": torque, "presliding_rad": 0.002})


def test_four_hinges_one_by_one_are_all_alike() -> None:
    cases = load_cases(bench())
    alone = Model(tuple(joint_friction(f"joint_friction@{site}", 500.0) for site in SITES))
    alike = Model((joint_friction("joint_friction", 500.0),))
    one, other = (predict(model, cases, slopes=False).values for model in (alone, alike))
    assert np.array_equal(one, other)
    half = predict(Model((joint_friction("joint_friction@tip", 500.0),)), cases, slopes=False).values
    assert not np.array_equal(half, other)


def test_a_model_file_names_the_parts(tmp_path: Path) -> None:
    model = Model(
        tuple(joint_friction(f"joint_friction@{site}", 500.0) for site in ("1.tip", "base")),
        frozenset({"joint_friction@1.tip.presliding_rad"}),
    )
    write_model(tmp_path / "model.toml", ModelFile(model))
    again = read_model_file(tmp_path / "model.toml").model
    assert again.names == ("joint_friction@1.tip", "joint_friction@base")
    assert [free.name for free in again.free] == [free.name for free in model.free]
    assert again.values.tolist() == model.values.tolist()
    assert [term.effect.tags for term in again.terms] == ["1.tip", "base"]


def test_it_has_the_sizes_of_the_rig_and_keeps_its_parts() -> None:
    """All numbers twice as large by their unit."""
    scale = scale_for(bench())
    it = sized(effect_of("joint_friction@tip", all_sized(catalogue(), scale)), scale)
    assert it.parameters == sized(catalogue()["joint_friction"], scale).parameters
    assert it.sized_by(lambda *_: 2.0).parameters[0].typical == 2.0 * it.parameters[0].typical
    assert it.name == it.sized_by(lambda *_: 2.0).name == "joint_friction@tip"
    assert it.tags == "tip"


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("joint_friction@nose", r"no part is at 'nose', allowed are some of the tags of: 1\.base, 1\.tip"),
        ("self_weight@1", "no part is at '1': what acts there acts on the whole, without a site"),
        ("joint_friction@", "effect 'joint_friction@' is unknown, did you mean 'joint_friction'"),
        ("joint_friction@.tip", "effect 'joint_friction@.tip' is unknown"),
    ],
)
def test_parts_that_are_none_are_said(name: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        check_suitable(named_effects([name], catalogue()), bench())


def test_a_users_effect_is_taken_to_one_hinge_with_its_file(tmp_path: Path) -> None:
    path = tmp_path / "own.py"
    path.write_text(USER, encoding="utf-8")
    known = known_effects([path])
    it: Effect = effect_of("own_spring@base", known.effects)
    assert it.tags == "base"
    assert known.files_of([it.name]) == (path,)
