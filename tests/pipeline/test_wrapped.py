"""Sentences for a terminal end at its width, between words; what is searched by programs stays a line a sentence."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest

from pipeline.check import check
from pipeline.terminal import complain, wrapped
from tests.pipeline.campaign.example import laid

LONG = "/a/very/long/way/to-the-folder/of_a_bench/" + "deep/" * 12 + "campaign.toml"
SAID = f"error: {LONG} line 7, test 'q0': nothing holds z and nothing keeps it from swinging, {'so ' * 30}it is refused"


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_words_are_never_cut_and_no_line_of_several_is_too_wide() -> None:
    text = wrapped(f"{SAID}\n{SAID}")
    assert " ".join(text.split()) == " ".join([SAID, SAID])
    assert LONG in text
    assert all(len(line) <= 80 for line in text.splitlines() if LONG not in line)
    # Where a complaint begins is seen: further lines of it are indented.
    assert [line.startswith("error") for line in text.splitlines() if line[0] != " "] == [True, True]


@pytest.mark.parametrize(("columns", "widest"), [("80", 80), ("60", 60), ("200", 100)])
def test_a_terminal_is_used_up_to_its_width(
    monkeypatch: pytest.MonkeyPatch, columns: str, widest: int
) -> None:
    out = Terminal()
    monkeypatch.setattr(sys, "stderr", out)
    monkeypatch.setenv("COLUMNS", columns)
    complain(SAID)
    lines = [line for line in out.getvalue().splitlines() if LONG not in line]
    assert widest - 20 < max(map(len, lines)) <= widest


def test_what_is_no_terminal_has_a_line_each(capsys: pytest.CaptureFixture[str]) -> None:
    complain(SAID)
    assert capsys.readouterr().err == f"{SAID}\n"


def test_check_says_all_within_eighty_columns(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    check(laid(tmp_path / "c"))
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith("Doctor: ") for line in lines)
    assert all(len(line) <= 80 for line in lines if "next: " not in line), max(lines, key=len)
