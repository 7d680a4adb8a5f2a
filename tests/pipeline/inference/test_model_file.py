"""model.toml: what is written is read again to the last bit, and every mistake is named with its line."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pipeline.campaign import BarRig, ParallelogramRig
from pipeline.errors import InputError
from pipeline.inference.model import Model, Term
from pipeline.inference.model_file import ModelFile, Uncertainty, model_text, write_model
from pipeline.inference.model_reading import read_model_file
from pipeline.inference.suitable import Known, known_effects
from vjm.effects.base import Effect
from vjm.tolerances import tolerances

KNOWN = known_effects()
USER = """
from vjm.effects.base import Effect, Parameter

class Halved(Effect):
    name = "halved_bars"
    title = "bars\\nof half the stiffness"
    equation = signature = limits = source = "for a test"
    parameters = (Parameter("share", "1", 1.0, -0.5, 0.1, 2.0, "of the\\nstiffness"),)

    def change(self, rig, values):
        return rig.altered(lambda number, link: link.stiffened(values["share"]))
"""
TOML = """schema = 1
base = "vjm"
fixed = ["joint_friction.presliding_rad"]

[[effects]]
name = "bar_geometric_nonlinearity"

[[effects]]
name = "joint_friction"

[effects.values]
torque_Nmm = 350
presliding_rad = 0.002

