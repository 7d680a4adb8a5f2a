"""The shape of the house: imports point one way, files and functions stay small, everything public says what it is."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from statistics import median

import pytest

ROOT = Path(__file__).resolve().parent.parent
# What each package may import of the others. vjm is pure mechanics: no mesh, no solid; reports reads files only.
MAY_IMPORT = {
    "meshes": set(),
    "fem": {"meshes"},
    "vjm": set(),
    "reports": set(),
    "pipeline": {"meshes", "fem", "vjm", "reports"},
    "docs": {"meshes", "fem", "vjm", "reports", "pipeline"},
}
FILE_LINES, MEDIAN_LINES, FUNCTION_LINES = 400, 120, 60

# Calls that fail a test by themselves; pydantic's model_validate raises on an invalid record.
CHECKING = {"raises", "fail", "warns", "model_validate"}

FunctionNode = ast.FunctionDef | ast.AsyncFunctionDef


def sources(*packages: str) -> list[Path]:
    return sorted(p for package in packages for p in (ROOT / package).rglob("*.py"))


def name_of(path: Path) -> str:
    """Dotted module name; a package is its own __init__."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@cache
def parse(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"), filename=str(path))


PACKAGED = sources(*MAY_IMPORT)
MODULES = {name_of(path): path for path in PACKAGED}
TESTS = sorted((ROOT / "tests").rglob("*.py"))


@cache
def trees() -> dict[Path, ast.Module]:
    """Every packaged file, parsed once and only where it is asked for."""
    return {path: parse(path) for path in PACKAGED}


@cache
def rigs() -> frozenset[str]:
    """Classes that say what a kind of rig is; what differs between kinds is theirs to answer."""
    folder = ROOT / "pipeline" / "campaign" / "rigs"
    inside = [node for path, tree in trees().items() if path.is_relative_to(folder) for node in tree.body]
    return frozenset(node.name for node in inside if isinstance(node, ast.ClassDef))


def imported(path: Path, tree: ast.Module) -> Iterator[tuple[str, int]]:
    """Dotted names that a module imports, wherever in the file, with their lines."""
    package = name_of(path).split(".")
    if path.name != "__init__.py":
        package = package[:-1]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name, node.lineno
        elif isinstance(node, ast.ImportFrom):
            stem = package[: len(package) - node.level + 1] if node.level else []
            base = ".".join([*stem, *([node.module] if node.module else [])])
            for alias in node.names:
                inner = f"{base}.{alias.name}"
                yield (inner if inner in MODULES else base), node.lineno
        elif isinstance(node, ast.Call) and (name := by_name(node)):
            yield name, node.lineno


def by_name(call: ast.Call) -> str:
    """The module that a call of import_module names outright; empty for other calls."""
    called = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    first = call.args[0] if call.args else None
    named = called == "import_module" and isinstance(first, ast.Constant) and isinstance(first.value, str)
    return str(first.value) if named and isinstance(first, ast.Constant) else ""


def one_way_offenders(path: Path, tree: ast.Module) -> list[str]:
    """Imports of a sister package that this file's package may not have."""
    own = path.relative_to(ROOT).parts[0]
    allowed = MAY_IMPORT[own] | {own}
    return [
        f"{path.relative_to(ROOT)}:{line} imports {name}"
        for name, line in imported(path, tree)
        if name.split(".")[0] in (set(MAY_IMPORT) | {"tests"}) - allowed
    ]


def circle(graph: dict[str, set[str]]) -> list[str]:
    """One circle of a directed graph, first node repeated at its end; empty if there is none."""
    done: set[str] = set()

    def visit(node: str, trail: list[str]) -> list[str]:
        if node in trail:
            return [*trail[trail.index(node) :], node]
        if node in done:
            return []
        for following in sorted(graph.get(node, ())):
            if found := visit(following, [*trail, node]):
                return found
        done.add(node)
        return []

    for start in sorted(graph):
        if found := visit(start, []):
            return found
    return []


def functions(tree: ast.AST) -> Iterator[FunctionNode]:
    return (n for n in ast.walk(tree) if isinstance(n, ast.FunctionDef | ast.AsyncFunctionDef))


def long_functions(path: Path, tree: ast.Module) -> list[str]:
    return [
        f"{path.relative_to(ROOT)}:{f.lineno} {f.name} has {f.end_lineno - f.lineno + 1} lines"
        for f in functions(tree)
        if f.end_lineno is not None and f.end_lineno - f.lineno + 1 > FUNCTION_LINES
    ]


def undocumented(path: Path, tree: ast.Module) -> list[str]:
    """Public classes and functions at the top of a module without a docstring, and the module itself."""
    # A file of constants or an empty __init__ needs none.
    nodes = [
        n for n in tree.body if isinstance(n, ast.ClassDef | FunctionNode) and not n.name.startswith("_")
    ]
    where = path.relative_to(ROOT)
    found = [f"{where}:{n.lineno} {n.name}" for n in nodes if not ast.get_docstring(n)]
    return found if ast.get_docstring(tree) or not tree.body else [f"{where}:1 the module", *found]


def asserts(function: FunctionNode, helpers: set[str]) -> bool:
    """Whether a test can fail by itself: assert, pytest.raises, numpy's assert_*, or a helper that does."""
    for node in ast.walk(function):
        if isinstance(node, ast.Assert):
            return True
        if isinstance(node, ast.Call):
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            if called.startswith("assert_") or called in CHECKING | helpers:
                return True
    return False


def asserting_nothing(path: Path, tree: ast.Module) -> list[str]:
    every = list(functions(tree))
    helpers = {f.name for f in every if not f.name.startswith("test_") and asserts(f, set())}
    tests = [f for f in every if f.name.startswith("test_")]
    return [f"{path}:{f.lineno} {f.name}" for f in tests if not asserts(f, helpers)]


def wildcards(path: Path, tree: ast.Module) -> list[str]:
    return [
        f"{path.relative_to(ROOT)}:{n.lineno}"
        for n in ast.walk(tree)
        if isinstance(n, ast.ImportFrom) and any(a.name == "*" for a in n.names)
    ]


def kind_switches(path: Path, tree: ast.Module) -> list[str]:
    """Where a path is chosen by the kind of a rig: comparisons, look-ups and matches of `rig.kind` or `rig["kind"]`,
    and isinstance with a class of rigs, other than in an assert that only tells the type."""
    told = {id(n) for a in ast.walk(tree) if isinstance(a, ast.Assert) for n in ast.walk(a)}
    chosen: list[ast.AST] = []
    by_class: list[ast.AST] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            chosen += [node.left, *node.comparators]
        elif isinstance(node, ast.Subscript):
            chosen.append(node.slice)
        elif isinstance(node, ast.Match):
            chosen.append(node.subject)
        elif (
            isinstance(node, ast.Call)
            and getattr(node.func, "id", "") == "isinstance"
            and id(node) not in told
        ):
            names = {n.id for n in ast.walk(node.args[1]) if isinstance(n, ast.Name)}
            by_class += [node] * bool(names & rigs())
    found = [*filter(_is_a_rigs_kind, chosen), *by_class]
    return [f"{path.relative_to(ROOT)}:{n.lineno} {ast.unparse(n)}" for n in found]  # type: ignore[attr-defined]


def _is_a_rigs_kind(node: ast.AST) -> bool:
    if isinstance(node, ast.Attribute) and node.attr == "kind":
        return ast.unparse(node.value).split(".")[-1].endswith("rig")
    key = node.slice if isinstance(node, ast.Subscript) else None
    if not isinstance(node, ast.Subscript) or not isinstance(key, ast.Constant) or key.value != "kind":
        return False
    return ast.unparse(node.value).endswith(("rig", "rig']"))


@cache
def import_graph() -> dict[str, set[str]]:
    """Modules of the packages and what they import of each other."""
    graph = {}
    for path, tree in trees().items():
        here = name_of(path)
        graph[here] = {n for n, _ in imported(path, tree) if n in MODULES and n != here}
    return graph


def collected(check: object) -> str:
    """Offenders over all packaged files, one a line."""
    return "\n".join(line for path, tree in trees().items() for line in check(path, tree))  # type: ignore[operator]


def test_there_is_something_to_check() -> None:
    for package in MAY_IMPORT:
        assert sources(package), f"{package}/ has no Python files"
    assert len(TESTS) > 20


def test_imports_point_one_way() -> None:
    assert not collected(one_way_offenders)


def test_no_import_circles() -> None:
    assert not circle(import_graph()), " -> ".join(circle(import_graph()))


def test_files_are_read_below_what_they_describe() -> None:
    """Lines, complaints and types of values stand below campaigns and manipulators, which both are such files."""
    used = {
        name
        for module, names in import_graph().items()
        if module.startswith("pipeline.toml.")
        for name in names
        if name.startswith("pipeline.") and not name.startswith("pipeline.toml")
    }
    assert used == {"pipeline.errors"}


def test_sentences_and_tables_are_made_from_records_alone() -> None:
    """What an answer says can be said of its file again: nothing is worked out while it is written."""
    records = {"pipeline.answer.evidence", "pipeline.answer.record", "pipeline.answer.value"}
    plain = {"pipeline.parameter_names", "pipeline.terminal", "reports.quantities"}
    for folder in ("pipeline.answer.wording", "pipeline.answer.tables"):
        for module, names in import_graph().items():
            if module.startswith(folder):
                others = {name for name in names if not name.startswith("pipeline.answer.wording")}
                others = {name for name in others if not name.startswith("pipeline.answer.tables")}
                assert others <= records | plain, f"{module}: {sorted(others - records - plain)}"


def test_nothing_but_a_campaigns_readers_asks_for_the_kind_of_a_rig() -> None:
    here = {path: tree for path, tree in trees().items() if path.is_relative_to(ROOT / "pipeline")}
    readers = ROOT / "pipeline" / "campaign"
    found = [
        line
        for path, tree in here.items()
        if not path.is_relative_to(readers)
        for line in kind_switches(path, tree)
    ]
    assert not found, "\n".join(found)


def test_files_are_short() -> None:
    lengths = {p: len(p.read_text(encoding="utf-8").splitlines()) for p in [*PACKAGED, *TESTS]}
    too_long = [f"{p.relative_to(ROOT)} has {n} lines" for p, n in lengths.items() if n > FILE_LINES]
    assert not too_long, "\n".join(too_long)
    middle = median(lengths[p] for p in PACKAGED)
    assert middle < MEDIAN_LINES, f"the median file has {middle} lines"


def test_functions_are_short() -> None:
    assert not collected(long_functions)


def test_no_wildcard_imports() -> None:
    offenders = collected(wildcards) + "\n".join(line for p in TESTS for line in wildcards(p, parse(p)))
    assert not offenders


def test_every_test_asserts_something() -> None:
    offenders = [line for p in TESTS for line in asserting_nothing(p.relative_to(ROOT), parse(p))]
    assert not offenders, "\n".join(offenders)


def test_everything_public_has_a_docstring() -> None:
    offenders = collected(undocumented)
    assert not offenders, offenders


BAD = {
    "one way": (one_way_offenders, "fem/x.py", "import vjm.chain\n", "fem/x.py:1 imports vjm.chain"),
    "one way, inside a function": (
        one_way_offenders,
        "vjm/x.py",
        "def f():\n    from meshes import solid\n",
        "vjm/x.py:2 imports meshes.solid",
    ),
    "one way, relative": (one_way_offenders, "reports/x.py", "from ..fem import beam\n", "imports fem.beam"),
    "one way, by name": (
        one_way_offenders,
        "vjm/x.py",
        'from importlib import import_module\nimport_module("pipeline.cli")\n',
        "vjm/x.py:2 imports pipeline.cli",
    ),
    "tests are no library": (
        one_way_offenders,
        "pipeline/x.py",
        "from tests.fem import bar_p\n",
        "imports tests",
    ),
    "long function": (
        long_functions,
        "fem/x.py",
        "def f():\n" + "    pass\n" * 60,
        "fem/x.py:1 f has 61 lines",
    ),
    "wildcard": (wildcards, "fem/x.py", "from math import *\n", "fem/x.py:1"),
    "kind, compared": (
        kind_switches,
        "pipeline/x.py",
        'def f(rig):\n    return rig.kind == "bar"\n',
        "pipeline/x.py:2 rig.kind",
    ),
    "kind, looked up": (kind_switches, "pipeline/x.py", 'X[data["rig"]["kind"]]\n', "pipeline/x.py:1"),
    "kind, by class": (kind_switches, "pipeline/x.py", "isinstance(it.rig, BarRig)\n", "pipeline/x.py:1"),
    "docstring": (undocumented, "fem/x.py", '"""x"""\ndef f(): pass\n', "fem/x.py:2 f"),
}


@pytest.mark.parametrize("case", BAD)
def test_each_check_names_its_offender(case: str) -> None:
    """A planted offence turns the check red."""
    check, file, text, said = BAD[case]
    found = check(ROOT / file, ast.parse(text))
    assert len(found) == 1 and said in found[0], found


def test_a_planted_circle_and_an_empty_test_are_found() -> None:
    assert circle({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == ["b", "c", "b"]
    assert circle({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == []
    tree = ast.parse("def test_x():\n    f()\ndef check():\n    assert 1\ndef test_y():\n    check()\n")
    assert asserting_nothing(Path("t.py"), tree) == ["t.py:1 test_x"]
