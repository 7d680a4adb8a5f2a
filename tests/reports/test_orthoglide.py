"""The section of Table 1: every cell beside the paper's, what was fitted and what predicted."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from pipeline.manipulator.table_record import Table1
from reports import markdown, page, sections
from reports.validation import ReportError, draw
from tests.reports import example, example_orthoglide

TITLE = "Whole Orthoglide (Table 1)"


def drawn(tables: list[dict[str, Any]]) -> tuple[str, str]:
    """The section on page and in Markdown."""
    section = sections.orthoglide({"orthoglide": tables})
    return page.render("title", [section]), markdown.render("title", [section])


def test_the_example_is_what_a_run_writes() -> None:
    Table1.model_validate(example_orthoglide.table())


def test_cells_stand_beside_the_papers() -> None:
    html, text = drawn([example_orthoglide.table()])
    assert TITLE in html and TITLE in text
    rows = [line for line in text.splitlines() if line.startswith("|")]
    fitted = next(row for row in rows if "fitted" in row and "3230" in row)
    assert "solid axis" in fitted and fitted.split("|")[-3].strip() == ""
    predicted = next(row for row in rows if "3111" in row)
    assert (
        "3330" in predicted and "−6.6" in predicted and "predicted" in predicted and "frame FE" in predicted
    )
    absent = next(row for row in rows if "65" in row and "not in the paper" in row)
    assert "2x-bar" in absent and "—" in absent
    assert "1 numbers are fitted to 1 of its cells, the other 1 are predicted" in text
    # The worse of K_tran and K_rot, 3.4e-3, in percent.
    assert "they differ by 0.34 %" in text
    assert "Flexible axes lower both. Yes, without being fitted: K_tran -4.6 %." in text


def test_a_reading_that_changes_nothing_has_no_sign_and_names_are_text() -> None:
    html, text = drawn([example_orthoglide.table()])
    row = next(line for line in text.splitlines() if "universal joints" in line)
    assert "+2.34" in row and "+0.00" not in row and "−0.00" not in row
    assert "drive &lt;along&gt;" in html and "drive <along>" not in html


def test_a_case_without_table_has_no_section() -> None:
    """The example's result has none: the order of its sections is tested with the rest of the report."""
    titles = [section.title for section in sections.build(example.result(), {}, None)]
    assert TITLE not in titles
    with_one = example.result() | {"orthoglide": [example_orthoglide.table()]}
    assert TITLE in [section.title for section in sections.build(with_one, {}, None)]


def test_a_damaged_table_is_a_complaint(tmp_path: Path) -> None:
    table = example_orthoglide.table()
    del table["cells"]
    folder = example.write(tmp_path, example.result() | {"orthoglide": [table]})
    with pytest.raises(ReportError, match="cells"):
        draw(folder)