[effects.errors]
torque_Nmm = {std = 5.5, low95 = 340.0}
"""

floats = st.floats(allow_nan=False, allow_infinity=False)
perhaps = st.none() | floats


@st.composite
def terms(draw: st.DrawFn, effect: Effect) -> Term:
    return Term(effect, {p.name: draw(st.floats(p.low, p.high)) for p in effect.parameters})


@st.composite
def model_files(draw: st.DrawFn) -> ModelFile:
    chosen = draw(st.lists(st.sampled_from(sorted(KNOWN.effects)), unique=True, max_size=6))
    model = Model(tuple(draw(terms(KNOWN.effects[name])) for name in chosen))
    names = [free.name for free in model.free]
    some = st.sets(st.sampled_from(names)) if names else st.just(set())
    uncertainty = {
        name: Uncertainty(draw(perhaps), draw(perhaps), draw(perhaps)) for name in sorted(draw(some))
    }
    written = draw(st.lists(st.sampled_from(tolerances()), unique=True, max_size=2))
    nominals = tuple(draw(terms(it)) for it in written)
    return ModelFile(
        Model(model.terms, frozenset(draw(some)), nominals),
        uncertainty,
        (),
        draw(st.text(st.characters(codec="utf-8"), max_size=20)),
        draw(st.text("0123456789abcdef+", max_size=13)),
        draw(st.dictionaries(st.sampled_from(["numpy", "scikit-fem"]), st.text("0.123", max_size=5))),
    )


@settings(max_examples=60, deadline=None)
@given(model_files())
def test_a_file_gives_back_the_same_model_to_the_last_bit(it: ModelFile) -> None:
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.toml"
        write_model(path, it)
        again = read_model_file(path, KNOWN)
        assert again == it
        write_model(path, again)
        assert model_text(again, path.parent) == path.read_text(encoding="utf-8")
        assert [p.name for p in path.parent.iterdir()] == ["model.toml"]


def test_the_file_says_units_and_meaning_and_the_order_of_the_effects(tmp_path: Path) -> None:
    model = Model(
        tuple(
            Term(KNOWN.effects[n], KNOWN.effects[n].typicals) for n in ("modulus_error", "axis_flexibility")
        )
    )
    write_model(tmp_path / "model.toml", ModelFile(model))
    text = (tmp_path / "model.toml").read_text(encoding="utf-8")
    assert text.index("modulus_error") < text.index("axis_flexibility")
    assert "radial_mm_per_N = 2e-06 # mm/N, give of one hinge across its axis" in text
    assert read_model_file(tmp_path / "model.toml", KNOWN).model == model


def test_a_file_edited_by_hand_is_read(tmp_path: Path) -> None:
    path = tmp_path / "model.toml"
    path.write_text(TOML.replace("\n", "\r\n"), encoding="utf-8-sig", newline="")
    found = read_model_file(path)
    assert found.model.names == ("bar_geometric_nonlinearity", "joint_friction")
    assert found.model.values.tolist() == [350.0]
    assert found.uncertainty == {"joint_friction.torque_Nmm": Uncertainty(5.5, 340.0, None)}


def test_a_users_effect_is_found_beside_the_file(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(USER)
    folder = tmp_path / "campaign"
    known = known_effects([tmp_path / "mine.py"])
    model = Model((Term(known.effects["halved_bars"], {"share": 0.7}),))
    write_model(folder / "model.toml", ModelFile(model, {}, known.files_of(model.names)))
    assert 'effects_from = ["../mine.py"]' in (folder / "model.toml").read_text()
    found = read_model_file(folder / "model.toml")
    assert found.model.names == ("halved_bars",) and found.model.terms[0].values == {"share": 0.7}
    assert found.effects_from == ((tmp_path / "mine.py").resolve(),)
    # The same file named on the command line as well is no clash.
    assert read_model_file(folder / "model.toml", known).model == model
    with pytest.raises(InputError, match=r"mine\.py: defines halved_bars, which is taken"):
        (tmp_path / "other.py").write_text(USER)
        read_model_file(folder / "model.toml", known_effects([tmp_path / "other.py"]))


BAD = {
    "schema": ("schema = 1", "schema = 2", "line 1, schema: is 2, allowed is 1"),
    "no schema": ("schema = 1\n", "", "schema: is missing"),
    "base": ('"vjm"', '"fem"', "line 2, base: is 'fem', allowed is: 'vjm'"),
    "key": (
        "base =",
        "colour = 1\nbase =",
        "line 2, colour: is not a key of this table, allowed: schema, base",
    ),
    "effect": (
        '"joint_friction"\n',
        '"joint_fricton"\n',
        "line 9, effect 'joint_fricton': is unknown, did you mean 'joint_friction'?",
    ),
    "effect, nothing near": (
        '"joint_friction"\n',
        '"magic"\n',
        "effect 'magic': is unknown, allowed: actuator_compliance, ",
    ),
    "twice": (
        '"bar_geometric_nonlinearity"',
        '"joint_friction"',
        "line 9, effect 'joint_friction': is there twice, allowed is each effect once",
    ),
    "parameter": (
        "torque_Nmm = 350",
        "torqe_Nmm = 350",
        "line 12, effect joint_friction, values.torqe_Nmm: is no parameter of joint_friction, "
        "did you mean 'torque_Nmm'?",
    ),
    "missing": (
        "torque_Nmm = 350\n",
        "",
        "line 9, effect joint_friction, torque_Nmm: is missing, allowed is a number in N·mm",
    ),
    "bounds": (
        "= 350",
        "= -1.0",
        "line 12, effect joint_friction, torque_Nmm: is -1 N·mm, allowed is 0 to 100000",
    ),
    "no number": (
        "= 350",
        "= true",
        "line 12, effect joint_friction, torque_Nmm: is True, allowed is a number in N·mm",
    ),
    "text": ("= 350", '= "350"', "torque_Nmm: is '350', allowed is a number in N·mm"),
    "not finite": (
        "= 350",
        "= nan",
        "line 12, effect joint_friction, torque_Nmm: is nan, allowed is a number in N·mm",
    ),
    "fixed": (
        '["joint_friction.presliding_rad"]',
        '["joint_friction.presliding"]',
        "line 3, fixed, 'joint_friction.presliding': is unknown, did you mean 'joint_friction.presliding_rad'?",
    ),
    "errors": (
        "std = 5.5",
        'std = "small"',
        "effect 'joint_friction', errors.torque_Nmm.std: is 'small', allowed is: a valid number",
    ),
    "no TOML": ("[[effects]]", "[[effects]", "is no TOML"),
    "no file of effects": (
        'base = "vjm"',
        'base = "vjm"\neffects_from = ["gone.py"]',
        "gone.py: is no file, allowed is a Python file",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_every_mistake_is_named(name: str, tmp_path: Path) -> None:
    old, new, said = BAD[name]
    assert old in TOML
    path = tmp_path / "model.toml"
    path.write_text(TOML.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_model_file(path)
    assert str(tmp_path) in str(caught.value) and said in str(caught.value)


def test_all_mistakes_are_said_at_once(tmp_path: Path) -> None:
    path = tmp_path / "model.toml"
    path.write_text(TOML.replace("= 350", "= -1").replace("= 0.002", "= 5.0"), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_model_file(path)
    assert "torque_Nmm: is -1" in str(caught.value) and "presliding_rad: is 5" in str(caught.value)


def test_an_effect_that_this_rig_cannot_have_is_refused(tmp_path: Path) -> None:
    effect = next(e for e in KNOWN.effects.values() if e.kinds == ("parallelogram",))
    path = tmp_path / "model.toml"
    write_model(path, ModelFile(Model((Term(effect, effect.typicals),))))
    assert read_model_file(path, KNOWN, ParallelogramRig).model.names == (effect.name,)
    with pytest.raises(
        InputError, match=f"effect '{effect.name}': needs a rig of kind parallelogram, not bar"
    ):
        read_model_file(path, KNOWN, BarRig)


def test_a_file_that_cannot_be_written_is_said_and_leaves_the_old_one(tmp_path: Path) -> None:
    (tmp_path / "model.toml").mkdir()
    with pytest.raises(InputError, match="cannot be written"):
        write_model(tmp_path / "model.toml", ModelFile(Model()))
    assert [p.name for p in tmp_path.iterdir()] == ["model.toml"]


def test_files_of_effects_are_run_once_and_refused_with_their_reason(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(USER)
    twice = known_effects([tmp_path / "mine.py", tmp_path / "." / "mine.py"])
    assert isinstance(twice, Known) and set(twice.effects) == {*KNOWN.effects, "halved_bars"}
    (tmp_path / "broken.py").write_text("1 / 0\n")
    with pytest.raises(InputError, match=r"broken\.py: ZeroDivisionError"):
        known_effects([tmp_path / "broken.py"])
