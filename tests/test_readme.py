"""The README is run: its Python example, its commands, and every number of its table."""

import re
import subprocess
import sys
from collections.abc import Callable

import pytest

from pipeline.validation.result import Result
from tests.conftest import ROOT, Done

README = (ROOT / "README.md").read_text(encoding="utf-8")
KEPT = ROOT / "reports" / "validation"


def blocks(language: str) -> list[str]:
    """Code blocks of a language."""
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


def number(row: str) -> float:
    """The answer that stands in a row of the table, kN in N and per cent as a share."""
    found = re.search(rf"\| {re.escape(row)}[^|]*\| ([\d.]+) (kN|%) \|", README)
    assert found, f"no row {row!r} with a number"
    return float(found[1]) * {"kN": 1e3, "%": 1e-2}[found[2]]


@pytest.fixture(scope="module")
def kept() -> Result:
    return Result.model_validate_json((KEPT / "result.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    ("script", "begins"), [("identified_bar.py", "[["), ("loaded_parallelogram.py", "converged")]
)
def test_examples_run(script: str, begins: str) -> None:
    done = subprocess.run(
        [sys.executable, str(ROOT / "examples" / script)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(begins)


def test_commands_exist(command_here: Callable[..., Done]) -> None:
    makefile = (ROOT / "Makefile").read_text()
    shell = "\n".join(blocks("sh"))
    for target in re.findall(r"^make (\w+)", shell, re.MULTILINE):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target
    for command, option in re.findall(r"-m pipeline (\w+)[^\n#]*?(--\w+)?", shell):
        done = command_here(command, "--help", cwd=ROOT)
        assert done.code == 0 and option in done.out, command


def test_links_lead_somewhere() -> None:
    for target in re.findall(r"\]\(([^)]+)\)", README):
        assert (ROOT / target).exists(), target
    assert len(README.splitlines()) <= 120


def test_numbers_are_those_of_the_kept_report(kept: Result) -> None:
    bar = kept.bar
    assert number("solid bar against") == pytest.approx(bar.worst_entry_error, abs=5e-4)
    second = max(abs(e.deviation) for e in bar.second_route.entries)
    assert number("K_b by rigid tie") == pytest.approx(second, abs=5e-4)
    solid = [b for b in kept.buckling if b.model == "solid"]
    assert len(solid) == 24
    assert number("24 buckling modes") == pytest.approx(max(abs(b.deviation or 0.0) for b in solid), abs=5e-4)
    assert max(p.worst_fea_deviation for p in kept.parallelogram) < number("closed form K_p")


def test_critical_loads_are_those_of_the_kept_report(kept: Result) -> None:
    held = {"platform fully held": 5, "platform free along y": 4}
    rows = [c for c in kept.critical if c.q_deg == 0.0]
    for row, count in (
        ("lowest critical load, platform fully held", 5),
        ("the same, platform free along y", 4),
    ):
        solid = [c.load_N for c in rows if c.model == "solid" and len(c.held) == count and c.load_N]
        assert number(row) == pytest.approx(min(solid), rel=2e-3), held
    for row, place in (("virtual springs at the base", "base"), ("virtual springs in the middle", "middle")):
        (load,) = [c.load_N for c in rows if c.spring_at == place and len(c.held) == 4]
        assert number(row) == pytest.approx(load, rel=5e-3)
    shared = [c.ratio_to_solid or 0.0 for c in kept.critical if c.spring_at == "distributed"]
    assert len(shared) == 6
    assert number("virtual springs distributed") == pytest.approx(max(abs(r - 1.0) for r in shared), abs=5e-4)
    (tip,) = [c for c in rows if c.spring_at == "tip" and len(c.held) == 4 and "compression" in c.what]
    assert tip.load_N is None and "compression | none |" in README
