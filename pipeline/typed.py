"""How the program was called: commands that it proposes are those that work where it is installed."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path

NAME = "parastiff"
INSTALLED = __name__.partition(".")[0] == NAME
"""Whether this is no checkout: installed from a wheel, everything is under one name."""


def program() -> str:
    """`parastiff` where that was typed, or where there is nothing else; `python -m pipeline` in a checkout."""
    name = Path(sys.argv[0]).name if sys.argv else ""
    return NAME if INSTALLED or name.startswith(NAME) else "python -m pipeline"


def command(*words: object) -> str:
    """A command of this program to copy; what is a path is quoted where the shell needs that."""
    return " ".join([program(), *(shlex.quote(str(word)) for word in words)])


def typed() -> str:
    """The command line that was given."""
    return command(*sys.argv[1:])
