"""Runs the fenced blocks of a page in order: Python in one namespace, commands in one folder, files by their caption.

python              is run; what it prints has to stand in a `text` block behind it
console             lines `$ parastiff ...` are run, and what stands below a line is compared with what it prints
toml with :caption: is written to that file
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from sybil import Document, Example, Region, Sybil

from tests.conftest import ROOT
from tests.docs.shown import difference

_FENCE = re.compile(
    r"^```(?:\{code-block\} *)?(?P<language>\w*)\n(?P<options>(?:^:\w+:[^\n]*\n)*)\n?(?P<body>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
PROGRAM = "import sys; sys.argv[0] = 'parastiff'; from pipeline.__main__ import main; main()"
PRINTED, FOLDER, SECONDS = "__printed__", "__folder__", 3600


@dataclass(frozen=True)
class Fence:
    """One fenced block. caption: "" where it has none."""

    language: str
    caption: str
    body: str


class NotAsShownError(AssertionError):
    """What came out differs from what the page shows."""


def fences(document: Document) -> Iterator[Region]:
    """A region for each fenced block. ValueError for a language that nothing runs."""
    for found in _FENCE.finditer(document.text):
        caption = re.search(r"^:caption: (.+)$", found["options"], re.MULTILINE)
        fence = Fence(found["language"], caption[1] if caption else "", found["body"])
        if fence.language not in RUN:
            raise ValueError(f"{document.path}: a block of {fence.language!r}, allowed are {', '.join(RUN)}")
        yield Region(found.start(), found.end(), fence, _run)


def run(page: Path, folder: Path) -> int:
    """Run every block of a page in a folder; how many there are. NotAsShownError for the first that differs."""
    document = Sybil(parsers=[fences]).parse(page)
    document.namespace[FOLDER] = folder
    examples = list(document.examples())
    with contextlib.chdir(folder):
        for example in examples:
            example.evaluate()
    _nothing_unshown(document.namespace)
    return len(examples)


def _run(example: Example) -> None:
    fence: Fence = example.parsed
    try:
        RUN[fence.language](fence, example)
    except NotAsShownError as error:
        raise NotAsShownError(f"{example.path}:{example.line}: {error}") from None


def _python(fence: Fence, example: Example) -> None:
    _nothing_unshown(example.namespace)
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile("\n" * example.line + fence.body, example.path, "exec"), example.namespace)
    example.namespace[PRINTED] = out.getvalue()


def _text(fence: Fence, example: Example) -> None:
    printed = example.namespace.pop(PRINTED, None)
    if printed is None:
        raise NotAsShownError("a text block stands behind no Python block")
    _same(fence.body, printed)


def _console(fence: Fence, example: Example) -> None:
    _nothing_unshown(example.namespace)
    first, *commands = re.split(r"^\$ ", fence.body, flags=re.MULTILINE)
    if first.strip() or not commands:
        raise NotAsShownError("a console block begins with a line `$ parastiff ...`")
    for each in commands:
        line, _, shown = each.partition("\n")
        printed = _called(line, example.namespace[FOLDER])
        if shown.strip():
            _same(shown, printed)


def _called(line: str, folder: Path) -> str:
    program, *arguments = shlex.split(line)
    if program != "parastiff":
        raise NotAsShownError(f"{program} is no command of a tutorial, allowed is parastiff")
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=SECONDS,
    )
    if done.returncode:
        raise NotAsShownError(f"{line}\nends with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def _file(fence: Fence, example: Example) -> None:
    _nothing_unshown(example.namespace)
    if not fence.caption:
        raise NotAsShownError("a toml block has no :caption: with its file")
    path = example.namespace[FOLDER] / fence.caption
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(fence.body, encoding="utf-8")


def _same(shown: str, printed: str) -> None:
    if said := difference(shown, printed):
        raise NotAsShownError(f"{said}\n--- shown\n{shown}\n--- came out\n{printed}")


def _nothing_unshown(namespace: dict[str, object]) -> None:
    """What a Python block prints and no text block shows is forgotten, or was meant to be shown."""
    printed = namespace.pop(PRINTED, None)
    if printed:
        raise NotAsShownError(f"is printed and not shown:\n{printed}")


RUN = {"python": _python, "text": _text, "console": _console, "toml": _file}
