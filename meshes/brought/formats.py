"""Which module of this folder reads which file: each has `SUFFIXES` and `work`; it is found by itself."""

import ast
from functools import cache
from pathlib import Path


@cache
def readers() -> dict[str, str]:
    """Modules by the endings that they read. They are not imported: some need libraries that only the child loads."""
    found: dict[str, str] = {}
    for path in sorted(Path(__file__).parent.glob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        names = {
            t.id: n.value
            for n in tree.body
            if isinstance(n, ast.Assign)
            for t in n.targets
            if isinstance(t, ast.Name)
        }
        if "SUFFIXES" in names and any(
            isinstance(n, ast.FunctionDef) and n.name == "work" for n in tree.body
        ):
            suffixes = ast.literal_eval(names["SUFFIXES"])
            found |= dict.fromkeys(suffixes, f"{__package__}.{path.stem}")
    return found


def module_of(path: Path) -> str:
    """The module that reads a file; ValueError with the endings there are."""
    suffix = path.suffix.lower()
    if suffix not in readers():
        raise ValueError(f"has the ending {suffix or 'none'}, allowed are {', '.join(readers())}")
    return readers()[suffix]
