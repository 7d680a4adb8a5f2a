"""A manipulator file: what it makes, and a complaint with file, line and key for whatever is wrong with it."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from pipeline.errors import InputError
from pipeline.manipulator.description import describe, read
from tests.vjm.manipulator.example import under
from vjm import paper
from vjm.manipulator.parts import Parallelogram
from vjm.manipulator.posture import postures
from vjm.parts import Actuator, Elastic, Frame, Passive, Virtual
from vjm.stiffness import loaded_stiffness

TEXT = read("orthoglide").text

MISTAKES = {
    "no toml": ("schema = 1", "schema = ", "is no TOML"),
    "schema": ("schema = 1", "schema = 2", "line 6, schema: is 2, allowed is 1"),
    "kind": (
        'kind = "translation"',
        'kind = "slide"',
        "line 13, chain 'arm', part 1, kind: is 'slide', allowed is",
    ),
    "part": (
        'part = "link"',
        'part = "lnk"',
        "line 20, chain 'arm', part 2, part: is 'lnk', did you mean 'link'?",
    ),
    "key": ("width_mm", "widht_mm", "widht_mm: is not a key of this table, did you mean 'width_mm'?"),
    "missing": ("width_mm = 80.0", "", "line 29, chain 'arm', part 4, width_mm: is missing"),
    "unit": (
        "stiffness_N_per_mm",
        "stiffness_Nmm_per_rad",
        "stiffness_Nmm_per_rad is given for a translation",
    ),
    "matrix": ("2.66e6", "2.66e3", "lowest eigenvalue is -26.3, mostly in coordinates 3 and 5"),
    "beam": ("EIy_Nmm2 = 4.46e8", "EIy_Nmm2 = -1.0", "beam.EIy_Nmm2: is -1.0, allowed is: at least 0.001"),
    "limits": ("[-200.0, 200.0]", "[200.0, -200.0]", "limits_mm is [200.0, -200.0], allowed is a lower"),
    "chain": (
        'name = "y"\nchain = "arm"',
        'name = "y"\nchain = "am"',
        "leg 'y', chain: is 'am', did you mean 'arm'?",
    ),
    "twice": ('name = "y"', 'name = "x"', "leg 'x': is there twice"),
    "axes": (
        "y_axis = [0.0, 0.0, 1.0]",
        "y_axis = [0.0, 2.0, 0.0]",
        "leg 'y': x_axis and y_axis are parallel",
    ),
    "apart": (
        "at_mm = [0.0, -410.0, 0.0]",
        "at_mm = [0.0, -410.0, 350.0]",
        "leg 'y': cannot be put together",
    ),
    "beyond": (
        "at_mm = [0.0, -410.0, 0.0]",
        "at_mm = [0.0, -710.0, 0.0]",
        "the actuator of leg y is beyond its limits",
    ),
    "no legs": ("[[legs]]", "[[leg]]", "legs: is missing"),
    "bars": ('bars = "pair"', 'bars = "equivalent"\nsegments = 2', "segments is given, allowed with bars = "),
    "passive": ('part = "passive"', 'part = "passive"\nstiffness_Nmm_per_rad = 1.0', "a stiffness is given"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes(name: str) -> None:
    before, after, said = MISTAKES[name]
    assert before in TEXT
    with pytest.raises(InputError) as caught:
        describe(TEXT.replace(before, after), "mine.toml")
    assert said in str(caught.value)
    assert all(line.startswith("mine.toml") for line in str(caught.value).splitlines())


def test_all_mistakes_are_named_at_once() -> None:
    text = TEXT.replace("length_mm = 100.0", "length_mm = -1.0").replace("[-200.0", "[900.0")
    with pytest.raises(InputError) as caught:
        describe(text, "mine.toml")
    assert len(str(caught.value).splitlines()) == 2


def test_the_shipped_orthoglide() -> None:
    manipulator = read("orthoglide").manipulator
    assert [leg.name for leg in manipulator.legs] == ["x", "y", "z"]
    for leg in manipulator.legs:
        kinds = [type(p) for p in leg.parts]
        assert kinds == [Frame, Actuator, Elastic, Passive, Parallelogram, Passive, Frame]
        part = leg.parts[4]
        assert isinstance(part, Parallelogram)
        assert (part.length, part.width) == (paper.LENGTH, paper.WIDTH)
        np.testing.assert_array_equal(part.bar_stiffness, paper.BAR_STIFFNESS)


OTHER = """
schema = 1
name = "one arm"
length_mm = 200.0
home_mm = [100.0, 0.0, 50.0]

[[chains.c]]
part = "actuator"
kind = "rotation"
axis = "z"
home_deg = 5.0
limits_deg = [-90.0, 90.0]
[[chains.c]]
part = "virtual"
kind = "rotation"
axis = "z"
stiffness_Nmm_per_rad = 1e6
[[chains.c]]
part = "rigid"
to_mm = [100.0, 0.0, 0.0]
[[chains.c]]
part = "passive"
kind = "rotation"
axis = "z"
[[legs]]
name = "a"
chain = "c"
at_mm = [0.0, 0.0, 0.0]
ends_at_mm = [0.0, 0.0, -50.0]
"""


def test_another_manipulator() -> None:
    leg = describe(OTHER, "other.toml").manipulator.legs[0]
    _, actuator, spring, rigid, _, end = leg.parts
    assert isinstance(actuator, Actuator) and actuator.home == pytest.approx(np.radians(5.0))
    assert actuator.limits == pytest.approx((-np.pi / 2, np.pi / 2)) and actuator.stiffness is None
    assert isinstance(spring, Virtual) and spring.stiffness == 1e6
    assert isinstance(rigid, Frame) and rigid.translation.tolist() == [100.0, 0.0, 0.0]
    assert isinstance(end, Frame) and end.translation.tolist() == [0.0, 0.0, 50.0]


def test_files(tmp_path: Path) -> None:
    file = tmp_path / "m.toml"
    with pytest.raises(InputError, match="shipped are orthoglide"):
        read(file)
    file.write_bytes(b"\xff\xfe")
    with pytest.raises(InputError, match="is no UTF-8 text"):
        read(file)
    file.write_text(OTHER, encoding="utf-8")
    assert read(file).manipulator.name == "one arm"


def test_two_members_of_a_leg_in_segments_are_two() -> None:
    """The shipped Orthoglide with its links and its bars in segments has the stiffness of the one without, at rest."""
    text = re.sub(r'part = "(link|parallelogram)"\n', r"\g<0>segments = 4\n", TEXT)
    assert text.count("segments = 4") == 2
    found = []
    for each in (TEXT, text):
        whole = describe(each, "o.toml").manipulator
        state = under(whole, postures(whole, [[50.0, -40.0, 60.0]]), np.zeros(6))
        assert state.converged.all()
        found.append(loaded_stiffness(state)[0])
    np.testing.assert_allclose(found[1], found[0], rtol=1e-6, atol=1e-7 * np.abs(found[0]).max())
