"""Cases with hidden laws by number: the same number is the same case, on any machine.

laws       0 to 39: law number % 20 of the grammar, drawn twice; 40 to 59: law number % 10 of those outside, twice
pairs      0 to 19: two smooth laws at sites of different kinds
clean      0 to 99: a clean case of the clean programme, exact; 100 to 199: the same with the bar up to 2 % off;
           200 to 299: clean cases of the dirty programme
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from fem.frame.laws.form import Law
from pipeline.assessment.challenge.benches import (
    AXIAL,
    FAIR,
    HELD,
    RICH,
    Bench,
    drawn_noise,
    drawn_plan,
    drawn_rig,
    whole_plan,
)
from pipeline.assessment.challenge.cases import ROUND, STEPS, Case, case
from pipeline.assessment.challenge.dirty.cases import ROUND as DIRTY_ROUND
from pipeline.assessment.challenge.dirty.cases import dirty_case
from pipeline.assessment.challenge.dirty.dirt import BAD_MOST, CELL, CORRELATED, DIALS, Dirt
from pipeline.assessment.challenge.laws.shapes import EVERY, GRAMMAR, OUTSIDE, SMOOTH_LAWS, Draw, Shape
from pipeline.assessment.virtual.plan import PlannedTest
from pipeline.campaign import ParallelogramRig
from pipeline.simulate import scaled

Kind = Literal["law", "pair", "clean"]
SEED = 20_261_128
CASES: dict[Kind, int] = {"law": 60, "pair": 20, "clean": 300}
MU = (15.0, 200.0)
"""Sigmas by which a law shows in the fitted tests, drawn uniformly in the logarithm."""
BAR_OFF, BAR_MOST = 0.01, 0.02
"""Standard deviation and largest deviation of the bar's stiffnesses from the drawing."""
BEYOND = 1.5
"""Loads of held-out tests over those of the fitted ones."""
POOR_OF_TEN = (3, 7)
TAILS = 3.0
"""Degrees of freedom of the Student t that the noise of some cases has."""
GROUPS = {
    "hinge": ("hinge_torque",),
    "along": ("along",),
    "tilt": ("tilt_x", "tilt_z"),
    "base": ("base_x", "base_y", "base_z", "base_rx", "base_ry", "base_rz"),
}
"""Kinds of sites that a law may be hidden at."""
OFTEN = {"hinge": 0.16, "along": 0.28, "tilt": 0.28, "base": 0.28}
"""How often a kind comes first, of laws that may be at any; laws for hinges alone come beside them."""
BY_LOAD = "CoulombByLoad"
_UNTOLD = {
    "one angle": lambda test: test.q_deg == 0.0,
    "axial and swing": lambda test: test.id.startswith(("axial_held", "swing")),
}
"""Plans that cannot tell sites apart well, by the fitted tests that they keep."""


@dataclass(frozen=True)
class Hidden:
    """name: class of the law. shape: of hinge and series sites. sites: in the order in which they are tried. mu: sigmas
    by which it shall show."""

    name: str
    shape: Shape
    sites: tuple[str, ...]
    mu: float

    def law(self, site: str) -> Law:
        """Its shape at that site."""
        law = self.shape.hinge if site.startswith("hinge_torque") else self.shape.series
        assert law is not None
        return law


@dataclass(frozen=True, eq=False)
class LawCase(Case):
    """laws: what is hidden. poor: whether the plan cannot tell sites apart well. dirt: what the bench has besides.
    exact: what is written of the rig is vouched for, and so it is."""

    laws: tuple[Hidden, ...]
    poor: bool
    dirt: Dirt
    exact: bool = False


