"""What axial force does to the bar's 6x6: identified from the solid, by formula, and as the refined springs have it."""

from math import sqrt

import numpy as np

from fem.axial import uniform_geometric_stiffness
from fem.beam import Segment
from meshes.solid import Floats
from pipeline.validation.entries import ENTRIES, rows
from pipeline.validation.result import Axial
from pipeline.validation.stages.mesh_study import MeshStudy
from pipeline.validation.stages.specimen import Specimen
from vjm.equilibrium import equilibrium
from vjm.mechanisms.bar import Bar
from vjm.refined import Refined
from vjm.stiffness import loaded_stiffness

# Of the central difference, N: the second order it leaves is a share of (P / 20 kN)², rounding far less.
PULL = 10.0
# Entries that bending makes; the other two, K11 and K44, have no part in how a bar buckles by bending.
# With the power of the length by which they fall.
BENDING = {"K22": 3, "K26": 2, "K33": 3, "K35": 2, "K55": 1, "K66": 1}


def spring_slope(stiffness: Floats, length: float) -> Floats:
    """(6, 6) dK/dP of the refined bar's loaded stiffness at no load, per N; RuntimeError if it finds no equilibrium."""
    bar = Bar(length, stiffness, bar=Refined())
    targets = np.zeros((2, 6))
    targets[:, 0] = PULL, -PULL
    state = equilibrium(bar, targets, ())
    if not np.all(state.converged):
        raise RuntimeError("the refined bar has no equilibrium under a small axial force")
    pulled, pushed = loaded_stiffness(state)
    return np.asarray((pulled - pushed) / (2 * PULL))


def axial_record(s: Specimen, stiffness: Floats, study: MeshStudy) -> Axial:
    """K_g of the solid beside the uniform beam's and the refined springs', for K_b (6, 6)."""
    c = s.constants
    polar = (c.Iy + c.Iz) / c.area
    formula = uniform_geometric_stiffness(Segment.of(c, s.material, s.bar.length), polar)
    solid, vjm = np.array(study.geometric), spring_slope(stiffness, s.bar.length)
    return Axial(
        solid=rows(solid),
        formula=rows(formula),
        vjm=rows(vjm),
        band=study.geometric_band,
        explanation=explained(s, solid, formula, vjm, stiffness),
    )


def explained(s: Specimen, solid: Floats, formula: Floats, vjm: Floats, stiffness: Floats) -> list[str]:
    """A sentence for each difference of K_g (6, 6); stiffness: K_b (6, 6)."""
    by_formula, name = worst(formula, solid)
    by_vjm, other = worst(vjm, solid)
    work = stiffness / (stiffness[0, 0] * s.bar.length)
    stretched = solid.copy()
    for entry, power in BENDING.items():
        stretched[ENTRIES[entry]] -= (1 + power) * work[ENTRIES[entry]]
    left, last = worst(vjm, stretched)
    twist, torsion = solid[3, 3], stiffness[3, 3]
    strain = 1e3 / (stiffness[0, 0] * s.bar.length)
    return [
        f"Uniform beam: the six bending entries lie within {100 * by_formula:.1f} % (worst {name}); it knows neither "
        f"the lugs nor the rigid end faces, which move the bending towards the middle of the bar.",
        f"VJM, refined: given nothing but K_b it has the six entries within {100 * by_vjm:.1f} % (worst {other}). It "
        f"counts that a pulled bar is longer and so softer by n K_b / EA (n = 3 for shifts, 2 for couplings, 1 for "
        f"turns), and not the work of the axial strain of bending, K_b / EA, as linear buckling has it; with both "
        f"taken from the solid {100 * left:.1f} % is left (worst {last}): it places the flexible length by K_b alone.",
        f"K11: its 1 / L is axial strain beside 1, which linear springs do not have: {100 * strain:.2g} % of K11 a kN.",
        f"K44: a twisted fibre is longer (Wagner). The default refined bar leaves that out: 1 kN changes K44 by "
        f"{1e5 * twist / torsion:.2f} %, as much as a polar radius of {sqrt(twist * s.bar.length):.2f} mm would.",
    ]


def worst(other: Floats, solid: Floats) -> tuple[float, str]:
    """The largest relative difference among the bending entries of two K_g (6, 6), and its name."""
    return max((abs(float(other[ENTRIES[n]] / solid[ENTRIES[n]] - 1.0)), n) for n in BENDING)
