"""`make wheel`: the wheel in an environment of its own, with no extra, and what a new user does first; with seconds.

With a folder as argument: the wheel, constraints.txt and measurements.xlsx are taken from there, as on a machine
without this checkout (`make bare`). Nothing but Python's own library is needed.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
import venv
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

ROOT = Path(__file__).resolve().parents[2]
LARGEST_MB, HELP_S, IMPORT_S = 700.0, 0.3, 0.1
TABLE = Path("tests", "cases", "data", "c11", "xlsx", "measurements.xlsx")
ANSWERS = {
    r'length_mm = "\?"': "length_mm = 300.0",
    r"bar = \{.*\}": 'section = { kind = "rectangle", width_mm = 30.0, height_mm = 9.49 }\n'
    "material = { E_MPa = 7e4, nu = 0.33 }",
    r'"Dial" = \{ is = "\?", sign = "\?" \}': '"Dial" = { is = "z" }',
    r'"Weight" = \{ is = "\?", sign = "\?" \}': '"Weight" = { is = "fz" }',
    r"# z_mm = 0.001": "z_mm = 0.0127",
    r"# fz_N = 0.5": "fz_N = 0.05",
}


def run(*command: object, cwd: Path) -> str:
    """Standard output. SystemExit, with what was said, where the command fails."""
    done = subprocess.run([str(word) for word in command], cwd=cwd, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(
            f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
        )
    return done.stdout


def timed(what: str, work: Callable[[], object]) -> float:
    """Seconds, printed."""
    start = perf_counter()
    work()
    taken = perf_counter() - start
    print(f"{what:44s} {taken:8.2f} s", flush=True)
    return taken


def quickest(*command: object, cwd: Path) -> float:
    """Seconds of the best of five: the first one reads the disk."""
    times = []
    for _ in range(5):
        start = perf_counter()
        run(*command, cwd=cwd)
        times.append(perf_counter() - start)
    return min(times)


def answered(folder: Path) -> None:
    """The questions of `init` answered as for the cantilever of the table."""
    path = folder / "campaign.toml"
    text = path.read_text(encoding="utf-8")
    for question, answer in ANSWERS.items():
        text, count = re.subn(question, answer.replace("\\", r"\\"), text)
        if count != 1:
            raise SystemExit(f"{path}: {question} is there {count} times")
    path.write_text(text, encoding="utf-8")


def taken_to(folder: Path) -> None:
    """The wheel, built here, and what its use needs, into a folder."""
    build = (sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder)
    timed("build", lambda: run(*build, cwd=ROOT))
    for file in (ROOT / "constraints.txt", ROOT / TABLE):
        shutil.copy(file, folder)


def main(given: list[str]) -> None:
    """Install, use."""
    with tempfile.TemporaryDirectory() as name:
        here = Path(name)
        if given:
            shutil.copytree(given[0], here, dirs_exist_ok=True)
        else:
            taken_to(here)
        (wheel,) = here.glob("*.whl")
        print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.2f} MB")
        own = here / "own"
        venv.create(own, with_pip=True)
        python, parastiff = own / "bin" / "python", own / "bin" / "parastiff"
        pip = (python, "-m", "pip", "install", "--quiet", "--constraint", here / "constraints.txt", wheel)
        timed("pip install, no extra", lambda: run(*pip, cwd=here))
        size = sum(path.lstat().st_size for path in own.rglob("*")) / 1e6
        print(f"installed: {size:.0f} MB")
        bare = quickest(python, "-c", "pass", cwd=here)
        help_s = quickest(parastiff, "--help", cwd=here)
        import_s = quickest(python, "-c", "import parastiff", cwd=here) - bare
        print(f"parastiff --help {help_s:.2f} s, import parastiff {import_s:.3f} s")
        timed("parastiff demo", lambda: run(parastiff, "demo", "demo", "--quiet", cwd=here))
        timed(
            "parastiff init bench readings.xlsx",
            lambda: run(parastiff, "init", "bench", TABLE.name, cwd=here),
        )
        answered(here / "bench")
        timed("parastiff check bench", lambda: run(parastiff, "check", "bench", cwd=here))
        timed(
            "parastiff diagnose bench",
            lambda: print(run(parastiff, "diagnose", "bench", "--quiet", cwd=here)[:300]),
        )
        refused = subprocess.run([str(parastiff), "run"], cwd=here, capture_output=True, text=True)
        print(f"parastiff run, without its extra: exit {refused.returncode}, {refused.stderr.strip()[:300]}")
        kept = size < LARGEST_MB and help_s < HELP_S and import_s < IMPORT_S and refused.returncode == 2
        raise SystemExit(0 if kept and "parastiff[solid]" in refused.stderr else 1)


if __name__ == "__main__":
    main(sys.argv[1:])