def law_case(number: int, share: float = 1.0) -> LawCase:
    """The case with one law of that number; share: of the loads, less than one where the bench does not bear them."""
    name = list(GRAMMAR)[number % 20] if number < 40 else list(OUTSIDE)[number % 10]
    poor = (number + number // 10) % 10 in POOR_OF_TEN
    kind_of_dirt = ("tails", "bad", "correlated")[number // 3 % 3] if number % 3 == 0 else ""
    generator = np.random.default_rng([SEED, 0, number])
    second = number % 40 >= 20 if number < 40 else number >= 50
    return _drawn("law", number, generator, (name,), poor, kind_of_dirt, second, share)


def pair_case(number: int, share: float = 1.0) -> LawCase:
    """The case with two laws of that number."""
    generator = np.random.default_rng([SEED, 1, number])
    names = tuple(str(n) for n in generator.choice(SMOOTH_LAWS, 2, replace=False))
    return _drawn("pair", number, generator, names, False, "", bool(number % 2), share)


def clean_case(number: int, share: float = 1.0) -> LawCase:
    """The case without a law of that number: benches of the clean and the dirty programme."""
    if number >= 200:
        own = number - 200
        it = dirty_case(_clean_numbers(DIRTY_ROUND, own), share)
        return LawCase(number, "clean", it.bench, {}, None, it.seed, (), False, it.dirt)
    found = case(_clean_numbers(ROUND, number), share)
    bar = np.ones(4)
    if number >= 100:
        bar = bar_off(np.random.default_rng([SEED, 2, number]))
    return LawCase(
        number, "clean", found.bench, {}, None, found.seed, (), False, Dirt.of_bar(bar), exact=number < 100
    )


def _clean_numbers(kinds: Sequence[str], count: int) -> int:
    """The number of the clean case after so many others, in rounds of these kinds."""
    clean = [k for k, kind in enumerate(kinds) if kind == "clean"]
    return len(kinds) * (count // len(clean)) + clean[count % len(clean)]


def _drawn(
    kind: Kind,
    number: int,
    generator: np.random.Generator,
    names: tuple[str, ...],
    poor: bool,
    kind_of_dirt: str,
    second: bool,
    share: float,
) -> LawCase:
    steps, seed = int(generator.choice(STEPS)), int(generator.integers(2**62))
    rig, noise = drawn_rig(generator), drawn_noise(generator)
    label = str(generator.choice((RICH, FAIR)))
    tests = drawn_plan(generator, label, steps)
    untold = str(generator.choice(list(_UNTOLD)))
    if poor:
        label = untold
        tests = tuple(t for t in whole_plan(steps) if t.holdout or _UNTOLD[untold](t))
    plan = scaled([_further(test) for test in tests], rig, share)
    dirt = _drawn_dirt(generator, kind_of_dirt)
    axial = scaled([t for t in whole_plan(steps) if t.id == AXIAL[0]], rig, 1.0)
    load = float(np.abs(axial[0].values[:, 0]).max())
    laws: list[Hidden] = []
    for name in names:
        shape = EVERY[name](Draw(generator, second, 0.5 * load))
        taken = {group_of(it.sites[0]) for it in laws}
        laws.append(Hidden(name, shape, _sites(generator, name, shape, taken), _size(generator)))
    bench = Bench(rig, noise, plan, label)
    return LawCase(number, kind, bench, {}, None, seed, tuple(laws), poor, dirt)


def group_of(site: str) -> str:
    """The kind of sites that a site belongs to."""
    kind = site.partition("@")[0]
    return next(group for group, kinds in GROUPS.items() if kind in kinds)


def further(test: PlannedTest, angle: float, rig: ParallelogramRig, share: float) -> PlannedTest:
    """A fitted test of the good bench at another angle with loads beyond its own, held out; for this rig."""
    name = test.id.rpartition("_q")[0]
    (own,) = [t for t in whole_plan(HELD) if t.id == test.id]
    held = replace(own, id=f"{name}_q{angle:+.0f}", q_deg=angle, values=BEYOND * own.values, holdout=True)
    return scaled([held], rig, share)[0]


def _further(test: PlannedTest) -> PlannedTest:
    """Held out: with loads beyond those of the fitted tests, of which the good bench plans 0.9."""
    return replace(test, values=BEYOND / 0.9 * test.values) if test.holdout else test


def _sites(generator: np.random.Generator, name: str, shape: Shape, taken: set[str]) -> tuple[str, ...]:
    """Every site that may be, in the order in which they are tried: alike, or at one end."""
    groups = list(GROUPS)
    order = [groups[k] for k in generator.choice(4, 4, replace=False, p=[OFTEN[g] for g in groups])]
    if shape.series is None:
        order = ["hinge"]
    out = []
    for group in order:
        for k in generator.permutation(len(GROUPS[group])).tolist():
            kind, one = GROUPS[group][k], generator.random() < 0.5
            end = str(generator.choice(("base", "tip")))
            alone = one or (group == "hinge" and shape.lopsided)
            if group not in taken and not (name == BY_LOAD and group == "base"):
                out.append(kind if group == "base" or not alone else f"{kind}@{end}")
    return tuple(out)


def _size(generator: np.random.Generator) -> float:
    return float(np.exp(generator.uniform(*np.log(MU))))


def bar_off(generator: np.random.Generator) -> np.ndarray:
    """(4,) true over nominal EA, EIy, EIz, GJ of a bar that is a little beside its drawing."""
    return 1.0 + np.clip(BAR_OFF * generator.normal(size=4), -BAR_MOST, BAR_MOST)


def _drawn_dirt(generator: np.random.Generator, kind: str) -> Dirt:
    dirt = Dirt.of_bar(bar_off(generator))
    share, channel, r = (
        float(generator.uniform(0.25 * BAD_MOST, BAD_MOST)),
        int(generator.choice([*CELL[:3], *DIALS, 12])),
        float(generator.uniform(*CORRELATED)),
    )
    if kind == "tails":
        return replace(dirt, tails=TAILS)
    if kind == "bad":
        return replace(dirt, bad=share)
    return replace(dirt, correlated=(channel, r)) if kind == "correlated" else dirt
