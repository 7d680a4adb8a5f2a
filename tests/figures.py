"""Figures of how the code is kept, each counted by a rule that stands here: `python -m tests.figures` prints them all.

They serve one question: whether somebody who never saw the code changes it after reading a few files. A rule looks at
one file, its path and its tree, so that each can be tried on an offence (`tests/test_figures.py`).
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from tests.test_architecture import (
    MODULES,
    PACKAGED,
    ROOT,
    by_name,
    circle,
    functions,
    import_graph,
    imported,
    kind_switches,
    name_of,
    parse,
    sources,
)

PRODUCT = ("meshes", "fem", "vjm", "pipeline", "reports", "parastiff")
FOUND_BY_THEMSELVES = (
    "vjm/effects/",
    "vjm/forms/",
    "vjm/tolerances/",
    "fem/frame/laws/forms/",
    "pipeline/campaign/rigs/",
    "pipeline/campaign/formats/",
    "pipeline/selection/mistakes/",
    "pipeline/export/formats/",
)
"""Folders whose files nobody imports by name."""
PLAIN = frozenset({0.0, 1.0, 2.0, 3.0, 0.5, 6.0, 7.0, 12.0})
"""Numbers that say themselves what they are: counts of directions, halves, places of a wrench and its parts."""
THRESHOLDS_STAND_IN = (
    "pipeline/selection/criteria.py",
    "pipeline/selection/law_criteria.py",
    "pipeline/selection/table_criteria.py",
    "pipeline/inference/settings.py",
    "pipeline/inference/rounding.py",
    "pipeline/inference/solvers.py",
    "pipeline/inference/levenberg_marquardt.py",
)
"""The record of the criteria, that of the settings of numerical methods, and the tolerances of rounding and of the two
solvers."""
PLAY = re.compile(r"plays?|clearances?|stops|slides")
"""A word of an identifier: the effect of a play, the sides of its stops and the way between them."""
NO_PLAY = ("pipeline/studio/panes.py", "reports/shading.py", "pipeline/manipulator/frame_hinges.py")
"""Where such a word means another thing: the stops of a scale of colours, the slides of any joint."""
POSTURE = frozenset({"q_deg", "at_mm"})
"""How a posture of one kind of rig is written: an angle of a bench, a point of a machine."""
POSTURES_STAND_IN = (
    "pipeline/campaign/",
    "pipeline/init/",
    "pipeline/assessment/",
    "pipeline/validation/",
)
"""Files that read or write such tables, virtual benches that measure them, and the validation's own cases."""
RECORD = "Record"
"""The base of the records that are written: their fields are the public schema, and may be named so."""
SIZES = (
    *("cells", "chains", "columns", "corners", "count", "dofs", "gauges", "legs", "nodes", "planes", "plays"),
    *("points", "rows", "segments", "size", "springs", "stations", "steps", "tests"),
)
"""Names of counts that a shape may have beside letters, numbers and constants."""
_SIZE = rf"(?:\d+|\.\.\.|[A-Za-v]|[A-Z]{{3,}}|{'|'.join(SIZES)})"
_SUM = rf"{_SIZE}(?:(?: [+\-|] | ){_SIZE})*"
SHAPE = re.compile(rf"\((?:\.\.\.|{_SUM},|{_SUM}(?:, {_SUM})+)\)|\b\d+x\d+\b")
"""(N, 12), (B,), (..., 3 n + 1), (...) or 6x6; x, y, z are places, and units have more letters than one."""
SHORT = 60
WORDS: dict[type[ast.AST], str] = {
    ast.Name: "id",
    ast.Attribute: "attr",
    ast.arg: "arg",
    ast.keyword: "arg",
    ast.alias: "name",
    ast.ImportFrom: "module",
    ast.FunctionDef: "name",
    ast.AsyncFunctionDef: "name",
    ast.ClassDef: "name",
}
"""Where a node has its identifier."""


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


Rule = Callable[[Path, ast.Module], list[str]]


@cache
def _whole() -> tuple[Path, ...]:
    """Every file of the product: `PACKAGED` has the pages' own code, and not the public face."""
    return tuple(sorted({*PACKAGED, *sources("parastiff")}))


def _files(*folders: str) -> list[Path]:
    return [path for path in _whole() if _place(path).startswith(folders)]


def _product() -> list[Path]:
    return _files(*(f"{package}/" for package in PRODUCT))


