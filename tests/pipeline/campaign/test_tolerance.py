"""The table [tolerance]: what it says, what counts where it is silent, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from pipeline.campaign import BadCampaign, read, write
from pipeline.campaign.tolerance import table, tolerance, usual
from tests.pipeline.campaign.example import TOML, laid

BENCH = ("EA", "EIy", "EIz", "GJ", "ends", "length_mm", "width_mm", "q_mrad")


def with_table(folder: Path, text: str) -> Path:
    """A campaign with this text as its tolerances."""
    return laid(folder, TOML.replace('[tolerance]\nall = "exact"\n', f"{text}\n", 1))


def read_of(raw: dict[str, object], written: tuple[str, ...] = BENCH) -> tuple[dict[str, float], list[str]]:
    said: list[str] = []
    found = tolerance(raw, written, lambda path, what: said.append(f"{'.'.join(path)} {what}"))
    return found, said


def test_nothing_said_is_the_usual_and_is_told(tmp_path: Path) -> None:
    campaign = read(laid(tmp_path, TOML.replace('[tolerance]\nall = "exact"\n', "", 1)))
    assert campaign.tolerance == usual(campaign.rig.written)
    assert campaign.tolerance["EA"] == 0.02 and campaign.tolerance["ends"] == 0.005
    (said,) = campaign.remarks
    assert "tolerance: is missing" in said and "EA 2 %" in said and "length_mm 0.05 mm" in said


def test_one_number_is_that_of_all_stiffnesses_of_a_bar() -> None:
    found, said = read_of({"bar": 0.01})
    assert not said
    assert [found[key] for key in ("EA", "EIy", "EIz", "GJ", "ends")] == [0.01] * 4 + [0.005]


def test_each_may_be_given_or_exact() -> None:
    found, said = read_of({"bar": {"EA": 0.1, "ends": "exact"}, "width_mm": 0.2, "q_mrad": "exact"})
    assert not said
    assert found == {"EA": 0.1, "EIy": 0.02, "EIz": 0.02, "GJ": 0.02, "length_mm": 0.05, "width_mm": 0.2}


def test_all_exact_is_none() -> None:
    assert read_of({"all": "exact"}) == ({}, [])
    # What is said beside it counts.
    assert read_of({"all": "exact", "bar": {"EIz": 0.03}}) == ({"EIz": 0.03}, [])


def test_of_a_machine_all_bars_have_one_number() -> None:
    assert read_of({"bar": 0.05}, ("bars",)) == ({"bars": 0.05}, [])


@pytest.mark.parametrize(
    ("raw", "said"),
    [
        ({"bra": 0.01}, "bra is not a key of this table"),
        ({"bar": -0.01}, "bar is -0.01, allowed is: a number from 0 to 0.2"),
        ({"bar": 0.5}, "bar is 0.5, allowed is: a number from 0 to 0.2"),
        ({"bar": {"EIx": 0.1}}, "bar.EIx is not a key of this table"),
        ({"bar": {"EA": [1]}}, "bar.EA is a list"),
        ({"length_mm": "about"}, "length_mm is 'about'"),
        ({"all": 0.1}, 'all is 0.1, allowed is: "exact"'),
        ({"bar": True}, "bar is True"),
    ],
)
def test_mistakes_are_told(raw: dict[str, object], said: str) -> None:
    _, found = read_of(raw)
    assert len(found) == 1
    assert found[0].startswith(said)


def test_a_mistake_has_its_line(tmp_path: Path) -> None:
    with pytest.raises(BadCampaign, match=r"campaign.toml line \d+, tolerance.bar: is -1"):
        read(with_table(tmp_path, "[tolerance]\nbar = -1"))


@pytest.mark.parametrize("raw", [{"all": "exact"}, {"bar": {"EA": 0.01, "ends": "exact"}}, {}])
def test_what_is_written_is_read_again(raw: dict[str, object], tmp_path: Path) -> None:
    known, _ = read_of(raw)
    assert read_of(table(known, BENCH)) == (known, [])
    campaign = read(with_table(tmp_path / "a", "[tolerance]\nbar = 0.01\nwidth_mm = 0.3"))
    write(tmp_path / "b", campaign)
    assert read(tmp_path / "b").tolerance == campaign.tolerance
