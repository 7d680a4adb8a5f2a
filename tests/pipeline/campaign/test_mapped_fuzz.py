"""Damaged tables and mappings are a campaign or a sentence; never anything else."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pipeline.campaign import BadCampaign, Campaign, read
from tests.pipeline.campaign.mapped_tables import HEAD, TEST

TEXT = """Test;Weg [µm];Kraft (kN);Zeit
# bench 4
load;0,0;0,0;11:23:03
;-508,25;-0,005;11:23:04
;-608,25;-0,006;11:23:05
again;0,1;0,0;11:23:06
"""
TABLES = """[file]
path = "a.csv"
separator = ";"
decimal = ","
comment = "#"
time_column = "Zeit"
missing = ["---"]
fill_down = ["Test"]
every = 2

[columns]
"Test" = { is = "test" }
"Weg [µm]" = { is = "z", sign = -1, zero = 0.5 }
"Kraft (kN)" = { is = "fz", unit = "kN", zero = "first_row" }

[cell]
at_mm = [1.0, 2.0, 3.0]
sign = -1
"""
PIECES = (
    *(
        '"?"',
        "-1",
        "1e400",
        "nan",
        "[]",
        "{}",
        '""',
        "\n",
        ";",
        ",",
        "\t",
        " ",
        "'",
        '"',
        "#",
        "\\",
        "é",
        "\0",
    ),
    *(
        "is = ",
        "unit = ",
        '"kg"',
        '"mm"',
        '"first_row"',
        "header_row = 0",
        "skip = 9",
        "last_row = 1",
        "1.300",
    ),
    *(
        "test_from = ",
        '[derived]\nrz = { of = { "Zeit" = 1 }, unit = "um", over_mm = 60.0 }\n',
        "[[tests]]\n",
    ),
)


@st.composite
def damaged(draw: st.DrawFn, text: str) -> str:
    for _ in range(draw(st.integers(0, 4))):
        at = draw(st.integers(0, len(text)))
        to = draw(st.integers(at, min(len(text), at + 30)))
        text = text[:at] + draw(st.sampled_from(["", *PIECES, text[at:to] * 2])) + text[to:]
    return text


campaigns = st.tuples(
    damaged(HEAD + TABLES + TEST.format(id="load") + TEST.format(id="again")), damaged(TEXT)
)


def read_or_refused(texts: tuple[str, str]) -> bool:
    """Whether it was read."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "campaign.toml").write_text(texts[0], encoding="utf-8")
        (folder / "a.csv").write_text(texts[1], encoding="utf-8")
        try:
            found = read(folder)
        except BadCampaign as error:
            assert all(said.startswith(str(folder)) and ": " in said for said in error.complaints)
            assert not any(word in str(error) for word in ("Traceback", "NoneType", "object at 0x"))
            return False
        assert isinstance(found, Campaign) and found.tests
        return True


@settings(max_examples=80, derandomize=True, deadline=None, database=None)
@given(campaigns)
def test_damage_is_read_or_refused(texts: tuple[str, str]) -> None:
    read_or_refused(texts)


@pytest.mark.long
@settings(max_examples=3000, derandomize=True, deadline=None, database=None)
@given(campaigns)
def test_much_damage_is_read_or_refused(texts: tuple[str, str]) -> None:
    read_or_refused(texts)


def test_the_undamaged_one_is_read() -> None:
    assert read_or_refused((HEAD + TABLES + TEST.format(id="load") + TEST.format(id="again"), TEXT))
