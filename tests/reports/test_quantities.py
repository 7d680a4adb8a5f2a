"""Numbers with their uncertainty as text: digits, the words for what is not known, and no infinity anywhere."""

from __future__ import annotations

import re
from math import inf, isfinite

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.formats import number as typeset
from reports.quantities import (
    Estimate,
    interval_text,
    marks,
    p_is,
    percent,
    phrase,
    plain,
    short,
    sigma,
    signed,
    std_text,
    value_text,
)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.9779, "0.978"),
        (12.34, "12.3"),
        (289.4, "289"),
        (9.996, "10.0"),
        (999.7, "1000"),
        (4533.2, "4533"),
        (99_999.7, "1.0e5"),
        (123_456.0, "1.2e5"),
        (1.2e12, "1.2e12"),
        (9.09e-13, "< 0.001"),
        (0.0, "0"),
        (None, "–"),
        (inf, "–"),
    ],
)
def test_errors_in_sigmas(value: float | None, text: str) -> None:
    assert sigma(value) == text


@pytest.mark.parametrize(
    ("ratio", "text"),
    [
        (0.18, "18 %"),
        (0.0325, "3.2 %"),
        (-0.58, "58 %"),
        (3e-11, "under 0.1 %"),
        (1.234, "123 %"),
        (0.0, "0 %"),
    ],
)
def test_percent_is_rounded_sensibly(ratio: float, text: str) -> None:
    assert percent(ratio) == text


def test_probabilities() -> None:
    assert [p_is(p) for p in (0.2345, 0.00212, 2.4e-5, 1e-300, 0.0)] == [
        "p = 0.23",
        "p = 0.0021",
        "p = 2e-5",
        "p < 1e-6",
        "p < 1e-6",
    ]


def test_a_value_has_the_digits_of_its_standard_error() -> None:
    torque = Estimate(804.3512, 5.5432, 793.4712, 815.2312)
    assert (value_text(torque), std_text(torque)) == ("804.4", "5.5")
    assert interval_text(torque) == "793.5 .. 815.2"
    assert phrase("torque_Nmm", torque, "N·mm") == "torque_Nmm = 804.4 N·mm (95 %: 793.5 .. 815.2)"
    give = Estimate(4.0e-6, 1.3e-7, 3.7451e-6, 4.2549e-6)
    assert (value_text(give), interval_text(give)) == ("4.00e-6", "3.75e-6 .. 4.25e-6")
    rough = Estimate(12_345.0, 2_300.0, 7_837.0, 16_853.0)
    assert (value_text(rough), interval_text(rough)) == ("12300", "7800 .. 16900")
    assert value_text(rough, typeset) == "12\u202f300"


def test_no_digit_of_noise() -> None:
    """A value far below its own standard error is zero to the digits that count."""
    tiny = Estimate(6e-9, 0.3, -0.6, 0.6)
    assert (value_text(tiny), interval_text(tiny)) == ("0", "-0.60 .. 0.60")


def test_ends_that_the_data_do_not_set() -> None:
    assert interval_text(Estimate(5.0, None, 3.04, None, "profile")) == "above 3.0"
    assert interval_text(Estimate(5.0, None, None, 6.96, "profile")) == "below 7.0"
    lost = Estimate(6e-9, inf, None, None, "undetermined")
    assert (value_text(lost), std_text(lost), interval_text(lost)) == ("–", "–", "not determined")
    assert phrase("rx_rad", lost, "rad") == "rx_rad not determined"
    held = Estimate(5.0, None, None, None, "fixed")
    assert phrase("rx_rad", held, "rad") == "rx_rad = 5 rad (not fitted)"


def test_a_value_at_its_bound_is_shown_as_such() -> None:
    bound = Estimate(5.0, None, None, None, "undetermined", at_bound=True)
    assert marks(bound) == ("at its bound", "not determined")
    assert phrase("mismatch_mm", bound, "mm") == "mismatch_mm = 5 mm (at its bound, not determined)"
    known = Estimate(5.0, 0.1, 4.8, None, "profile", at_bound=True)
    assert phrase("mismatch_mm", known, "mm") == "mismatch_mm = 5.00 mm (at its bound, 95 %: above 4.80)"


def test_short_and_signed_numbers() -> None:
    assert [short(v) for v in (21_658.4, 2.3852e8, 0.12345, 50.0, None)] == [
        "21658",
        "2.39e8",
        "0.123",
        "50",
        "–",
    ]
    assert [signed(0.509123, 4e-5), signed(-41.26, 3.0), signed(0.0, 1.0)] == ["+0.509", "-41.3", "0"]
    assert signed(0.509123, None) == "+0.509"


any_number = st.floats() | st.none()
estimates = st.builds(
    Estimate,
    st.floats(allow_nan=False, allow_infinity=False),
    any_number,
    any_number,
    any_number,
    st.sampled_from(["wald", "profile", "undetermined", "fixed"]),
    st.booleans(),
)


@given(estimates)
def test_no_text_has_an_infinity(it: Estimate) -> None:
    said = " ".join([value_text(it), std_text(it), interval_text(it), phrase("a", it, "mm")])
    assert not re.search(r"inf|nan", said), said
    assert ("at its bound" in said) == it.at_bound
    no_ends = all(end is None or not isfinite(end) for end in (it.low95, it.high95))
    assert ("not determined" in said) == (
        it.interval == "undetermined" or (no_ends and it.interval != "fixed")
    )


@given(st.floats(-1e300, 1e300), st.integers(1, 8))
def test_plain_numbers_read_back(value: float, digits: int) -> None:
    text = plain(value, digits)
    assert float(text) == pytest.approx(value, rel=10.0 ** (1 - digits), abs=1e-320)
    assert "e-0" not in text and "+" not in text


@given(st.floats(min_value=0.0))
def test_sigmas_and_shares_are_short(value: float) -> None:
    assert len(sigma(value)) <= 8 and len(percent(value)) <= 12
