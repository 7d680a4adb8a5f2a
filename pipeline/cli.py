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

CampaignFolder = Annotated[
    Path, typer.Argument(metavar="CAMPAIGN", help="Folder with campaign.toml and measurements.csv.")
]
ModelFile = Annotated[
    Path | None, typer.Option("--model", help="Saved model; default model.toml of the campaign, if there.")
]
EffectsFrom = Annotated[
    list[Path] | None,
    typer.Option("--effects-from", help="Python file with an effect of your own; repeatable."),
]
Json = Annotated[Path | None, typer.Option("--json", help="File for the whole result.")]


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


@app.command()
def compare(
    campaign: CampaignFolder,
    model: ModelFile = None,
    effects_from: EffectsFrom = None,
    json: Json = None,
    out: Annotated[Path | None, typer.Option(help="Folder for comparison.json.")] = None,
    quiet: Quiet = False,
) -> None:
    """Models against measurements: error by test and channel, and how the model fails."""
    from pipeline.compare.command import compare

    guarded(lambda: compare(campaign, model, json, out, quiet, effects_from or []))


@app.command()
def effects(
    name: Annotated[str | None, typer.Argument(metavar="NAME", help="An effect; without it, all.")] = None,
    effects_from: EffectsFrom = None,
) -> None:
    """The catalogue of physical effects, or one of them: equation, parameters, what it looks like."""
    from pipeline.effects_page import effects

    guarded(lambda: effects(name, effects_from or []))


@app.command()
def simulate(
    out: Annotated[
        Path, typer.Argument(metavar="OUT", help="Folder for the campaign; it must not have one.")
    ],
    effect: Annotated[
        list[str] | None,
        typer.Option("--effect", metavar="NAME[.PARAMETER][=VALUE]", help="What is hidden; repeatable."),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the noise, and of sizes that are not given.")] = 0,
    quiet: Quiet = False,
) -> None:
    """A virtual bench: finite elements with hidden effects and noise write a campaign; the answer is sealed."""
    from pipeline.simulate import simulate

    guarded(lambda: simulate(out, effect or [], seed, quiet))


@app.command()
def add(
    campaign: CampaignFolder,
    effects: Annotated[list[str], typer.Argument(metavar="EFFECT...", help="Names as in the catalogue.")],
    model: ModelFile = None,
    effects_from: EffectsFrom = None,
    json: Json = None,
    out: Annotated[Path | None, typer.Option(help="Folder for answer.json.")] = None,
    seed: Annotated[int | None, typer.Option(help="Kept with the answer; nothing here is random.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Only the verdict and the parameters.")] = False,
) -> None:
    """Add effects to the campaign's model, fit it, show how the error falls, save the model with the campaign."""
    from pipeline.add.command import add_effects

    guarded(lambda: add_effects(campaign, effects, model, effects_from or [], json, out, seed, quiet))


@app.command()
def diagnose(
    campaign: CampaignFolder,
    model: ModelFile = None,
    effects_from: EffectsFrom = None,
    json: Json = None,
    out: Annotated[Path | None, typer.Option(help="Folder for answer.json.")] = None,
    seed: Annotated[int | None, typer.Option(help="Kept with the answer; nothing here is random.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Only the verdict.")] = False,
) -> None:
    """Which physical effect the model lacks: one name, several, or none, and which test would tell."""
    from pipeline.diagnose.command import diagnose_campaign

    guarded(lambda: diagnose_campaign(campaign, model, effects_from or [], json, out, seed, quiet))


def typed() -> str:
    """The command line that was given."""
    return shlex.join(["python", "-m", "pipeline", *sys.argv[1:]])


def guarded(work: Callable[[], object]) -> None:
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
