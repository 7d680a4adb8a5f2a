"""Rigs and trials that the frame's tests share."""

from __future__ import annotations

import numpy as np

from fem.frame.bench import NAMES, Readings, Trial, run
from fem.frame.errors import Errors
from fem.frame.linkages import ELEMENTS
from fem.frame.rig import Gauge, Rig
from fem.frame.section import Plane, Section, uniform
from fem.material import Isotropic
from meshes.solid import Floats

LENGTH, WIDTH = 310.0, 80.0
ORTHOGLIDE = np.diag([2.20e4, 1.81e1, 7.86e1, 3.48e4, 2.66e6, 5.85e5])
ORTHOGLIDE[1, 5] = ORTHOGLIDE[5, 1] = -2.84e3
ORTHOGLIDE[2, 4] = ORTHOGLIDE[4, 2] = 1.25e4
"""Eq. 12 of Pashkevich, Klimchik, Caro, Chablat."""

SLENDER = uniform(EA=6.82e6, EIy=1.98e8, EIz=4.51e7, GJ=1.08e7)
_P = Isotropic(70e3, 0.33, "yardstick bar P")
BAR_P = Section(
    _P.E * 97.2,
    _P.shear_modulus * 357.4,
    Plane(_P.E * 2812.1, _P.shear_modulus * 51.8),
    Plane(_P.E * 692.8, _P.shear_modulus * 59.7),
)
"""The plain I-bar P as a uniform Timoshenko beam: its section and shear areas."""


def parallelogram(bar: Section | Floats = SLENDER) -> Rig:
    """The parallelogram of the paper's length and width."""
    return Rig("parallelogram", LENGTH, bar, WIDTH, fibre_y=6.0, fibre_z=8.0)


def control(*held: str) -> tuple[str, ...]:
    """Displacements of the named coordinates, forces of the others."""
    return tuple("displacement" if name in held else "force" for name in NAMES)


def steps(**values: float | list[float]) -> Floats:
    """(S, 6) values by coordinate, zero where not named."""
    columns = {name: np.atleast_1d(np.asarray(v, float)) for name, v in values.items()}
    count = max(len(v) for v in columns.values())
    return np.stack([np.broadcast_to(columns.get(n, np.zeros(1)), count) for n in NAMES], axis=-1)


def measure(
    rig: Rig,
    held: tuple[str, ...],
    values: Floats,
    degrees: float = 0.0,
    effects: dict[str, float] | None = None,
    gauges: tuple[Gauge, ...] = (),
    elements: int = ELEMENTS,
    temperature: Floats | None = None,
) -> Readings:
    """One trial whose steps must all be found."""
    trial = Trial(np.radians(degrees), control(*held), values, temperature)
    found = run(rig, Errors.of(effects or {}), [trial], gauges, elements)[0]
    assert found.converged.all(), found.reason
    return found
