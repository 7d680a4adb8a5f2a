"""The command line: wiring only. Exit codes: 0 done, 2 bad input, 3 the numerics failed, 130 interrupted."""

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from pipeline.bar.wiring import register as register_bar
from pipeline.discover.wiring import register as register_discover
from pipeline.errors import InputError
from pipeline.export.wiring import register as register_export
from pipeline.log import log_to
from pipeline.options import CampaignFolder, EffectsFrom, Json, LogFile, ModelFile
from pipeline.predict.wiring import register as register_predict
from pipeline.system import missing_libraries, wanted
from pipeline.terminal import complain
from pipeline.typed import typed

app = typer.Typer(
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

ManipulatorFile = Annotated[
    str, typer.Argument(metavar="FILE", help="A manipulator as .toml, or the name of a shipped one.")
]


def give_up(message: str, code: int) -> NoReturn:
    """Print one sentence and end."""
    complain(f"error: {message}")
    raise typer.Exit(code)


@app.callback()
def main(log: LogFile = None) -> None:
    """Stiffness of parallelogram linkages: virtual springs, finite elements, and where they disagree."""
    if log is not None:
        guarded(lambda: log_to(log))


@app.command()
def run(
    case: CaseName = "orthoglide",
    coarse: Annotated[
        bool, typer.Option("--coarse", help="Coarse meshes: a look in a minute or two.")
    ] = False,
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
    path: Annotated[
        Path, typer.Argument(metavar="PATH", help="A campaign's folder, or one with a saved result.")
    ],
    out: Annotated[
        Path | None, typer.Option(help="Folder of a campaign's report; default results/FOLDER.")
    ] = None,
    model: ModelFile = None,
    effects_from: EffectsFrom = None,
    look: Annotated[
        bool, typer.Option("--diagnose", help="Look for what the model lacks first; a minute or two.")
    ] = False,
    answer: Annotated[Path | None, typer.Option(help="Saved answer of diagnose, to be shown.")] = None,
    quiet: Quiet = False,
) -> None:
    """The report of a campaign, or of saved results again without solving: HTML, Markdown and pictures."""
    from pipeline.page.command import report_of

    if look and answer is not None:
        give_up("--diagnose and --answer are both given, allowed is one of the two", 2)
    guarded(lambda: report_of(path, out, model, effects_from or [], look, answer, quiet))


@app.command()
def studio(
    campaign: Annotated[
        Path | None, typer.Argument(metavar="CAMPAIGN", help="A campaign's folder; or choose it on the page.")
    ] = None,
    port: Annotated[int, typer.Option(min=0, max=65535, help="0: any that is free.")] = 0,
    browser: Annotated[bool, typer.Option(help="Open it in the browser.")] = True,
    effects_from: EffectsFrom = None,
) -> None:
    """A page on this machine where the same is done by clicking."""
    from pipeline.studio.command import studio

    guarded(lambda: studio(campaign, port, browser, effects_from or []))


@app.command()
def compare(
    campaign: CampaignFolder,
    model: ModelFile = None,
    effects_from: EffectsFrom = None,
    json: Json = None,
    out: Annotated[Path | None, typer.Option(help="Folder for comparison.json.")] = None,
    full: Annotated[bool, typer.Option("--full", help="Every test and channel, however many.")] = False,
    quiet: Quiet = False,
) -> None:
    """Models against measurements: error by test and channel, and how the model fails."""
    from pipeline.compare.command import compare

    guarded(lambda: compare(campaign, model, json, out, quiet, effects_from or [], full))


@app.command()
def init(
    out: Annotated[
        Path, typer.Argument(metavar="OUT", help="Folder for the campaign; it must not have one.")
    ],
    file: Annotated[
        Path | None, typer.Argument(metavar="FILE", help="Readings: a text, a workbook, TDMS.")
    ] = None,
    kind: Annotated[str, typer.Option(help="Of the rig: bar, parallelogram, manipulator.")] = "bar",
    known: Annotated[
        str | None, typer.Option("--from", metavar="BAR", help="A case, result.json or bar.json: its bar.")
    ] = None,
) -> None:
    """A campaign to fill in, commented; what a file of readings says by itself is filled in already."""
    from pipeline.init.command import init

    guarded(lambda: init(out, file, kind, known))


@app.command()
def check(campaign: CampaignFolder) -> None:
    """What a campaign's files say, as they are read; every complaint about them, with its line."""
    from pipeline.check import check

    guarded(lambda: check(campaign))


@app.command()
def demo(
    out: Annotated[
        Path, typer.Argument(metavar="OUT", help="Folder for the copy; it must not be there.")
    ] = Path("parastiff-demo"),
    quiet: Quiet = False,
) -> None:
    """The shipped campaign, copied: compare it, find what is missing, add it, compare again."""
    from pipeline.demo import demo

    guarded(lambda: demo(out, quiet))


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
    manipulator: Annotated[
        str | None, typer.Option(metavar="FILE", help="A whole manipulator; default a parallelogram.")
    ] = None,
    known: Annotated[
        Path | None,
        typer.Option("--from", metavar="CAMPAIGN|RESULT", help="Whose rig it is; default the paper's."),
    ] = None,
    quiet: Quiet = False,
) -> None:
    """A virtual bench: finite elements with hidden effects and noise write a campaign; the answer is sealed."""
    from pipeline.simulate import simulate
    from pipeline.simulate_manipulator import simulate_manipulator

    if manipulator is not None and known is not None:
        give_up("--manipulator and --from are both given, allowed is one of the two", 2)
    if manipulator is None:
        guarded(lambda: simulate(out, effect or [], seed, quiet, known))
    else:
        guarded(lambda: simulate_manipulator(out, manipulator, effect or [], seed, quiet))


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
    force: Annotated[bool, typer.Option("--force", help="Save a model that is no better as well.")] = False,
) -> None:
    """Add effects to the campaign's model, fit it, show how the error falls, save the model with the campaign."""
    from pipeline.add.command import add_effects

    guarded(lambda: add_effects(campaign, effects, model, effects_from or [], json, out, seed, quiet, force))


