"""The command line: wiring only. Exit codes: 0 done, 2 bad input, 3 the numerics failed, 130 interrupted."""

import shlex
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from pipeline.errors import InputError

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    help="Stiffness of parallelogram linkages: virtual springs, finite elements, and where they disagree.",
)

CaseName = Annotated[str, typer.Argument(metavar="CASE", help="A shipped case, or the path of a .toml file.")]
Out = Annotated[
    Path | None,
    typer.Option(help="Folder of the result; default reports/validation, or results/CASE-DETAIL."),
]
Quiet = Annotated[bool, typer.Option("--quiet", help="No progress.")]


def give_up(message: str, code: int) -> NoReturn:
    """Print one sentence and end."""
    print(f"error: {message}", file=sys.stderr)
    raise typer.Exit(code)


@app.callback()
def main() -> None:
    """Stiffness of parallelogram linkages: virtual springs, finite elements, and where they disagree."""


@app.command()
def run(
    case: CaseName = "orthoglide",
    coarse: Annotated[bool, typer.Option("--coarse", help="Coarse meshes: a look in seconds.")] = False,
    fine: Annotated[bool, typer.Option("--fine", help="Fine meshes: the last digit, in minutes.")] = False,
    out: Out = None,
    quiet: Quiet = False,
) -> None:
    """Mesh, K_b, buckling, VJM, FEA, LIN, comparison and report of a case."""
    from pipeline.command import validate

    if coarse and fine:
        give_up("--coarse and --fine are both given, allowed is one of the two", 2)
    guarded(lambda: validate(case, coarse, fine, out, quiet, typed()))


@app.command()
def report(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder with a result.json.")],
    quiet: Quiet = False,
) -> None:
    """Draw the report of saved results again, without solving."""
    from pipeline.command import redraw

    guarded(lambda: redraw(folder, quiet))


def typed() -> str:
    """The command line that was given."""
    return shlex.join(["python", "-m", "pipeline", *sys.argv[1:]])


def guarded(work: Callable[[], None]) -> None:
    """Run, and turn what went wrong into one sentence and an exit code."""
    try:
        work()
    except InputError as error:
        give_up(str(error), 2)
    except BrokenPipeError:
        # Whoever read the output has left: not a failure of the run.
        sys.stdout = None
    except MemoryError:
        give_up("the memory of this machine is not enough; allowed is a larger mesh size, or --coarse", 3)
    except (RuntimeError, ArithmeticError, ValueError, OSError) as error:
        give_up(f"{type(error).__name__}: {error}" if isinstance(error, ValueError) else str(error), 3)
    except KeyboardInterrupt:
        give_up("interrupted; what was finished is kept and will be reused", 130)
