"""Find the bar whose solid stiffness meets a given 6x6: space mapping from the beam oracle to the solid.

The closed-form beam is the cheap model, the solid the true one. Each round fits the beam, its eight entries
multiplied by the ratio solid / beam of the round before, to the matrix; at the fixed point the solid itself is
what fits. A round costs one solid solve.
Source of the method: J. W. Bandler et al., Space mapping: the state of the art, IEEE Trans. Microwave Theory Tech.
52 (2004) 337-361.

The family: an I-section of four dimensions; at each end a solid lug as wide and as high as the section, of a
given length. Bars symmetric about their middle cannot meet the paper's matrix exactly: K35 / K33 and K26 / K22 of
such a bar are half its length. A lug lower than the section would come nearer to it (1.3 % instead of 2.6 %), by
making the ends softer than the section: its pinned critical load would be a quarter above that of a uniform bar
with the same 6x6, and the notch slows the convergence of the solid.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from fem.beam import Segment, stepped_stiffness
from fem.material import Isotropic
from fem.thin_walled import i_section_constants, rectangle_constants
from meshes.bar import Bar, Lug
from meshes.section import ISection, Rectangle
from meshes.solid import Floats
from pipeline.validation.entries import eight_entries

ROUNDS = 10
SETTLED = 2e-3
Dimensions = tuple[float, float, float, float]


@dataclass(frozen=True)
class Found:
    """The bar found with its solid (6, 6), the beam fit it started from, the relative misfits of the eight entries,
    and how many solids were solved."""

    bar: Bar
    stiffness: Floats
    start: Bar
    misfits: Floats
    solves: int


@dataclass(frozen=True)
class Family:
    """Bars of `length` mm with lugs of `lug` mm."""

    length: float
    lug: float

    def member(self, dimensions: Dimensions) -> Bar:
        """The bar with this flange width, flange thickness, height and web, mm."""
        b, t, h, w = (float(d) for d in dimensions)
        return Bar(ISection(b, t, h, w), self.length, Lug(self.lug, b, h))


def thin_walled_stiffness(bar: Bar, material: Isotropic) -> Floats:
    """(6, 6) of a member of the family as a stepped beam with thin-walled section constants."""
    assert bar.lug is not None and isinstance(bar.section, ISection)
    block = rectangle_constants(Rectangle(bar.lug.width, bar.lug.height))
    lug = Segment.of(block, material, bar.lug.length)
    body = Segment.of(i_section_constants(bar.section), material, bar.length - 2 * bar.lug.length)
    return stepped_stiffness([lug, body, lug])


def find_bar(
    target: Floats,
    family: Family,
    material: Isotropic,
    solid: Callable[[Bar], Floats],
    on_round: Callable[[int, float], None] | None = None,
) -> Found:
    """The member of the family whose `solid` 6x6 meets `target` best in the relative root mean square.

    Raises RuntimeError if the rounds do not settle or the beam cannot be fitted.
    """
    wanted = eight_entries(target)
    bounds = search_bounds(wanted, family.length, material)
    x = np.log(np.sqrt(bounds[0] * bounds[1]))
    ratio, start = np.ones(8), None
    for round_number in range(ROUNDS + 1):
        following = fit_beam(x, wanted / ratio, bounds, family, material)
        moved, x = float(np.abs(following - x).max()), following
        bar = family.member(tuple(np.exp(x)))
        start = start or bar
        stiffness = solid(bar)
        misfits = eight_entries(stiffness) / wanted - 1.0
        rms = float(np.sqrt(np.mean(misfits**2)))
        if on_round is not None:
            on_round(round_number, rms)
        if round_number and moved < SETTLED:
            return Found(bar, stiffness, start, misfits, round_number + 1)
        ratio = eight_entries(stiffness) / eight_entries(thin_walled_stiffness(bar, material))
    raise RuntimeError(
        f"the search for the bar did not settle in {ROUNDS} rounds, the last had {rms:.2%} misfit"
    )


def search_bounds(wanted: Floats, length: float, material: Isotropic) -> tuple[Floats, Floats]:
    """Bounds (4,) of the four dimensions, mm, around those of a slender uniform I-bar with the wanted A, Iy and Iz;
    wanted (8,) as `eight_entries`."""
    area = wanted[0] * length / material.E
    height = 2.9 * np.sqrt(wanted[3] * length**3 / (12 * material.E) / area)
    width = 4.5 * np.sqrt(wanted[1] * length**3 / (12 * material.E) / area)
    middle = np.array([width, area / (4 * width), height, area / (2 * height)])
    spread = np.array([2.0, 2.0, 1.5, 2.0])
    return middle / spread, middle * spread


def fit_beam(
    x: Floats, wanted: Floats, bounds: tuple[Floats, Floats], family: Family, material: Isotropic
) -> Floats:
    """Logarithms (4,) of the dimensions, mm, whose beam has the wanted entries (8,), by bounded least squares from
    x (4,) within bounds (4,)."""

    def misfit(at: Floats) -> Floats:
        try:
            bar = family.member(tuple(np.exp(at)))
        except ValueError:
            # Outside the family (a web wider than the flange): farther off than any member of it.
            return np.full(8, 10.0)
        return eight_entries(thin_walled_stiffness(bar, material)) / wanted - 1.0

    solution = least_squares(
        misfit, x, bounds=(np.log(bounds[0]), np.log(bounds[1])), diff_step=1e-4, xtol=1e-7
    )
    if not solution.success:
        raise RuntimeError(f"the beam could not be fitted to the matrix: {solution.message}")
    return np.asarray(solution.x)
