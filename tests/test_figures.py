"""The figures of how the code is kept stay within their bounds, and each rule finds what it is for."""

from __future__ import annotations

import ast
from functools import cache

import pytest

from tests import figures as of
from tests.figures import Figure, Rule
from tests.test_architecture import ROOT

NAMES = (
    "choices by the kind of a rig",
    "files that name the posture of one kind",
    "files with an identifier of plays",
    "numbers without a name, at module level",
    "numbers without a name, in functions",
    "functions of arrays that give shapes, %",
    "short modules of one importer",
    "imports by name",
    "circles of imports",
    "lines of code",
)


@cache
def found() -> dict[str, Figure]:
    return {it.name: it for it in of.figures()}


def test_there_are_these_figures() -> None:
    assert tuple(found()) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_a_figure_is_within_its_bound(name: str) -> None:
    it = found()[name]
    assert it.kept, f"{it.now:g}, allowed is {it.bound:g}:\n" + "\n".join(it.places)


def test_a_bound_is_the_most_or_the_least() -> None:
    assert Figure("", 1.0, 1.0).kept and not Figure("", 1.1, 1.0).kept
    assert Figure("", 1.0, 1.0, least=True).kept and not Figure("", 0.9, 1.0, least=True).kept


OF_ARRAYS = "from numpy.typing import NDArray\nArray = NDArray[float]\n"
BAD: dict[str, tuple[Rule, str, str, str]] = {
    "kind": (of.kinds, "pipeline/x.py", 'rig.kind == "bar"\n', "pipeline/x.py:1 rig.kind"),
    "posture, an attribute": (of.postures, "pipeline/x.py", "test.q_deg\n", "pipeline/x.py"),
    "posture, a key": (of.postures, "pipeline/x.py", 'row["at_mm"]\n', "pipeline/x.py"),
    "posture, given to a record": (of.postures, "pipeline/x.py", "Row(q_deg=0.0)\n", "pipeline/x.py"),
    "posture, a field that nobody writes": (
        of.postures,
        "pipeline/x.py",
        "class Place:\n    q_deg: float\n",
        "pipeline/x.py",
    ),
    "play": (of.plays, "reports/x.py", "def play_of(it): ...\n", "reports/x.py"),
    "play, several": (of.plays, "pipeline/x.py", "PLAYS = 2\n", "pipeline/x.py"),
    "play, in a name of two words": (
        of.plays,
        "pipeline/x.py",
        "class RadialClearance: ...\n",
        "pipeline/x.py",
    ),
    "play, its stops": (of.plays, "pipeline/x.py", "found.no_stops\n", "pipeline/x.py"),
    "play, a module": (of.plays, "pipeline/x.py", "from vjm.play import law\n", "pipeline/x.py"),
    "number in a function": (
        of.numbers_inside,
        "pipeline/inference/x.py",
        "A = 4\ndef f(x=0.3):\n    return 2 * x\n",
        "pipeline/inference/x.py:2 0.3",
    ),
    "number at module level": (
        of.numbers_outside,
        "pipeline/selection/x.py",
        "A = 4\nB = (3, True, 'four')\ndef f():\n    return 5\n",
        "pipeline/selection/x.py:1 4",
    ),
    "array without a shape": (
        of.shapeless,
        "vjm/x.py",
        OF_ARRAYS + 'def f(x: Array) -> float:\n    """Of it."""\n',
        "vjm/x.py:3 f",
    ),
    "array of another module": (
        of.shapeless,
        "fem/x.py",
        'from meshes.solid import Floats\ndef f() -> list[Floats]:\n    """Of it."""\n',
        "fem/x.py:2 f",
    ),
    "array with prose in brackets": (
        of.shapeless,
        "vjm/x.py",
        OF_ARRAYS + 'def f(x: Array):\n    """Along (x, y) in (mm, rad) (see it, or not)."""\n',
        "vjm/x.py:3 f",
    ),
    "import by name": (
        of.hidden,
        "pipeline/x.py",
        'print(import_module("vjm.chain"), import_module("scipy.linalg"))\n',
        "pipeline/x.py:1 vjm.chain",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_each_rule_names_its_offender(case: str) -> None:
    """A planted offence is counted, once."""
    rule, file, text, said = BAD[case]
    assert rule(ROOT / file, ast.parse(text)) == [said]


GOOD: dict[str, tuple[Rule, str, str]] = {
    "kind, where it is said": (of.kinds, "pipeline/campaign/x.py", 'rig.kind == "bar"\n'),
    "posture, of a public record": (of.postures, "pipeline/x.py", "class Row(Record):\n    q_deg: float\n"),
    "posture, in prose": (of.postures, "pipeline/x.py", '"""A test has q_deg."""\n'),
    "posture, in a table": (of.postures, "pipeline/campaign/x.py", "test.q_deg\n"),
    "play, of another word": (of.plays, "pipeline/x.py", "display(playing, replay, stop)\n"),
    "play, in the mechanics": (of.plays, "vjm/x.py", "play = 1\n"),
    "numbers of the record": (of.numbers_outside, "pipeline/inference/settings.py", "A = 4\n"),
    "numbers that say themselves": (
        of.numbers_inside,
        "pipeline/inference/x.py",
        "def f(x):\n    return x[:6] / 2\n",
    ),
    "not public": (of.shapeless, "vjm/x.py", OF_ARRAYS + "def _f(x: Array): ...\n"),
    "no array": (of.shapeless, "vjm/x.py", "from numpy import Array\ndef f(x: Array, y: float): ...\n"),
    "import by name, of others": (of.hidden, "pipeline/x.py", 'import_module("scipy.linalg")\n'),
}


@pytest.mark.parametrize("case", GOOD)
def test_a_rule_lets_pass_what_it_is_not_for(case: str) -> None:
    rule, file, text = GOOD[case]
    assert rule(ROOT / file, ast.parse(text)) == []


@pytest.mark.parametrize(
    "shape",
    ["(N, 12)", "(B,)", "(...)", "(..., 3 n + 1)", "(m, 6 | 15)", "(B, legs, 6, 6)", "6x6", "(rows,\n    K)"],
)
def test_a_shape_is_told(shape: str) -> None:
    tree = ast.parse(OF_ARRAYS + f'def f(x: Array):\n    """An array {shape} of it."""\n')
    assert not of.shapeless(ROOT / "vjm/x.py", tree)


def test_a_short_module_of_one_importer_is_found() -> None:
    graph = {
        "vjm.a": {"vjm.short", "vjm.long", "vjm.shared", "vjm.effects.found", "vjm.wiring"},
        "vjm.b": {"vjm.shared"},
    }
    lengths = {
        "vjm/short.py": of.SHORT - 1,
        "vjm/long.py": of.SHORT,
        "vjm/shared.py": 1,
        "vjm/effects/found.py": 1,
        "vjm/wiring.py": 1,
        "vjm/unused.py": 1,
    }
    assert of.lonely(graph, lengths) == ["vjm/short.py"]


def test_lines_of_code_are_no_comments_and_no_docstrings() -> None:
    text = '"""Module,\nin two lines."""\n\n# A comment.\nA = 1  # one\n"""What it is."""\nB = """a\n\nb"""\n'
    assert of.code_in(text, ast.parse(text)) == 3


def test_the_public_face_is_part_of_the_product() -> None:
    assert found()["lines of code"].now > sum(
        of.code(path) for path in of.PACKAGED if "docs" not in path.parts
    )
