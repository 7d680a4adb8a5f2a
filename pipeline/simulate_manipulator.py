"""The command simulate on a whole manipulator: frame elements write a campaign, and the answer is sealed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pipeline.assessment.virtual.hidden import hidden
from pipeline.assessment.virtual.manipulator import measure_manipulator, plan
from pipeline.campaign import Campaign, ManipulatorRig
from pipeline.manipulator.description import SHIPPED, read
from pipeline.parameter_names import path_of
from pipeline.progress import Progress
from pipeline.simulate import require_free, seal
from vjm.effects import catalogue


def simulate_manipulator(
    out: Path, file: str, effects: Sequence[str], seed: int, quiet: bool = False
) -> Campaign:
    """As `pipeline.simulate.simulate`, on a manipulator: a shipped one, or a file that is not moved afterwards."""
    require_free(out)
    with Progress(quiet).stage("simulate"):
        campaign, answer = virtual_manipulator(re.sub(r"\s+", " ", out.resolve().name), file, effects, seed)
    seal(out, campaign, answer)
    return campaign


def virtual_manipulator(
    name: str, file: str, effects: Sequence[str], seed: int
) -> tuple[Campaign, dict[str, object]]:
    """A manipulator measured at its usual postures on frame elements with hidden effects, and the answer."""
    described = read(file)
    named = file if (SHIPPED / f"{file}.toml").exists() else str(Path(file).resolve())
    whole = described.manipulator
    rig = ManipulatorRig(length=whole.length, manipulator=whole, file=named)
    sizes, noise = (np.random.default_rng(s) for s in np.random.SeedSequence(seed).spawn(2))
    values = hidden(effects, catalogue(), rig, sizes)
    tests = plan(whole, described.home)
    campaign = measure_manipulator(name, rig, tests, values, int(noise.integers(2**63)))
    return campaign, {
        "effects": list(values),
        "parameters": {path_of(name, p): value for name, own in values.items() for p, value in own.items()},
        "seed": seed,
        "rig": f"manipulator {whole.name}",
        "truth": "linear frame finite elements at each posture",
    }
