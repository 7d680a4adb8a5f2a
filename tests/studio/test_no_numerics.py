"""The studio computes nothing: it calls what the command line calls."""

from __future__ import annotations

import ast

from tests.test_architecture import imported, name_of, trees


def test_the_studio_imports_no_numerical_library() -> None:
    mine = {path: tree for path, tree in trees().items() if name_of(path).startswith("pipeline.studio")}
    assert len(mine) >= 8
    found = {name for path, tree in mine.items() for name, _ in imported(path, tree)}
    assert not [name for name in found if name.split(".")[0] in ("numpy", "scipy", "fem", "vjm", "pandas")]
    # Whatever it asks of a model goes through the two commands and the page.
    asked = {
        name
        for name in found
        if name.startswith(("pipeline.add", "pipeline.selection", "pipeline.inference"))
    }
    assert {"pipeline.add.fitting", "pipeline.selection.diagnosis"} <= asked
    assert not [
        name for name in asked if name.split(".")[-1] in ("fit", "prediction", "residual", "intervals")
    ]


def test_what_the_studio_does_holds_no_arithmetic() -> None:
    """Beside the views, that is."""
    operators = (ast.Mult, ast.Pow, ast.MatMult)
    for path, tree in trees().items():
        if path.stem in ("work", "session", "worker") and "studio" in path.parts:
            found = [
                n.lineno for n in ast.walk(tree) if isinstance(n, ast.BinOp) and isinstance(n.op, operators)
            ]
            assert not found, f"{path.name}: {found}"
