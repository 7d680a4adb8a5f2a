"""The notebooks are run, and what they show is compared with what comes out."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import parastiff
from tests.docs.notebooks import Json, code_cells, notebooks, read, run, text_of
from tests.docs.shown import difference

LONG = {"own_bar", "own_table", "calibration"}
"""Notebooks that mesh or search; the others are run by the quick tests too."""
BYTES = 150_000
LIBRARIES = {"parastiff", "pathlib"}


def marked() -> list[object]:
    return [pytest.param(it, marks=[pytest.mark.long] * (it.stem in LONG), id=it.stem) for it in notebooks()]


def said(outputs: list[Json]) -> str:
    return "\n".join(map(text_of, outputs))


@pytest.mark.parametrize("path", marked())
def test_a_notebook_comes_out_as_it_is_shown(path: Path, tmp_path: Path) -> None:
    notebook = read(path)
    for cell, outputs in zip(code_cells(notebook), run(notebook, tmp_path), strict=True):
        where = f"{path.name}: {''.join(cell['source'])}"
        assert not difference(said(cell["outputs"]), said(outputs)), where
        pictures = [["image/png" in it.get("data", {}) for it in each] for each in (cell["outputs"], outputs)]
        assert pictures[0] == pictures[1], where


def test_there_is_one_for_a_designer_a_bench_and_a_machine() -> None:
    assert [path.stem for path in notebooks()] == ["calibration", "own_bar", "own_table"]


@pytest.mark.parametrize("path", notebooks(), ids=lambda path: path.stem)
def test_a_notebook_is_short_shows_a_picture_and_needs_one_module(path: Path) -> None:
    """Of every notebook, also of those that are run by the long tests alone."""
    cells = code_cells(read(path))
    assert path.stat().st_size < BYTES and len(cells) <= 8
    assert any("image/png" in output.get("data", {}) for cell in cells for output in cell["outputs"])
    tree = ast.parse("\n".join("".join(cell["source"]) for cell in cells))
    used = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    used |= {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    assert used <= LIBRARIES
    # Every cell that ends with a value has what it showed.
    for cell in cells:
        ends = isinstance(ast.parse("".join(cell["source"])).body[-1], ast.Expr)
        assert bool(cell["outputs"]) is ends or "print" in "".join(cell["source"])
    names = {
        node.attr
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute)
        and isinstance(node.value, ast.Name)
        and node.value.id == "parastiff"
    }
    assert names and names <= set(parastiff.__all__)


def test_cells_share_a_namespace_and_print_and_show(tmp_path: Path) -> None:
    sources = ["a = 2", "print(a)\na + 1", "import os\nos.path.exists('../bench/campaign.toml')"]
    notebook = {"cells": [{"cell_type": "code", "source": [it]} for it in sources]}
    outputs = [said(it) for it in run(notebook, tmp_path)]
    assert outputs == ["", "2\n\n3", "True"]
