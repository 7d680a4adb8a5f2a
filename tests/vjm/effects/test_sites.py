"""Effects at single hinges and bars: all single sites together are all alike, exactly, on bench and machine."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from parastiff import Effect, Parameter, laws
from tests.vjm.manipulator.example import orthoglide, pair, under
from vjm import paper
from vjm.effects import catalogue
from vjm.effects.base import Rig, Values
from vjm.equilibrium import equilibrium
from vjm.manipulator.effects import with_effect
from vjm.manipulator.posture import postures
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram

BENCH = Parallelogram(paper.LENGTH, paper.WIDTH, paper.BAR_STIFFNESS, 0.3)
TARGETS = np.array([[500.0, 40.0, 3.0, 2e3, 1e3, -2e3], [-200.0, -30.0, -4.0, 0.0, 500.0, 1e3]])
HINGES = ("1.base", "1.tip", "2.base", "2.tip")
SINGLE = {
    "joint_friction": HINGES,
    "joint_torsional_stiffness": HINGES,
    "axis_flexibility": HINGES,
    "joint_clearance": ("1.base", "2.base"),
    "contact_stiffening": ("1.base", "2.base"),
    "modulus_error": ("1", "2"),
    "bar_initial_bow": ("1", "2"),
    "thermal_expansion": ("1", "2"),
}


class SealSpring(Effect):
    """The effect of the README."""

    name, hinge = "seal_spring", "any"
    title, equation = "seals stiffen the hinges", "M = c angle³"
    signature = "a force along z that grows with the cube of the displacement; no loop"
    limits, source = "all hinges alike", "Taylor series of an odd law"
    parameters = (Parameter("cubic_Nmm", "N·mm/rad³", 0.0, 5e6, 0.0, 1e9, "torque at one radian"),)

    def change(self, rig: Rig, values: Values) -> Rig:
        return replace(rig, hinges=(*rig.hinges, laws.Polynomial((0.0, 0.0, values["cubic_Nmm"]))))


EVERY = {**catalogue(), "seal_spring": SealSpring()}


@pytest.mark.parametrize(("name", "sites"), [*SINGLE.items(), ("seal_spring", HINGES)])
def test_all_single_sites_are_all_alike(name: str, sites: tuple[str, ...]) -> None:
    effect = EVERY[name]
    alike, apart = effect.apply(BENCH, effect.typicals), BENCH
    for site in sites:
        apart = effect.apply(apart, effect.typicals, site)
    for it in (equilibrium(alike, TARGETS, ("z",)), equilibrium(apart, TARGETS, ("z",))):
        assert np.all(it.converged)
    one, other = (equilibrium(rig, TARGETS, ("z",)) for rig in (alike, apart))
    assert np.array_equal(one.pose, other.pose) and np.array_equal(one.load, other.load)
    single = equilibrium(effect.apply(BENCH, effect.typicals, sites[0]), TARGETS, ("z",))
    plain = equilibrium(BENCH, TARGETS, ("z",))
    if name != "thermal_expansion":  # Which shows with a temperature only.
        assert not np.array_equal(single.pose, one.pose) or not np.array_equal(single.load, one.load)
        assert not np.array_equal(single.pose, plain.pose) or not np.array_equal(single.load, plain.load)


def test_a_site_stands_for_all_parts_with_its_tags() -> None:
    """Both base hinges by one site are the two one by one."""
    effect = EVERY["joint_torsional_stiffness"]
    both = effect.apply(BENCH, effect.typicals, "base")
    one_by_one = effect.apply(effect.apply(BENCH, effect.typicals, "base.1"), effect.typicals, "2.base")
    assert [len(each) for each in both.hinge_laws] == [1, 0, 1, 0]
    first, second = (equilibrium(rig, TARGETS, ("z",)) for rig in (both, one_by_one))
    assert np.array_equal(first.pose, second.pose)


def test_after_a_site_all_hinges_get_more() -> None:
    effect = EVERY["joint_torsional_stiffness"]
    rig = effect.apply(effect.apply(BENCH, effect.typicals, "1.tip"), effect.typicals)
    assert [len(each) for each in rig.hinge_laws] == [1, 2, 1, 1]


@pytest.mark.parametrize(
    "name", ["joint_torsional_stiffness", "axis_flexibility", "modulus_error", "seal_spring"]
)
def test_single_sites_of_a_machine(name: str) -> None:
    """All twelve hinges, or six bars, of an Orthoglide one by one are all alike; one leg alone is not."""
    effect, whole = EVERY[name], orthoglide(pair())
    at = postures(whole, np.array([[40.0, -30.0, 50.0]]))
    load = np.array([[100.0, -50.0, 80.0, 2e3, 1e3, -1e3]])
    alike, apart = with_effect(whole, effect, effect.typicals), whole
    bars = effect.acts_on == "bars"
    for site in (
        f"{leg}.parallelogram.{place}" for leg in "xyz" for place in (("1", "2") if bars else HINGES)
    ):
        apart = with_effect(apart, effect, effect.typicals, site)
    one, other = (under(it, at, load) for it in (alike, apart))
    assert np.array_equal(one.pose, other.pose)
    leg = with_effect(whole, effect, effect.typicals, "y")
    assert leg.legs[0] is whole.legs[0] and leg.legs[1] is not whole.legs[1]
    assert not np.array_equal(under(leg, at, load).pose, one.pose)


def test_effects_after_one_leg_keep_it() -> None:
    """An effect of all hinges adds to the one that a single leg has."""
    effect, whole = EVERY["joint_torsional_stiffness"], orthoglide(pair())
    it = with_effect(with_effect(whole, effect, effect.typicals, "y"), effect, effect.typicals)
    laws_of = [leg.parts[4].as_built.hinges for leg in it.legs]  # type: ignore[union-attr]
    assert [[len(each) for each in own] for own in laws_of] == [[1] * 4, [2] * 4, [1] * 4]


@pytest.mark.parametrize(
    ("name", "site", "said"),
    [
        ("joint_clearance", "1.tip", "joint_clearance changes nothing at '1.tip'"),
        ("bar_stiffness_asymmetry", "1", "bar_stiffness_asymmetry changes nothing at '1'"),
        (
            "joint_friction",
            "3.base",
            "no part is at '3.base', allowed are some of the tags of: 1.base, 1.tip",
        ),
        (
            "base_compliance",
            "1",
            "no part is at '1': what acts there acts on the whole, without a site",
        ),
        (
            "bar_geometric_nonlinearity",
            "1",
            "bar is not that of one part, allowed is the effect without a site",
        ),
    ],
)
def test_sites_that_are_none(name: str, site: str, said: str) -> None:
    effect = EVERY[name]
    with pytest.raises(ValueError, match=said):
        effect.apply(BENCH, effect.typicals, site)


def test_a_bar_has_the_hinges_it_has() -> None:
    effect = EVERY["joint_friction"]
    rig = Bar(paper.LENGTH, paper.BAR_STIFFNESS, base="pinned")
    assert effect.apply(rig, effect.typicals, "base").hinge_laws[1] == ()
    with pytest.raises(ValueError, match=r"no part is at 'tip', allowed are some of the tags of: 1\.base"):
        effect.apply(rig, effect.typicals, "tip")
