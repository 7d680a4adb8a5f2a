"""What a result was made with: versions, commit, and a digest of the code for the cache."""

import hashlib
import platform
import subprocess
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = (
    "parastiff",
    "numpy",
    "scipy",
    "numba",
    "scikit-fem",
    "gmsh",
    "meshio",
    "pyvista",
    "pypardiso",
    "scikit-learn",
)


@cache
def versions() -> dict[str, str]:
    """Versions of Python and of the packages that make numbers; "not installed" where one is missing."""
    found = {"python": platform.python_version()}
    for name in PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = "not installed"
    return found


@cache
def commit() -> str:
    """The commit of the checkout, with "+" if files differ from it; "unknown" outside of one."""
    try:
        if Path(git("rev-parse", "--show-toplevel")).resolve() != ROOT:
            return "unknown"
        head = git("rev-parse", "--short=12", "HEAD")
        return head + ("+" if git("status", "--porcelain", "--", "*.py", "*.toml") else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def made_with() -> dict[str, Any]:
    """Commit and versions of a result, by the names of its fields."""
    return {"commit": commit(), "versions": versions()}


def git(*arguments: str) -> str:
    """Output of a git command in the checkout."""
    done = subprocess.run(["git", *arguments], cwd=ROOT, check=True, capture_output=True, text=True)
    return done.stdout.strip()


@cache
def code_digest() -> str:
    """Digest of the numerical code and the versions beneath: what was computed with other code is not reused."""
    digest = hashlib.sha256(repr(sorted(versions().items())).encode())
    for folder in ("meshes", "fem", "vjm", "pipeline"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            digest.update(path.relative_to(ROOT).as_posix().encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()
