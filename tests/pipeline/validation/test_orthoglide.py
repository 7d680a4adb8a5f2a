"""The stage of Table 1: for the paper's own bars only, kept like any other stage, told in sentences."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from pipeline.progress import Progress
from pipeline.validation.case import load_case
from pipeline.validation.stages import orthoglide
from pipeline.validation.workshop import Workshop


@dataclass
class Counting:
    """Counts calls of what it stands for."""

    calls: int = 0

    def __call__(self) -> object:
        self.calls += 1
        return TABLE()


TABLE = orthoglide.table_1


def test_the_papers_case_has_the_table_and_keeps_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    counting = Counting()
    monkeypatch.setattr(orthoglide, "table_1", counting)
    workshop = Workshop(tmp_path, Progress(quiet=True))
    (first,) = orthoglide.whole_manipulator(load_case("orthoglide"), workshop)
    (second,) = orthoglide.whole_manipulator(load_case("orthoglide"), workshop)
    assert counting.calls == 1 and first == second
    assert (first.fitted, first.predicted) == (3, 7)
    counted, unfitted = orthoglide.table_sentences([first])
    assert "3 numbers" in counted and "7 cells are predicted" in counted
    assert unfitted.count("Yes.") == 2 and unfitted.count("No.") == 1


def test_another_case_has_none(tmp_path: Path) -> None:
    workshop = Workshop(tmp_path, Progress(quiet=True))
    assert orthoglide.whole_manipulator(load_case("plain_i_bar"), workshop) == []
    assert orthoglide.table_sentences([]) == []
