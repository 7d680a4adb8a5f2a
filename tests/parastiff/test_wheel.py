"""The wheel: one name, small, and everything that the checkout does, in a folder with a user's own `fem.py`."""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import hatch_build
import parastiff

ROOT = Path(__file__).resolve().parents[2]
LARGEST = 1_500_000
"""Bytes of the wheel: its code takes 1.13 million; results of the checkout would be millions more."""
OWN = """
from {module} import Effect, Parameter
from {laws} import laws
from dataclasses import replace


class SealSpring(Effect):
    name, hinge = "seal_spring", "any"
    title, equation = "seals stiffen the hinges", "M = c angle³"
    signature, limits, source = "a force that grows with the cube", "all hinges alike", "for a test"
    parameters = (Parameter("cubic_Nmm", "N·mm/rad³", 0.0, 5e6, 0.0, 1e9, "torque at one radian"),)

    def change(self, rig, values):
        return replace(rig, hinges=(*rig.hinges, laws.Polynomial((0.0, 0.0, values["cubic_Nmm"]))))
"""
SPREAD = """
import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
import parastiff
from joblib import Parallel, delayed

def chi_square(folder):
    return parastiff.compare(folder).record.model_of("vjm").fit

if __name__ == "__main__":
    Path("kept.pickle").write_bytes(pickle.dumps((parastiff.read("bench"), parastiff.catalogue())))
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        spawned = pool.submit(chi_square, "bench").result()
    loky = Parallel(n_jobs=2, backend="loky")(delayed(chi_square)("bench") for _ in range(2))
    print(spawned == loky[0] == loky[1])
"""
AGAIN = """
import pickle
from pathlib import Path
campaign, effects = pickle.loads(Path("kept.pickle").read_bytes())
print(type(campaign).__module__, effects["joint_friction"].name)
"""
OWN_EFFECT = """
import parastiff
bench = parastiff.open("bench", effects=["{file}"])
effect = bench.subject.known.effects["seal_spring"]
model = parastiff.Model((parastiff.Term(effect, effect.typicals),))
found = bench.with_model(model).compare().record.model_of("saved")
print(found.fit > 0.0, isinstance(effect, parastiff.Effect))
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    done = subprocess.run(build, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    (found,) = folder.glob("*.whl")
    return found


@pytest.fixture(scope="module")
def bench(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A user's folder with the example, and files whose names are those of packages of a checkout."""
    folder = tmp_path_factory.mktemp("user")
    zipfile.ZipFile(wheel).extractall(folder / "site")
    shutil.copytree(ROOT / "examples" / "bench", folder / "bench")
    shutil.copytree(ROOT / "tests" / "cases" / "data" / "c05_one_point", folder / "one")
    (folder / "fem.py").write_text("raise RuntimeError('the fem of the user')\n")
    (folder / "reports").mkdir()
    (folder / "reports" / "__init__.py").write_text("raise RuntimeError('the reports of the user')\n")
    return folder


def called(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Python in the user's folder, with what the wheel holds and nothing of the checkout."""
    # The checkout is installed beside the libraries that the wheel needs: it is taken away again.
    gone = (
        "import os, sys\nsys.path[:] = [p for p in sys.path if not os.path.isdir(os.path.join(p, 'vjm'))]\n"
    )
    (folder / "site" / "sitecustomize.py").write_text(gone)
    kept = {k: v for k, v in os.environ.items() if k != "PYTHONSAFEPATH"}
    # What is compiled is compiled again in every folder: twice as long as all else.
    kept["NUMBA_DISABLE_JIT"] = "1"
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        env={**kept, "PYTHONPATH": str(folder / "site"), "NO_COLOR": "1"},
        capture_output=True,
        text=True,
        timeout=300,
    )


def said(folder: Path, *arguments: str) -> str:
    done = called(folder, *arguments)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.strip()


def test_it_has_one_name_and_no_results_of_the_checkout(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    tops = {name.partition("/")[0] for name in names}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"parastiff"}
    assert wheel.stat().st_size < LARGEST
    assert {"parastiff/examples/bench/campaign.toml", "parastiff/py.typed"} <= set(names)
    assert "parastiff/pipeline/validation/cases/plain_i_bar.toml" in names
    assert not [name for name in names if "outcomes" in name or name.endswith((".png", ".vtu", ".html"))]


def test_its_command_does_what_that_of_the_checkout_does(bench: Path) -> None:
    shown = said(bench, "-m", "parastiff", "compare", "one")
    assert "next: parastiff diagnose one" in shown and "python -m pipeline" not in shown
    assert "z is 60 % more than the model says" in shown
    assert "joint_friction" in said(bench, "-m", "parastiff", "effects")
    assert "Usage: parastiff" in said(bench, "-m", "parastiff", "--help")


@pytest.mark.long
def test_processes_and_what_was_pickled_know_it_by_its_name(bench: Path) -> None:
    (bench / "spread.py").write_text(SPREAD)
    assert said(bench, "spread.py") == "True"
    assert said(bench, "-c", AGAIN) == "parastiff.pipeline.campaign.model joint_friction"


@pytest.mark.long
@pytest.mark.parametrize("spelling", ["parastiff", "checkout"])
def test_an_effect_of_ones_own_loads_in_either_spelling(bench: Path, spelling: str) -> None:
    face = spelling == "parastiff"
    module, laws = ("parastiff", "parastiff") if face else ("vjm.effects.base", "vjm")
    (bench / f"{spelling}_effect.py").write_text(OWN.format(module=module, laws=laws))
    done = called(bench, "-c", OWN_EFFECT.format(file=f"{spelling}_effect.py"))
    assert done.stdout.strip() == "True True", done.stderr
    assert ("imports from vjm, its name in a checkout" in done.stderr) is not face


def test_the_public_names_are_there_and_come_when_asked_for() -> None:
    code = "import sys, parastiff\nprint([n for n in ('numpy', 'pipeline', 'vjm') if n in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
    assert all(getattr(parastiff, name) is not None for name in parastiff.__all__)
    assert sorted(parastiff._PUBLIC) == parastiff.__all__
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        parastiff.nothing  # noqa: B018


def test_type_checkers_see_what_is_imported() -> None:
    """What stands there for them is what the table imports."""
    tree = ast.parse((ROOT / "parastiff" / "__init__.py").read_text(encoding="utf-8"))
    (block,) = [node for node in tree.body if isinstance(node, ast.If)]
    seen = {}
    for node in ast.walk(block):
        if isinstance(node, ast.ImportFrom):
            for alias in node.names:
                inside = (node.module, alias.name)
                whole = (f"{node.module}.{alias.name}", "")
                public = alias.asname or alias.name
                seen[public] = whole if parastiff._PUBLIC.get(public) == whole else inside
    assert seen == parastiff._PUBLIC


@pytest.mark.parametrize(
    ("line", "said"),
    [("import vjm.paper\n", "line 1: write `from ... import ...`"), ("x = 1; from vjm import paper\n", "")],
)
def test_what_cannot_be_renamed_is_refused(line: str, said: str) -> None:
    if said:
        with pytest.raises(ValueError, match=said):
            hatch_build.rewritten(line, set(), "a.py")
    else:
        assert hatch_build.rewritten(line, set(), "a.py") == "x = 1; from parastiff.vjm import paper\n"


def test_a_string_that_names_a_module_is_renamed_and_no_other() -> None:
    text = 'é, a, b = "ü", "vjm.paper", "vjm"  # from vjm\n'
    assert hatch_build.rewritten(text, {"vjm.paper"}, "a.py") == text.replace(
        '"vjm.paper"', '"parastiff.vjm.paper"'
    )
