"""A virtual bench: finite elements with hidden effects and noise, as a bench that knows its answer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from pipeline.campaign import read
from pipeline.face.bench import Bench
from pipeline.face.subject import Subject
from pipeline.inference.model import Model
from pipeline.inference.suitable import known_effects
from pipeline.simulate import require_free, virtual, write_sealed
from pipeline.simulate_manipulator import virtual_manipulator


@dataclass(frozen=True, eq=False, repr=False)
class VirtualBench(Bench):
    """A bench that finite elements have measured. answer: what is hidden in it, each value in the unit of its
    parameter; `print` does not show it."""

    answer: Mapping[str, object]


def simulate(
    *effects: str,
    seed: int = 0,
    manipulator: str | Path | None = None,
    out: str | Path | None = None,
    name: str = "virtual bench",
) -> VirtualBench:
    """Measure a virtual bench: finite elements, not the model that is fitted, with hidden effects and noise.

    effects: "joint_friction=800", "joint_friction.torque_Nmm=800" or "joint_friction", whose size is then drawn; values
    in the units of the catalogue. seed: of the noise and of sizes that are drawn. manipulator: a shipped one or its
    file; default is the paper's parallelogram. out: folder for the campaign, with its sealed answer beside it; default
    nothing is written. InputError for effects that cannot be had and for a folder that has a campaign; RuntimeError
    where the bench itself finds no equilibrium.
    """
    place = None if out is None else Path(out)
    if place is not None:
        require_free(place)
        name = place.resolve().name
    if manipulator is None:
        campaign, answer = virtual(name, effects, seed)
    else:
        campaign, answer = virtual_manipulator(name, str(manipulator), effects, seed)
    if place is not None:
        write_sealed(place, campaign, answer)
        campaign = read(place)
    return VirtualBench(Subject(campaign, Model(), known_effects().sized(campaign)), answer)