def _place(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def _found(rule: Rule, files: list[Path], words: str = "") -> list[str]:
    """Places in these files. words: what one has to have for the rule to find anything; files without are not read."""
    return [line for path in files if re.search(words, _text(path)) for line in rule(path, parse(path))]


@cache
def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8")


@cache
def nodes(tree: ast.Module) -> list[ast.AST]:
    """All of a file, once for all rules."""
    return list(ast.walk(tree))


def kinds(path: Path, tree: ast.Module) -> list[str]:
    """Where a path is chosen by the kind of a rig, outside the files that say what a kind is."""
    return [] if _place(path).startswith("pipeline/campaign/") else kind_switches(path, tree)


def postures(path: Path, tree: ast.Module) -> list[str]:
    """A file that names the posture of one kind of rig, outside those that read and write its tables: by an identifier
    or a key. The fields of a record that is written are no names of its own: its schema is public."""
    if _place(path).startswith(POSTURES_STAND_IN):
        return []
    schema = {id(node) for node in _fields(tree)}
    words = {word for node in nodes(tree) if id(node) not in schema for word in (*_words(node), *_key(node))}
    return [_place(path)] if POSTURE & words else []


def _fields(tree: ast.Module) -> Iterator[ast.expr]:
    """Names of the fields of records that are written."""
    for each in nodes(tree):
        if isinstance(each, ast.ClassDef) and RECORD in map(ast.unparse, each.bases):
            yield from (node.target for node in each.body if isinstance(node, ast.AnnAssign))


def _key(node: ast.AST) -> tuple[str, ...]:
    return (node.value,) if isinstance(node, ast.Constant) and isinstance(node.value, str) else ()


def plays(path: Path, tree: ast.Module) -> list[str]:
    """A file outside vjm and the truth with an identifier that names a play."""
    if _place(path).startswith(("vjm/", "fem/", "pipeline/assessment/virtual/", *NO_PLAY)):
        return []
    words = {word for node in nodes(tree) for word in _words(node)}
    return [_place(path)] if any(PLAY.fullmatch(part) for word in words for part in _parts(word)) else []


def _words(node: ast.AST) -> tuple[str, ...]:
    """Identifiers: names, attributes, arguments, functions, classes, keywords, and modules that are imported."""
    key = WORDS.get(type(node))
    word = getattr(node, key) if key else None
    return (word,) if word else ()


def _parts(word: str) -> list[str]:
    """The words of an identifier, small: of two_words and of TwoWords."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", word).lower().replace(".", "_").split("_")


def literals(path: Path, tree: ast.Module, inside: bool) -> list[str]:
    """Numbers in inference and selection whose meaning has to be looked for; inside functions, or at module level."""
    if _place(path) in THRESHOLDS_STAND_IN:
        return []
    within = {id(node) for function in functions(tree) for node in ast.walk(function)}
    return [
        f"{_place(path)}:{node.lineno} {node.value}"
        for node in nodes(tree)
        if isinstance(node, ast.Constant)
        and type(node.value) in (int, float)
        and float(node.value) not in PLAIN
        and (id(node) in within) == inside
    ]


def numbers_inside(path: Path, tree: ast.Module) -> list[str]:
    """Those of `literals` in functions."""
    return literals(path, tree, inside=True)


def numbers_outside(path: Path, tree: ast.Module) -> list[str]:
    """Those of `literals` at module level."""
    return literals(path, tree, inside=False)


@cache
def functions_of_arrays(tree: ast.Module) -> list[ast.FunctionDef]:
    """Public functions of a module with arrays in their signature, under whatever name the module has for them."""
    names = {"NDArray", "ndarray", *_aliases(tree), *_borrowed(tree)}
    return [
        node
        for node in tree.body
        if isinstance(node, ast.FunctionDef)
        and not node.name.startswith("_")
        and names & {word for it in _annotations(node) for each in ast.walk(it) for word in _words(each)}
    ]


def _annotations(node: ast.FunctionDef) -> list[ast.expr]:
    every = (*node.args.posonlyargs, *node.args.args, node.args.vararg, *node.args.kwonlyargs)
    noted = [*(a.annotation for a in every if a is not None), node.returns]
    return [it for it in noted if it is not None]


@cache
def _aliases(tree: ast.Module) -> set[str]:
    """Names that a module gives to arrays: Array = NDArray[np.float64]."""
    return {
        target.id
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Subscript)
        for target in node.targets
        if isinstance(target, ast.Name) and ast.unparse(node.value.value).split(".")[-1] == "NDArray"
    }


@cache
def _borrowed(tree: ast.Module) -> set[str]:
    """Names of arrays that a module imports from another one of the project."""
    return {
        alias.asname or alias.name
        for node in tree.body
        if isinstance(node, ast.ImportFrom) and node.module in MODULES
        for alias in node.names
        if alias.name in _aliases(parse(MODULES[node.module]))
    }


def shapeless(path: Path, tree: ast.Module) -> list[str]:
    """Those functions of arrays whose docstring gives no shape."""
    return [
        f"{_place(path)}:{node.lineno} {node.name}"
        for node in functions_of_arrays(tree)
        if not SHAPE.search(" ".join((ast.get_docstring(node) or "").split()))
    ]


def lonely(graph: dict[str, set[str]], lengths: dict[str, int]) -> list[str]:
    """Short modules that one other module imports, outside folders whose files are found by themselves.

    graph: modules and what they import. lengths: lines of each file, by its place.
    """
    importers: dict[str, set[str]] = {}
    for module, names in graph.items():
        for name in names:
            importers.setdefault(name, set()).add(module)
    return [
        place
        for place, length in lengths.items()
        if length < SHORT
        and len(importers.get(name_of(ROOT / place), ())) == 1
        and not place.startswith(FOUND_BY_THEMSELVES)
        and not place.endswith(("/__init__.py", "/__main__.py", "/wiring.py"))
    ]


def _graph() -> dict[str, set[str]]:
    """Of every module, with what the public face imports."""
    face = {
        name_of(path): {name for name, _ in imported(path, parse(path)) if name in MODULES}
        for path in sources("parastiff")
    }
    return import_graph() | face


def hidden(path: Path, tree: ast.Module) -> list[str]:
    """Imports by name of a module of the project, which no reader of the first lines of a file sees."""
    return [
        f"{_place(path)}:{node.lineno} {by_name(node)}"
        for node in nodes(tree)
        if isinstance(node, ast.Call) and by_name(node).split(".")[0] in PRODUCT
    ]


def code(path: Path) -> int:
    """Lines of a file that are code: no blank line, comment or docstring."""
    return code_in(_text(path), parse(path))


def code_in(text: str, tree: ast.Module) -> int:
    """The same of a text and its tree."""
    told: set[int] = set()
    inside: list[ast.AST] = [tree]
    while inside:
        node = inside.pop()
        for part in ("body", "orelse", "finalbody", "handlers", "cases"):
            inside += getattr(node, part, ())
        if isinstance(node, ast.Expr) and _key(node.value):
            told.update(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    return sum(
        bool(line.strip()) and not line.lstrip().startswith("#") and number not in told
        for number, line in enumerate(text.splitlines(), 1)
    )


def _counted(name: str, bound: float, places: list[str]) -> Figure:
    return Figure(name, len(places), bound, tuple(places))


def figures() -> tuple[Figure, ...]:
    """All of them; a bound is what is there, so that none grows unseen."""
    product, pipeline = _product(), _files("pipeline/")
    numerics = _files("pipeline/inference/", "pipeline/selection/")
    lacking = _found(shapeless, product)
    every = sum(len(functions_of_arrays(parse(path))) for path in product)
    lengths = {_place(path): len(_text(path).splitlines()) for path in product}
    graph = _graph()
    ring = circle(graph)
    return (
        _counted("choices by the kind of a rig", 0, _found(kinds, pipeline, "kind|isinstance")),
        _counted(
            "files that name the posture of one kind", 24, _found(postures, pipeline, "|".join(POSTURE))
        ),
        _counted("files with an identifier of plays", 12, _found(plays, product, f"(?i){PLAY.pattern}")),
        _counted("numbers without a name, at module level", 4, _found(numbers_outside, numerics)),
        _counted("numbers without a name, in functions", 5, _found(numbers_inside, numerics)),
        Figure(
            "functions of arrays that give shapes, %",
            100.0 * (1 - len(lacking) / every),
            99.5,
            tuple(lacking),
            least=True,
        ),
        _counted("short modules of one importer", 40, lonely(graph, lengths)),
        _counted("imports by name", 0, _found(hidden, list(_whole()), "import_module")),
        _counted("circles of imports", 0, [" -> ".join(ring)] if ring else []),
        Figure("lines of code", sum(map(code, product)), 60_000),
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
