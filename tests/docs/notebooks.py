"""Runs notebooks without a kernel: cells of one in one namespace, in a folder beside copies of the examples.

`python -m tests.docs.notebooks` runs all of them and writes what came out into them: text, and pictures as PNG.
"""

from __future__ import annotations

import ast
import contextlib
import io
import json
import os
import shutil
import sys
import tempfile
from base64 import b64encode
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.conftest import ROOT

FOLDER = ROOT / "examples" / "notebooks"
BESIDE = ("bench", "machine")
Json = dict[str, Any]


def notebooks() -> list[Path]:
    """All of them."""
    return sorted(FOLDER.glob("*.ipynb"))


def read(path: Path) -> Json:
    """A notebook as it is stored."""
    found: Json = json.loads(path.read_text(encoding="utf-8"))
    return found


def code_cells(notebook: Json) -> list[Json]:
    """Those that are run."""
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


def run(notebook: Json, folder: Path) -> Iterator[list[Json]]:
    """The outputs of each code cell. folder: an empty one; the notebook runs in a folder of it, examples beside it."""
    for name in BESIDE:
        shutil.copytree(ROOT / "examples" / name, folder / name)
    here = folder / "notebooks"
    here.mkdir()
    space: dict[str, object] = {"__name__": "__main__"}
    with contextlib.chdir(here):
        for cell in code_cells(notebook):
            yield _outputs("".join(cell["source"]), space)


def _outputs(source: str, space: dict[str, object]) -> list[Json]:
    tree, out = ast.parse(source), io.StringIO()
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(out):
        exec(compile(tree, "cell", "exec"), space)
        assert last is None or isinstance(last, ast.Expr)
        value = None if last is None else eval(compile(ast.Expression(last.value), "cell", "eval"), space)
    found: list[Json] = []
    if said := out.getvalue():
        found.append({"output_type": "stream", "name": "stdout", "text": said.splitlines(keepends=True)})
    if value is not None:
        found.append(_shown(value))
    return found


def _shown(value: Any) -> Json:
    if hasattr(value, "_repr_png_"):
        data: Json = {
            "image/png": b64encode(value._repr_png_()).decode(),
            "text/plain": ["<a picture>"],
        }
    else:
        data = {"text/plain": repr(value).splitlines(keepends=True)}
    return {"output_type": "execute_result", "execution_count": None, "metadata": {}, "data": data}


def text_of(output: Json) -> str:
    """What an output says in words."""
    return "".join(output["text"] if output["output_type"] == "stream" else output["data"]["text/plain"])


def write(path: Path) -> None:
    """Run a notebook and keep what came out."""
    notebook = read(path)
    with tempfile.TemporaryDirectory() as folder:
        for number, (cell, outputs) in enumerate(
            zip(code_cells(notebook), run(notebook, Path(folder)), strict=True), start=1
        ):
            cell["outputs"], cell["execution_count"] = outputs, number
            for output in outputs:
                if "execution_count" in output:
                    output["execution_count"] = number
    path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    os.environ.setdefault("COLUMNS", "80")
    for wanted in [Path(it) for it in sys.argv[1:]] or notebooks():
        write(wanted)
        print(wanted.name, flush=True)
