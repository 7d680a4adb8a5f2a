"""The tutorials are run: every command, every line of Python, and every number that they show."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from sybil import Sybil

from tests.conftest import ROOT
from tests.docs.fences import NotAsShownError, fences, run
from tests.docs.shown import difference

PAGES = ROOT / "docs" / "tutorials"
LONG = {"own_table", "own_walk", "own_report", "own_part", "calibration", "prediction"}
"""Pages of a minute or more; a whole machine at 40 postures takes several."""


def pages() -> list[object]:
    names = sorted(path.stem for path in PAGES.glob("*.md"))
    return [pytest.param(name, marks=[pytest.mark.long] * (name in LONG), id=name) for name in names]


@pytest.mark.parametrize("page", pages())
def test_a_tutorial_comes_out_as_it_is_shown(page: str, tmp_path: Path) -> None:
    assert run(PAGES / f"{page}.md", tmp_path) >= 5


@pytest.mark.parametrize("name", sorted(path.stem for path in PAGES.glob("*.md")))
def test_every_block_of_a_tutorial_is_one_that_is_run(name: str) -> None:
    """Also of those that take minutes."""
    document = Sybil(parsers=[fences]).parse(PAGES / f"{name}.md")
    languages = [example.parsed.language for example in document.examples()]
    assert len(languages) == len(re.findall(r"^```", document.text, re.MULTILINE)) / 2
    assert "python" in languages and languages[0] not in ("text", "")


def page(folder: Path, text: str) -> Path:
    path = folder / "page.md"
    path.write_text(text, encoding="utf-8")
    return path


def test_blocks_share_a_namespace_and_a_folder(tmp_path: Path) -> None:
    text = (
        "```python\na = 2\n```\n\n```{code-block} toml\n:caption: there/it.toml\n\nkey = 1\n```\n\n"
        "```python\nprint(a, open('there/it.toml').read())\n```\n\n```text\n2 key = 1\n```\n"
    )
    assert run(page(tmp_path, text), tmp_path) == 4


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("```python\nprint(1)\n```\n\n```text\n2\n```\n", "'2' is shown, '1' came out"),
        ("```python\nprint(1)\n```\n", "printed and not shown"),
        ("```text\n2\n```\n", "behind no Python block"),
        ("```console\nparastiff\n```\n", "begins with a line"),
        ("```console\n$ rm -r .\n```\n", "rm is no command of a tutorial"),
        ("```console\n$ parastiff check nowhere\n```\n", "ends with 2"),
        ("```toml\nkey = 1\n```\n", "has no :caption:"),
    ],
)
def test_a_page_that_shows_something_else_is_found(text: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(NotAsShownError, match=said):
        run(page(tmp_path, text), tmp_path)


def test_a_block_that_nothing_runs_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="a block of 'sh'"):
        run(page(tmp_path, "```sh\nls\n```\n"), tmp_path)


@pytest.mark.parametrize(
    ("shown", "printed", "same"),
    [
        ("error 1.23 sigma", "error 1.24 sigma", True),
        ("error 1.23 sigma", "error 1.25 sigma", False),
        ("8 tests", "9 tests", False),
        ("4.02e-5", "4.03e-5", True),
        ("4.02e-5", "4.05e-5", False),
        ("a ... d", "a b c d", True),
        ("a ... d", "a b c", False),
        ("a ... b ... d", "a x b y d", True),
        ("a ... b ... d", "a x c y d", False),
        ("... d", "a d", True),
        ("a ...", "a d", True),
        ("a", "a d", False),
        ("x=1.0,", "x=1.1,", True),
        ("x=1.0,", "y=1.0,", False),
    ],
)
def test_what_counts_as_the_same(shown: str, printed: str, same: bool) -> None:
    assert (not difference(shown, printed)) is same
