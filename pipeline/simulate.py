"""The command simulate: a virtual bench writes a campaign, and the answer goes to a sealed file beside it."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshes.files import replacing
from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.hidden import hidden
from pipeline.assessment.virtual.known_rig import rig_of
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, PlannedTest, bench_plan
from pipeline.campaign import Campaign, ParallelogramRig, write
from pipeline.campaign.reading import DESCRIPTION, MEASUREMENTS
from pipeline.command import usable
from pipeline.errors import InputError
from pipeline.parameter_names import path_of
from pipeline.progress import Progress
from pipeline.provenance import commit, versions
from vjm import paper
from vjm.effects import catalogue

LENGTH, WIDTH = 310.0, 80.0
FIBRE_Y, FIBRE_Z = 6.0, 7.75
"""mm: outermost fibres of the plain I-bar, flange 12 wide and 15.5 high, that is nearly the paper's."""
REFERENCE_C = 20.0


def simulate(
    out: Path, effects: Sequence[str], seed: int, quiet: bool = False, known: Path | None = None
) -> Campaign:
    """Measure the bench plan on frame finite elements with hidden effects, and write it to a folder.

    known: a campaign or a result whose parallelogram is on the bench instead of the paper's, loads and travels by its
    size, and by how much what is written of it may be off.
    The answer is in `sealed(out)`; what is printed says where it is, not what. InputError for effects that cannot
    be had and for a folder with a campaign; RuntimeError where the bench itself finds no equilibrium.
    """
    require_free(out)
    with Progress(quiet).stage("simulate"):
        campaign, answer = virtual(re.sub(r"\s+", " ", out.resolve().name), effects, seed, known)
    seal(out, campaign, answer)
    return campaign


def virtual(
    name: str, effects: Sequence[str], seed: int, known: Path | None = None
) -> tuple[Campaign, dict[str, object]]:
    """The bench plan measured on frame finite elements with hidden effects, and the answer.

    known: as of `simulate`. InputError for effects that cannot be had; RuntimeError where the bench itself finds no
    equilibrium.
    """
    rig, tolerance = (bench_rig(), {}) if known is None else _known(known)
    plan = bench_plan() if known is None else scaled(bench_plan(), rig)
    # Sizes and noise are drawn apart, so that the same seed gives the same noise whatever is hidden.
    sizes, noise = (np.random.default_rng(s) for s in np.random.SeedSequence(seed).spawn(2))
    values = hidden(effects, catalogue(), rig, sizes)
    paths = {path_of(name, p): value for name, own in values.items() for p, value in own.items()}
    campaign = measure(name, rig, plan, SENSORS, paths, int(noise.integers(2**63)), GAUGES)
    return replace(campaign, tolerance=tolerance), {
        "effects": list(values),
        "parameters": paths,
        "seed": seed,
        "rig": "parallelogram of the paper's Eq. 12" if known is None else str(known),
        "truth": "geometrically exact frame finite elements: bar_geometric_nonlinearity is always there",
    }


def _known(source: Path) -> tuple[ParallelogramRig, dict[str, float]]:
    """The rig of a campaign or a result, on a bench with thermometer and gravity, and its tolerances."""
    rig = rig_of(source)
    bench = replace(
        rig,
        gravity=rig.gravity or (0.0, 0.0, -1.0),
        reference_temperature=REFERENCE_C if rig.reference_temperature is None else rig.reference_temperature,
    )
    return bench, rig.usual_tolerance


def scaled(plan: Sequence[PlannedTest], rig: ParallelogramRig, share: float = 1.0) -> tuple[PlannedTest, ...]:
    """The plan of the paper's bench for another rig: loads by Euler's load, travels by the length, times a share."""
    base = bench_rig()
    by_load = _euler(rig) / _euler(base)
    by_length = rig.length / LENGTH
    by_width = rig.width / WIDTH
    # Of the coordinates, as forces along x and about y, and as travels along and about the others.
    factors = share * np.array([by_load, by_length, by_length, 1.0, by_load * by_width, 1.0])
    return tuple(replace(test, values=test.values * factors) for test in plan)


def _euler(rig: ParallelogramRig) -> float:
    return float(rig.stiffness[1, 1]) * rig.length


def seal(out: Path, campaign: Campaign, answer: Mapping[str, object]) -> None:
    """Write the campaign, its answer beside it with what made it, and say where both are."""
    write_sealed(out, campaign, answer)
    rows = sum(test.data.steps.size for test in campaign.tests)
    print(f"{out}: {len(campaign.tests)} tests, {rows} load steps; the answer is sealed in {sealed(out)}")


def write_sealed(out: Path, campaign: Campaign, answer: Mapping[str, object]) -> None:
    """Write the campaign, and its answer beside it with what made it."""
    write(out, campaign)
    whole = {"campaign": campaign.name, **answer, "versions": versions(), "commit": commit()}
    with replacing(sealed(out)) as part:
        part.write_text(json.dumps(whole, indent=1) + "\n", encoding="utf-8")


def bench_rig() -> ParallelogramRig:
    """The parallelogram of the paper's K_b (Eq. 12), with what thermometer and yield need to know."""
    return ParallelogramRig(
        length=LENGTH,
        width=WIDTH,
        bar_stiffness=paper.BAR_STIFFNESS,
        gravity=(0.0, 0.0, -1.0),
        reference_temperature=REFERENCE_C,
        fibre_y=FIBRE_Y,
        fibre_z=FIBRE_Z,
    )


def sealed(out: Path) -> Path:
    """Where the answer to a simulated campaign is."""
    return out.parent / f"{out.name}.sealed.json"


def require_free(out: Path) -> None:
    """InputError if there is a campaign already, its answer, or no way to write."""
    for path in (out / DESCRIPTION, out / MEASUREMENTS, sealed(out)):
        if path.exists():
            raise InputError(f"{path} exists, allowed is a folder without a campaign or its answer")
    if not out.name:
        raise InputError(f"{out} has no name of its own, allowed is the path of a new folder")
    usable(out, str(out))
