"""`python -m pipeline`."""

import sys
import warnings
from typing import TextIO

from pipeline.memory import keep_freed
from pipeline.processors import available, may_use
from pipeline.threads import BLAS, one_thread
from pipeline.typed import program


def main() -> None:
    """The command line as it was typed."""
    warnings.showwarning = _remark
    one_thread((BLAS,))
    keep_freed()
    may_use(available())
    from pipeline.cli import app

    app(prog_name=program())


def _remark(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """A warning that is meant for the user is one sentence, without the place in the program where it is said."""
    said = warnings.formatwarning(message, category, filename, lineno, line)
    print(f"remark: {message}\n" if category is FutureWarning else said, end="", file=file or sys.stderr)


if __name__ == "__main__":
    main()
