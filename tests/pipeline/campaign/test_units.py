"""The list of units against an independent one (pint), and the spellings that it does not take."""

from __future__ import annotations

import math

import pint
import pytest

from pipeline.campaign.mapped import units
from pipeline.campaign.mapped.units import QUESTIONS, UNITS, NoUnit, unit

PINT = {
    "µm": "micrometer",
    "in": "inch",
    "ft": "foot",
    "µrad": "microradian",
    "°": "degree",
    "arcmin": "arcminute",
    "arcsec": "arcsecond",
    "gon": "gradian",
    "gf": "gram_force",
    "kgf": "kilogram_force",
    "lbf": "pound_force",
    "ozf": "ounce_force",
    "kip": "kip",
    "min": "minute",
    "h": "hour",
}
INTO = {"length": "mm", "angle": "rad", "force": "N", "moment": "N*mm", "time": "s"}
REGISTRY = pint.UnitRegistry()


@pytest.mark.parametrize("name", [name for name, it in UNITS.items() if it.quantity != "temperature"])
def test_factors_are_those_of_an_independent_list(name: str) -> None:
    theirs = "*".join(PINT.get(part, part) for part in name.split("·"))
    assert UNITS[name].factor == pytest.approx(
        REGISTRY(theirs).to(INTO[UNITS[name].quantity]).magnitude, rel=1e-14
    )


@pytest.mark.parametrize(("name", "theirs"), [("°C", "degC"), ("K", "kelvin"), ("°F", "degF")])
def test_temperatures_are_those_of_an_independent_list(name: str, theirs: str) -> None:
    for reading in (-40.0, 0.0, 20.0, 451.0):
        ours = UNITS[name].factor * reading + UNITS[name].offset
        assert ours == pytest.approx(REGISTRY.Quantity(reading, theirs).to("degC").magnitude, abs=1e-11)


def test_every_spelling_is_of_one_unit_and_no_question() -> None:
    for spelling, name in units._ALSO.items():
        assert unit(spelling) is UNITS[name], spelling
        assert spelling not in QUESTIONS
    assert not set(QUESTIONS) & set(UNITS)
    assert all(unit(name) is it and it.spelling == name for name, it in UNITS.items())
    assert 40 <= len(UNITS) <= 50


@pytest.mark.parametrize(
    "spelling", ["(mm)", "[mm]", " mm ", "N mm", "N*mm", "N.mm", "N-mm", "Nmm", "in-lb", "lbf in"]
)
def test_brackets_blanks_and_marks_of_products_do_not_matter(spelling: str) -> None:
    assert unit(spelling).quantity in ("length", "moment")


@pytest.mark.parametrize(
    "spelling", ["[1/100 mm]", "1/100mm", "mm/100", "0.01 mm", "(0,01 mm)", "0.01mm", "1/1000 mm"]
)
def test_what_stands_on_the_face_of_a_dial_is_a_unit(spelling: str) -> None:
    assert unit(spelling, "length").factor == (1e-3 if "1000" in spelling else 0.01)


@pytest.mark.parametrize("spelling", sorted(QUESTIONS))
def test_what_means_two_things_is_asked_about(spelling: str) -> None:
    with pytest.raises(NoUnit, match=r"\?"):
        unit(spelling)


def test_what_is_unknown_or_of_another_quantity_is_refused_with_what_is_allowed() -> None:
    with pytest.raises(NoUnit, match="'furlong' is no unit that is known, allowed are mm, m, cm"):
        unit("furlong", "length")
    with pytest.raises(NoUnit, match="kN is a force, this is a moment; allowed are N·mm"):
        unit("kN", "moment")
    with pytest.raises(NoUnit, match="mrad is an angle, this is a length"):
        unit("mrad", "length")


def test_the_conversion_is_said() -> None:
    assert UNITS["in"].words == "1 in = 25.4 mm"
    assert UNITS["1/100 mm"].words == "1/100 mm = 0.01 mm"
    assert UNITS["°F"].words == "°C = 0.5555555556 °F -17.77777778"
    assert math.isclose(UNITS["gon"].factor * 400.0, 2.0 * math.pi)
