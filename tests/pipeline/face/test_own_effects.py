"""Effects of one's own in Python: given as they are or by their file, pickled, saved with a model."""

from __future__ import annotations

import pickle
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

import parastiff
from parastiff import Effect, InputError, Parameter
from pipeline.face.about import subject_of
from tests.pipeline.face.results import ONE_STEP, bench

FILE = """from dataclasses import replace

from parastiff import Effect, Parameter, for_bars


class SofterBars(Effect):
    name, title, equation = "softer_bars", "bars are softer", "K = s K_b"
    signature, limits, source = "all slopes fall alike", "none", "for a test"
    parameters = (Parameter("s", "1", 1.0, 0.1, 0.01, 10.0, "factor"),)

    def change(self, rig, values):
        return for_bars(rig, lambda link: replace(link, stiffness=values["s"] * link.stiffness))
"""


class Own(Effect):
    """In memory alone."""

    name, title, equation = "own_softness", "bars are softer", "K = s K_b"
    signature, limits, source = "all slopes fall alike", "none", "for a test"
    parameters = (Parameter("s", "1", 1.0, 0.1, 0.01, 10.0, "factor"),)

    def change(self, rig: parastiff.Effect, values: Mapping[str, float]) -> object:  # type: ignore[override]
        return parastiff.for_bars(rig, lambda link: replace(link, stiffness=values["s"] * link.stiffness))  # type: ignore[arg-type]


class Taken(Own):
    """Has the name of another one."""

    name = "modulus_error"


def test_an_effect_is_given_as_it_is_or_by_its_file(tmp_path: Path) -> None:
    file = tmp_path / "softer.py"
    file.write_text(FILE, encoding="utf-8")
    by_file = parastiff.open(ONE_STEP, effects=[file]).add("softer_bars")
    by_itself = bench().add(Own())
    shipped = bench().add("modulus_error")
    for it in (by_file, by_itself):
        assert it.answer.error[-1].fit == pytest.approx(shipped.answer.error[-1].fit, rel=1e-6)
    place = by_file.save_model(tmp_path / "model.toml")
    assert parastiff.open(ONE_STEP, model=place).model.names == ("softer_bars",)
    with pytest.raises(InputError, match="own_softness is defined in no file"):
        by_itself.save_model(tmp_path / "other.toml")
    # In another process the module of the file is not there.
    packed = pickle.dumps(by_file)
    del sys.modules["user_effects_softer"]
    assert pickle.loads(packed) == by_file
    assert pickle.loads(pickle.dumps(by_itself)) == by_itself


def test_a_name_that_is_taken_is_refused() -> None:
    with pytest.raises(InputError, match="modulus_error is taken"):
        bench().add(Taken())
    with pytest.raises(InputError, match="effect 'modulus_eror' is unknown"):
        bench().add("modulus_eror")
    with pytest.raises(InputError, match=r"\['modulus_error'\] is no effect, allowed are names and effects"):
        bench().add(["modulus_error"])


def test_effects_are_taken_out_again() -> None:
    it = bench().add("modulus_error")
    assert parastiff.remove(it, "modulus_error").model.names == ()
    assert subject_of(it).model.names == ("modulus_error",)
    with pytest.raises(InputError, match="self_weight is not in the model"):
        parastiff.remove(it, "self_weight")