@app.command()
def remove(
    campaign: CampaignFolder,
    effects: Annotated[list[str], typer.Argument(metavar="EFFECT...", help="Names of the model's effects.")],
    model: ModelFile = None,
    effects_from: EffectsFrom = None,
    json: Json = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Only the verdict and the parameters.")] = False,
) -> None:
    """Take effects out of the campaign's model, fit the rest again, save the model: an undo of add or improve."""
    from pipeline.add.command import remove_effects

    guarded(lambda: remove_effects(campaign, effects, model, effects_from or [], json, quiet))


@app.command()
def improve(
    campaign: CampaignFolder,
    model: ModelFile = None,
    effects_from: EffectsFrom = None,
    json: Json = None,
    out: Annotated[
        Path | None, typer.Option(help="Folder for answer.json and the model of every step.")
    ] = None,
    seed: Annotated[int | None, typer.Option(help="Kept with the answer; nothing here is random.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Only the verdict and the parameters.")] = False,
) -> None:
    """Diagnose and add until the error is noise or nothing known helps; only what is certain is added."""
    from pipeline.improve.command import improve_campaign

    guarded(lambda: improve_campaign(campaign, model, effects_from or [], json, out, seed, quiet))


@app.command()
def plan(
    campaign: CampaignFolder,
    model: ModelFile = None,
    effects_from: EffectsFrom = None,
    json: Json = None,
    full: Annotated[bool, typer.Option("--full", help="Every parameter and pair, however many.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="Only the next test.")] = False,
) -> None:
    """Which effects these tests can show and tell apart, measured or not yet, and the next test worth doing."""
    from pipeline.plan.command import plan_campaign

    guarded(lambda: plan_campaign(campaign, model, effects_from or [], json, quiet, full))


@app.command()
def challenge(
    cases: Annotated[int, typer.Option(min=1, help="Campaigns, from the first one on.")] = 600,
    workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
    out: Annotated[Path, typer.Option(help="Folder of the score.")] = Path("reports/challenge"),
    store: Annotated[Path, typer.Option(help="Where finished campaigns are kept.")] = Path(
        "reports/challenge/outcomes.jsonl"
    ),
    dirty: Annotated[
        bool,
        typer.Option("--dirty", help="Benches as they are: bar, gains and noise beside what is written."),
    ] = False,
    quiet: Quiet = False,
) -> None:
    """The score of the diagnosis over many virtual benches with hidden effects; stopped, it can go on."""
    from pipeline.assessment.challenge.command import run_challenge, run_dirty

    if dirty:
        own = store.with_name(f"dirty_{store.name}")
        guarded(lambda: run_dirty(cases, workers, out, own, quiet))
    else:
        guarded(lambda: run_challenge(cases, workers, out, store, quiet))


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


@app.command()
def table(
    manipulator: ManipulatorFile = "orthoglide",
    json: Json = None,
    out: Annotated[Path | None, typer.Option(help="Folder for table_1.json and table_1.md.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Only the cells.")] = False,
) -> None:
    """Table 1 of the paper by virtual springs and finite elements of the whole manipulator."""
    from pipeline.manipulator.table_command import table

    guarded(lambda: table(manipulator, json, out, quiet))


@app.command()
def sweep(
    out: Annotated[
        Path, typer.Option(help="Folder of the map; that of an interrupted sweep is gone on with.")
    ],
    manipulator: ManipulatorFile = "orthoglide",
    points: Annotated[str, typer.Option(metavar="N|NX,NY,NZ", help="Points along each axis.")] = "21",
    low: Annotated[
        str | None, typer.Option(metavar="X,Y,Z", help="Low corner, mm; default a cube about home.")
    ] = None,
    high: Annotated[str | None, typer.Option(metavar="X,Y,Z", help="High corner, mm.")] = None,
    workers: Annotated[int, typer.Option(help="Processes.")] = 1,
    dask: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Scheduler of a dask cluster, or local.")
    ] = None,
    wrench: Annotated[
        str | None,
        typer.Option(metavar="FX,FY,FZ[,MX,MY,MZ]", help="N, N·mm: also the loaded state, its stiffness."),
    ] = None,
    effect: Annotated[
        list[str] | None,
        typer.Option("--effect", metavar="NAME[.PARAMETER][=VALUE]", help="Also its error; repeatable."),
    ] = None,
    rise: Annotated[
        float | None, typer.Option(help="Temperature above the reference, K, where an effect needs it.")
    ] = None,
    effects_from: EffectsFrom = None,
    chunk: Annotated[int, typer.Option(help="Points that are computed and kept together.")] = 2000,
    pictures: Annotated[bool, typer.Option(help="Draw slices and an isosurface.")] = True,
    quiet: Quiet = False,
) -> None:
    """Stiffness and critical load of a manipulator over a grid of postures; interrupt and resume as you like."""
    from pipeline.threads import one_thread

    one_thread()
    from pipeline.manipulator.sweep_command import Asked, run_sweep

    asked = Asked(manipulator, out, low, high, points, workers, dask, chunk, quiet)
    asked = replace(asked, effects=effect or (), effects_from=effects_from or (), wrench=wrench, rise=rise)
    guarded(lambda: run_sweep(replace(asked, pictures=pictures)))


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
    except ImportError as error:
        try:
            wanted(error.name or "")
        except InputError as said_better:
            give_up(str(said_better), 2)
        give_up(missing_libraries() or str(error), 2)
    except (RuntimeError, ArithmeticError, ValueError, OSError) as error:
        # gmsh without a library of the system is an OSError.
        if type(error) is OSError and (said := missing_libraries()):
            give_up(said, 2)
        give_up(f"{type(error).__name__}: {error}" if isinstance(error, ValueError) else str(error), 3)
    except KeyboardInterrupt:
        give_up("interrupted; what was finished is kept and will be reused", 130)


register_bar(app, guarded)
register_discover(app, guarded)
register_export(app, guarded)
register_predict(app, guarded)
