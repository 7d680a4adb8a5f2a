"""Kinds of doubt: what a bench has besides the physics, and what the answer has to be."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.assessment.challenge.cases import HIDDEN
from pipeline.assessment.challenge.dirty.dirt import DIALS, OFF, Dirt, true_rig
from pipeline.assessment.doubts.answers import Told
from pipeline.assessment.doubts.benches import KNOCKED, Drawn
from pipeline.assessment.doubts.machines import Factors
from pipeline.campaign import ParallelogramRig, UniformBar

Array = NDArray[np.float64]
FAR_OFF = 0.1
"""By which each stiffness of a bar is off that is named as the bar."""
LUG = (0.005, 0.02)
"""Rigid stretch at each end of a bar, of its length: that of the paper's bar (Eq. 12) is 0.0155."""
TAILS = 3.0
"""Degrees of freedom of Student's t."""
ROUNDED = 2.0
"""Resolution of displays, in sigmas."""
OF_BAR = frozenset({"modulus_error", "bar_section_error"})
"""Names that say that the bar is not as it is written."""
SOFT_DRIVES, SOFT_FEET = 0.8, 0.7
"""Stiffness of a machine's drives and of its feet over that of its file."""
EXPLANATIONS = 3
"""Of which one is right, at most."""
NO_LUG = frozenset({"axis_flexibility", "base_compliance"})
"""What a lugged bar must not be taken for."""


@dataclass(frozen=True)
class Kind:
    """made, right: in words. wanted: how often. judged: why an answer is not right, empty where it is."""

    made: str
    right: str
    wanted: str
    judged: Callable[[Told], str]


@dataclass(frozen=True)
class OfBench(Kind):
    """draw: what a bench has, by its rig and a generator, and whether an effect is hidden on every other one. beside:
    whether the same bench is diagnosed without it too."""

    draw: Callable[[ParallelogramRig, np.random.Generator, bool], Drawn]
    beside: bool = False


@dataclass(frozen=True)
class OfMachine(Kind):
    """draw: stiffness of a machine's parts over that of its file, by a generator."""

    draw: Callable[[np.random.Generator], Factors]


def _plain(rig: ParallelogramRig, _: np.random.Generator, hidden: bool) -> Drawn:
    return Drawn(rig, rig, Dirt.of_bar(np.ones(4)), HIDDEN if hidden else ())


def _bar(rig: ParallelogramRig, off: Array) -> Drawn:
    dirt = Dirt.of_bar(1.0 + off)
    return Drawn(rig, true_rig(rig, dirt.bar), dirt)


def _bar_near(rig: ParallelogramRig, generator: np.random.Generator, _: bool) -> Drawn:
    return _bar(rig, generator.uniform(-OFF, OFF, 4))


def _bar_far(rig: ParallelogramRig, generator: np.random.Generator, alike: bool) -> Drawn:
    signs = generator.choice((-1.0, 1.0), 4)
    return _bar(rig, FAR_OFF * (np.full(4, signs[0]) if alike else signs))


def _lugged(rig: ParallelogramRig, generator: np.random.Generator, _: bool) -> Drawn:
    bar, one = typed(rig), Dirt.of_bar(np.ones(4))
    written = replace(rig, bar=bar, bar_stiffness=None)
    own = with_lugs(bar, rig.length, float(generator.uniform(*LUG)))
    return Drawn(written, replace(written, bar=None, bar_stiffness=own), one)


def _tails(rig: ParallelogramRig, generator: np.random.Generator, hidden: bool) -> Drawn:
    it = _plain(rig, generator, hidden)
    return replace(it, dirt=replace(it.dirt, tails=TAILS))


def _knocked(rig: ParallelogramRig, generator: np.random.Generator, hidden: bool) -> Drawn:
    return replace(_plain(rig, generator, hidden), knocked=KNOCKED)


def _rounded(rig: ParallelogramRig, generator: np.random.Generator, hidden: bool) -> Drawn:
    it = _plain(rig, generator, hidden)
    steps = it.dirt.rounded.copy()
    steps[list(DIALS)] = ROUNDED
    return replace(it, dirt=replace(it.dirt, rounded=steps))


def _kinked(rig: ParallelogramRig, generator: np.random.Generator, loose: bool) -> Drawn:
    return replace(_plain(rig, generator, False), hidden=("joint_clearance" if loose else "joint_friction",))


def typed(rig: ParallelogramRig) -> UniformBar:
    """The section that the formulas of a uniform beam give back of a rig's bar."""
    if rig.bar is not None:
        return rig.bar
    k, length = np.diag(rig.stiffness), rig.length
    cube = length**3 / 12.0
    return UniformBar(EA=k[0] * length, EIy=k[2] * cube, EIz=k[1] * cube, GJ=k[3] * length)


