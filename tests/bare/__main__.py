"""`make bare`: the README's two commands, and the wheel, on machines that hold nothing else; with seconds of each."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from tests.parastiff.installed import ROOT, taken_to

IN_A_ROOT = Path(__file__).parent / "root.sh"


def timed(root: Path, packages: str, command: str) -> int:
    """Exit code of a command in a root with these packages, its seconds printed."""
    start = perf_counter()
    code = subprocess.run([str(IN_A_ROOT), str(root), packages, "sh", "-c", command]).returncode
    print(f"{command}: exit {code}, {perf_counter() - start:.0f} s", flush=True)
    return code


def main() -> int:
    """The worst exit code."""
    with tempfile.TemporaryDirectory() as name:
        checkout, alone = Path(name, "checkout"), Path(name, "alone")
        codes = [timed(checkout, "git,make,python3,python3-venv", "true")]
        subprocess.run(
            ["git", "clone", "-q", "--no-hardlinks", ROOT, checkout / "root" / "parastiff"], check=True
        )
        codes += [timed(checkout, "", f"cd /root/parastiff && make {what}") for what in ("run", "test")]
        codes.append(timed(alone, "python3,python3-venv", "true"))
        (alone / "root" / "try").mkdir()
        taken_to(alone / "root" / "try")
        shutil.copy(ROOT / "tests" / "parastiff" / "installed.py", alone / "root" / "try")
        codes.append(timed(alone, "", "python3 /root/try/installed.py /root/try"))
        return max(map(abs, codes))


if __name__ == "__main__":
    sys.exit(main())
