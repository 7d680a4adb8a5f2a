"""Figures of how the code is kept, each counted by a rule that stands here: `python -m tests.figures` prints them all.

They serve one question: whether somebody who never saw the code changes it after reading a few files.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.test_architecture import (
    PACKAGED,
    ROOT,
    circle,
    functions,
    import_graph,
    imported,
    kind_switches,
    name_of,
    parse,
)

PRODUCT = ("meshes", "fem", "vjm", "pipeline", "reports", "parastiff")
FOUND_BY_THEMSELVES = (
    "vjm/effects",
    "vjm/forms",
    "vjm/tolerances",
    "fem/frame/laws/forms",
    "pipeline/campaign/rigs",
    "pipeline/campaign/formats",
    "pipeline/selection/mistakes",
    "pipeline/export/formats",
    "docs/made",
)
"""Folders whose files nobody imports by name."""
PLAIN = frozenset({0.0, 1.0, 2.0, 3.0, 0.5, 6.0, 7.0, 12.0})
"""Numbers that say themselves what they are: counts of directions, halves, places of a wrench and its parts."""
THRESHOLDS_STAND_IN = (
    "pipeline/selection/criteria.py",
    "pipeline/inference/solvers.py",
    "pipeline/inference/levenberg_marquardt.py",
)
"""The record of the criteria, and the tolerances of the two solvers."""
PLAY = ("play", "clearance")
"""In an identifier: the effect of a play, the sides of its stops."""
POSTURE = frozenset({"q_deg", "at_mm"})
"""How a posture of one kind of rig is written: an angle of a bench, a point of a machine."""
POSTURES_STAND_IN = ("pipeline/campaign", "pipeline/init", "pipeline/assessment", "pipeline/validation")
"""Files that read or write such tables, virtual benches that measure them, and the validation's own cases."""
ARRAYS = ("Array", "ndarray", "Mask", "Readings")
SHORT = 60


@dataclass(frozen=True)
class Figure:
    """One figure: its name, what it is now, the most that is allowed, and the places that it counts.

    least: the bound is the least that is allowed.
    """

    name: str
    now: float
    bound: float
    places: tuple[str, ...] = ()
    least: bool = False

    @property
    def kept(self) -> bool:
        """Whether it is within its bound."""
        return self.now >= self.bound if self.least else self.now <= self.bound


def _files(*folders: str) -> list[Path]:
    return [path for path in PACKAGED if path.relative_to(ROOT).as_posix().startswith(folders)]