def with_lugs(bar: UniformBar, length: float, share: float) -> Array:
    """(6, 6) stiffness at the tip, N, mm, rad, of a bar of this section between two rigid ends of a share of its length
    each: a force at the middle of its flexible stretch f turns nothing, so that with amount f/EI and spread
    f³/(12 EI) the compliance of a plane is [[spread + amount h², amount h], [amount h, amount]], h half the length."""
    free, half = (1.0 - 2.0 * share) * length, 0.5 * length
    soft = np.diag([free / bar.EA, 0.0, 0.0, free / bar.GJ, 0.0, 0.0])
    for shift, turn, rigidity, sign in ((1, 5, bar.EIz, 1.0), (2, 4, bar.EIy, -1.0)):
        amount = free / rigidity
        soft[shift, shift] = free**3 / (12.0 * rigidity) + amount * half**2
        soft[shift, turn] = soft[turn, shift] = sign * amount * half
        soft[turn, turn] = amount
    return np.asarray(np.linalg.inv(soft))


def _nothing_named(it: Told) -> str:
    return f"{it.words(it.named)} named" if it.named else ""


def _bar_named(it: Told) -> str:
    return "" if it.every_set_has(OF_BAR) else "the bar not named"


def _no_lug(it: Told) -> str:
    return f"{it.words(it.named & NO_LUG)} named" if it.named & NO_LUG else ""


def _tails_found(it: Told) -> str:
    if not it.tails:
        return "no tails found"
    return f"{len(it.aside)} readings set aside" if it.aside else it.other_than_beside


def _these_cells(it: Told) -> str:
    if it.unseen or it.good_aside:
        return f"{it.unseen} of {it.shown} not found, {it.good_aside} good ones set aside"
    return it.other_than_beside


def _not_rescaled(it: Told) -> str:
    return f"sigma of {', '.join(it.rescaled)} changed" if it.rescaled else ""


def _not_bad(it: Told) -> str:
    return f"{len(it.aside)} readings set aside" if it.aside else ""


def _named(name: str) -> Callable[[Told], str]:
    """Whether an answer names an effect, alone or in one of few explanations."""

    def judged(it: Told) -> str:
        if it.verdict not in ("identified", "ambiguous") or not any(name in names for names in it.sets):
            return f"{name} not named"
        return f"one of {len(it.sets)}" if len(it.sets) > EXPLANATIONS else ""

    return judged


def _typed_in(generator: np.random.Generator) -> Factors:
    return Factors(*(1.0 + generator.uniform(-OFF, OFF, 3)).tolist())


BENCHES: Mapping[str, OfBench] = {
    "bar within 3 %": OfBench(
        "each stiffness of the bars off by up to 3 %, evenly drawn; nothing hidden",
        "nothing is named",
        "98 %",
        _nothing_named,
        _bar_near,
    ),
    "bar off by 10 %": OfBench(
        "each stiffness of the bars off by 10 %, alike or each with a sign of its own; nothing hidden",
        "named as the bar in every set",
        "90 %",
        _bar_named,
        _bar_far,
    ),
    "lugged bar": OfBench(
        "rigid ends of 0.5 to 2 % of the length each; written by the formulas of a uniform beam; nothing hidden",
        "neither axes nor base named",
        "always",
        _no_lug,
        _lugged,
    ),
    "long tails": OfBench(
        "noise of Student's t with 3 degrees of freedom",
        "tails found, nothing set aside, verdict as without",
        "always",
        _tails_found,
        _tails,
        beside=True,
    ),
    "six knocked": OfBench(
        "six readings off by 15 to 60 sigmas",
        "those that show set aside and no others, verdict as without",
        "always",
        _these_cells,
        _knocked,
        beside=True,
    ),
    "rounded": OfBench(
        "dials rounded to two sigmas", "no sigma is changed", "always", _not_rescaled, _rounded
    ),
    "right sigmas": OfBench("nothing besides", "no sigma is changed", "always", _not_rescaled, _plain),
    "play, friction": OfBench(
        "a play or a friction in the hinges", "nothing is set aside", "always", _not_bad, _kinked
    ),
}
MACHINES: Mapping[str, OfMachine] = {
    "soft drives": OfMachine(
        "Orthoglide, all drives 20 % softer",
        "actuator_compliance, alone or in one of three explanations at most",
        "always",
        _named("actuator_compliance"),
        lambda _: Factors(drives=SOFT_DRIVES),
    ),
    "soft feet": OfMachine(
        "Orthoglide, all feet 30 % softer",
        "link_compliance, alone or in one of three explanations at most",
        "always",
        _named("link_compliance"),
        lambda _: Factors(links=SOFT_FEET),
    ),
    "typed in": OfMachine(
        "Orthoglide, stiffness of drives, feet and bars each up to 3 % off, evenly drawn",
        "nothing is named",
        "95 %",
        _nothing_named,
        _typed_in,
    ),
}
KINDS: Mapping[str, Kind] = {**BENCHES, **MACHINES}
