"""The wheel holds the packages under one name: `parastiff.pipeline` for what is `pipeline` in a checkout.

A copy is made while the wheel is built, with its imports rewritten; nothing in the checkout is renamed or doubled. What
a library or a person can find by name on a machine is `parastiff` alone, so that a user's own `fem.py` or `reports/` is
in nobody's way.
"""

from __future__ import annotations

import ast
import re
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NAME = "parastiff"
PACKAGES = ("fem", "meshes", "pipeline", "reports", "vjm")
DATA = (".csv", ".css", ".j2", ".js", ".toml", ".typed")
LEFT_OUT = {
    "reports": ("challenge", "coverage", "extrapolation", "sensitivity", "studio", "validation"),
    "pipeline": tuple(
        f"assessment/{study}"
        for study in [
            "challenge/laws",
            "doubts",
            "extrapolation",
            "left_out",
            "mistaken",
            "prediction",
            "sensitivity",
        ]
    ),
}
"""Folders of packages that only a checkout has: results, and studies of the diagnosis that no command runs."""
EXAMPLE = "examples/bench"
_MODULE = re.compile(rf"(?:{'|'.join(PACKAGES)})(?:\.[A-Za-z_]\w*)+")


class UnderOneName(BuildHookInterface):  # type: ignore[type-arg]
    """Puts the rewritten copy into the wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Nothing to do for an editable install: its packages are those of the checkout."""
        if version == "editable":
            return
        self.copy = Path(tempfile.mkdtemp(prefix="parastiff-wheel-"))
        for source, text in laid_out(Path(self.root)):
            place = self.copy / source
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(text)
        build_data["force_include"][str(self.copy)] = NAME

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """The copy is gone with the build."""
        if version != "editable":
            shutil.rmtree(self.copy, ignore_errors=True)


def laid_out(root: Path) -> Iterator[tuple[str, bytes]]:
    """Every file of the package by its place in it."""
    modules = {m for package in PACKAGES for m in _modules(root / package, package)}
    for folder in (NAME, *PACKAGES, EXAMPLE):
        for path in sorted((root / folder).rglob("*")):
            inside = path.relative_to(root / folder)
            if not path.is_file() or any(map(inside.is_relative_to, LEFT_OUT.get(folder, ()))):
                continue
            where = inside.as_posix() if folder == NAME else f"{folder}/{inside.as_posix()}"
            if path.suffix == ".py":
                yield where, rewritten(path.read_text(encoding="utf-8"), modules, str(path)).encode()
            elif path.suffix in DATA:
                yield where, path.read_bytes()


def _modules(folder: Path, package: str) -> Iterator[str]:
    for path in folder.rglob("*.py"):
        parts = path.relative_to(folder).with_suffix("").parts
        yield ".".join((package, *(p for p in parts if p != "__init__")))


def rewritten(text: str, modules: set[str], where: str) -> str:
    """The source with its imports, and strings that name a module, under one name. ValueError where that cannot be."""
    lines = text.split("\n")
    edits: list[tuple[int, int, str, str]] = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and not node.level and _ours(node.module or ""):
            edits.append((node.lineno, node.col_offset, f"from {node.module}", f"from {NAME}.{node.module}"))
        elif isinstance(node, ast.Import) and any(_ours(each.name) for each in node.names):
            raise ValueError(
                f"{where} line {node.lineno}: write `from ... import ...`, which the wheel can rename"
            )
        elif isinstance(node, ast.Constant) and node.value in modules and _MODULE.fullmatch(str(node.value)):
            edits.append((node.lineno, node.col_offset + 1, node.value, f"{NAME}.{node.value}"))
    for number, column, old, new in sorted(edits, reverse=True):
        line = lines[number - 1]
        # The syntax tree counts bytes.
        at = len(line.encode()[:column].decode())
        if not line.startswith(old, at):
            raise ValueError(f"{where} line {number}: expected {old!r}, found {line[at:]!r}")
        lines[number - 1] = line[:at] + new + line[at + len(old) :]
    return "\n".join(lines)


def _ours(module: str) -> bool:
    return module.partition(".")[0] in PACKAGES