def _place(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def kinds() -> list[str]:
    """Where a path is chosen by the kind of a rig, outside the files that say what a kind is."""
    inside = ROOT / "pipeline" / "campaign"
    return [
        line
        for path in _files("pipeline/")
        if not path.is_relative_to(inside)
        for line in kind_switches(path, parse(path))
    ]


def postures() -> list[str]:
    """Files that name the posture of one kind of rig, outside those that read and write its tables."""
    return [
        _place(path)
        for path in _files("pipeline/")
        if not _place(path).startswith(POSTURES_STAND_IN) and POSTURE & set(_words(parse(path)))
    ]


def plays() -> list[str]:
    """Files outside vjm and the truth with an identifier that names a play."""
    return [
        _place(path)
        for path in _files("pipeline/", "reports/", "parastiff/")
        if not _place(path).startswith("pipeline/assessment/virtual")
        and any(part in word.lower().split("_") for word in _words(parse(path)) for part in PLAY)
    ]


def _words(tree: ast.Module) -> Iterator[str]:
    """Identifiers: names, attributes, arguments, functions and keywords."""
    for node in ast.walk(tree):
        for key in ("id", "attr", "arg", "name"):
            if isinstance(word := getattr(node, key, None), str):
                yield word


def literals(inside: bool) -> list[str]:
    """Numbers in inference and selection whose meaning has to be looked for; inside functions, or at module level."""
    found = []
    for path in _files("pipeline/inference/", "pipeline/selection/"):
        if _place(path) in THRESHOLDS_STAND_IN:
            continue
        tree = parse(path)
        within = {id(node) for function in functions(tree) for node in ast.walk(function)}
        found += [
            f"{_place(path)}:{node.lineno} {node.value}"
            for node in ast.walk(tree)
            if isinstance(node, ast.Constant)
            and type(node.value) in (int, float)
            and float(node.value) not in PLAIN
            and (id(node) in within) == inside
        ]
    return found


def shapes() -> tuple[list[str], int]:
    """Public functions with arrays in their signature whose docstring gives no shape, and how many there are.

    A shape is written in brackets: (N, 12), (B,), (..., k).
    """
    lacking, every = [], 0
    for path in _files(*(f"{package}/" for package in PRODUCT)):
        for node in parse(path).body:
            if not isinstance(node, ast.FunctionDef) or node.name.startswith("_"):
                continue
            noted = [a.annotation for a in (*node.args.args, *node.args.kwonlyargs)] + [node.returns]
            told = " ".join(ast.unparse(it) for it in noted if it is not None)
            if not any(array in told for array in ARRAYS):
                continue
            every += 1
            if not _shaped(ast.get_docstring(node) or ""):
                lacking.append(f"{_place(path)}:{node.lineno} {node.name}")
    return lacking, every


def _shaped(text: str) -> bool:
    parts = [part.split(")")[0] for part in text.split("(")[1:]]
    return any(
        "," in part and all(_a_size(word) for word in part.split(",") if word.strip()) for part in parts
    )


def _a_size(word: str) -> bool:
    """A number, a letter or a name of a count, with a sum or dots: no prose."""
    return " " not in word.strip() or all(each in "+-" or len(each) < 8 for each in word.split())


def lonely() -> list[str]:
    """Short modules that one other module imports, outside folders whose files are found by themselves."""
    importers: dict[str, set[str]] = {}
    for module, names in import_graph().items():
        for name in names:
            importers.setdefault(name, set()).add(module)
    return [
        _place(path)
        for path in _files(*(f"{package}/" for package in PRODUCT))
        if len(importers.get(name_of(path), ())) == 1
        and len(path.read_text(encoding="utf-8").splitlines()) < SHORT
        and not _place(path).startswith(FOUND_BY_THEMSELVES)
        and path.name not in ("__init__.py", "wiring.py")
    ]


def hidden() -> list[str]:
    """Imports by name of a module of the project, which no reader of the first lines of a file sees."""
    return [
        f"{_place(path)}:{line} {name}"
        for path in PACKAGED
        for node in ast.walk(parse(path))
        if isinstance(node, ast.Call)
        for name, line in imported(path, ast.Module([ast.Expr(node)], []))
        if name.split(".")[0] in PRODUCT
    ]


def lines() -> int:
    """Lines of the product that are code: no blank line, comment or docstring."""
    return sum(_code(path) for path in _files(*(f"{package}/" for package in PRODUCT)))


def _code(path: Path) -> int:
    text = path.read_text(encoding="utf-8").splitlines()
    told: set[int] = set()
    for node in ast.walk(parse(path)):
        if (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Constant)
            and isinstance(node.value.value, str)
        ):
            told.update(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    return sum(
        bool(line.strip()) and not line.lstrip().startswith("#") and number not in told
        for number, line in enumerate(text, 1)
    )


def _counted(name: str, bound: float, count: Callable[[], list[str]]) -> Figure:
    places = count()
    return Figure(name, len(places), bound, tuple(places))


def figures() -> tuple[Figure, ...]:
    """All of them; a bound is what is there, so that none grows unseen."""
    lacking, every = shapes()
    return (
        _counted("choices by the kind of a rig", 0, kinds),
        _counted("files that name the posture of one kind", 32, postures),
        _counted("files with an identifier of plays", 19, plays),
        _counted("numbers without a name, at module level", 98, lambda: literals(inside=False)),
        _counted("numbers without a name, in functions", 59, lambda: literals(inside=True)),
        Figure(
            "functions of arrays that give shapes, %",
            100.0 * (1 - len(lacking) / every),
            42,
            tuple(lacking),
            True,
        ),
        _counted("short modules of one importer", 50, lonely),
        _counted("imports by name", 0, hidden),
        _counted("circles of imports", 0, lambda: circle(import_graph())),
        Figure("lines of code", lines(), 60_000),
    )


def main() -> int:
    """Prints every figure, and with -v the places; 1 where a bound is broken."""
    found = figures()
    for it in found:
        print(f"{it.name:44}{it.now:10.5g} {'at least' if it.least else 'at most':>9}{it.bound:8.5g}")
        if "-v" in sys.argv:
            print("".join(f"    {place}\n" for place in it.places), end="")
    return 0 if all(it.kept for it in found) else 1


if __name__ == "__main__":
    sys.exit(main())
