"""Names of parameters are parted at their last dot, whatever stands before it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pipeline.parameter_names import parted, path_of
from vjm.effects import catalogue

WORDS = st.from_regex(r"[a-z_@.]{1,20}", fullmatch=True)


@given(WORDS, WORDS.map(lambda word: word.replace(".", "_")))
def test_there_and_back(effect: str, parameter: str) -> None:
    assert parted(path_of(effect, parameter)) == (effect, parameter)


@pytest.mark.parametrize("name", catalogue())
def test_those_of_the_catalogue(name: str) -> None:
    for parameter in catalogue()[name].parameters:
        assert parted(f"{name}.{parameter.name}") == (name, parameter.name)


def test_a_site_has_dots_of_its_own_and_an_effect_alone_has_none() -> None:
    assert parted("link_compliance@y.foot.scale") == ("link_compliance@y.foot", "scale")
    assert parted("joint_friction") == ("joint_friction", "")
