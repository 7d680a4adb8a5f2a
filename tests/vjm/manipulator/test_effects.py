"""Effects on manipulators: as on the bench, whose solver has parallel chains and no inner loops; exact at null."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.vjm.manipulator.example import (
    LENGTH,
    POINTS,
    WIDTH,
    orthoglide,
    pair,
    relative,
    under,
    without_load,
)
from vjm import paper
from vjm.effects import for_kind
from vjm.effects.thermal_expansion import DRIVE
from vjm.equilibrium import equilibrium
from vjm.manipulator.buckling import critical_load
from vjm.manipulator.effects import with_effect
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest
from vjm.mechanism import initial_memory
from vjm.mechanisms import parallelogram as chains
from vjm.parts import Elastic, Leg, elastic
from vjm.refined import SEGMENTS
from vjm.sensors import TrueMoment
from vjm.stiffness import read_stiffness

EFFECTS = for_kind("parallelogram")
HELD = ("x", "z", "rx", "ry", "rz")
RISE = 12.0
FIBRES = {"fibre_y": 6.0, "fibre_z": 7.75}
# Steps there and back, the bars turned by more than what friction gives before it slips: the past shows.
STEPS, SWING = (1.0, 2.0, 0.5), 0.005


def values_of(name: str) -> dict[str, float]:
    return EFFECTS[name].typicals


@pytest.mark.parametrize("name", EFFECTS)
def test_one_parallelogram_has_the_effect_as_on_the_bench(name: str) -> None:
    """Both solvers stop at 1e-12 of their scales; readings in mm, rad, N and N·mm then agree to nine digits."""
    effect, q = EFFECTS[name], np.radians(20.0)
    plain = chains.Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, q, sensors=(TrueMoment(),), **FIBRES)
    theirs = effect.apply(plain, values_of(name))
    part = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, **FIBRES)
    one = Manipulator("one", (Leg("one", (part,)),), LENGTH, sensors=(TrueMoment(),))
    ours = with_effect(one, effect, values_of(name))
    assert ours is not one
    at = postures(one, plain.unloaded_pose[None])
    drives = {DRIVE: RISE} if effect.name == "thermal_expansion" else {}
    memory, start, other = initial_memory(theirs), None, None
    for step in STEPS:
        swung = replace(plain, q=q + SWING * step).unloaded_pose
        target = swung + step * np.array([-0.02, 0.0, 0.0, 0.002, 1e-4, -0.003])
        target[1] = 60.0 * step
        expected = equilibrium(theirs, target, HELD, start=other, drives=drives, memory=memory)
        found = under(ours, at, target, HELD, heat=drives, start=start)
        assert found.converged.all(), found.reason
        assert expected.converged, expected.reason
        scale = np.array([1.0, 1.0, 1.0, 0.01, 0.01, 0.01, 100.0, 100.0, 100.0, 1e4, 1e4, 1e4])
        np.testing.assert_allclose(found.readings[0] / scale, expected.readings / scale, atol=1e-8)
        memory, other, start = expected.next_memory, expected, found


@pytest.mark.parametrize("name", [n for n in EFFECTS if EFFECTS[n].parameters])
def test_null_changes_nothing(name: str) -> None:
    whole = orthoglide(pair())
    assert with_effect(whole, EFFECTS[name], EFFECTS[name].nulls) is whole


def at_rest(whole: Manipulator, drawn: Manipulator) -> np.ndarray:
    """(5, 6, 6) as read, unloaded."""
    state = under(whole, postures(drawn, POINTS), np.zeros(6))
    assert state.converged.all(), state.reason
    return read_stiffness(state)


def test_stiffness_without_effects_is_that_at_rest() -> None:
    whole = orthoglide(pair())
    expected = stiffness_at_rest(whole, postures(whole, POINTS)).total
    assert relative(at_rest(whole, whole), expected) < 1e-9


def test_modulus_error_scales_the_bars() -> None:
    """Against bars that were drawn so; with rigid neighbours the whole scales."""
    whole = orthoglide(pair())
    softer = with_effect(whole, EFFECTS["modulus_error"], {"scale": 0.8})
    drawn = orthoglide(pair(0.8 * paper.BAR_STIFFNESS))
    expected = stiffness_at_rest(drawn, postures(drawn, POINTS)).total
    assert relative(at_rest(softer, whole), expected) < 1e-9
    stiff = orthoglide(pair(), drive=1e12, bending=1e15)
    stiff = replace(stiff, legs=tuple(replace(leg, parts=without_feet(leg)) for leg in stiff.legs))
    soft = with_effect(stiff, EFFECTS["modulus_error"], {"scale": 0.8})
    assert relative(at_rest(soft, stiff), 0.8 * at_rest(stiff, stiff)) < 1e-6


def without_feet(leg: Leg) -> tuple[object, ...]:
    """The parts with the foot's 6x6 beyond all others."""
    return tuple(replace(p, link=p.link.stiffened(1e6)) if isinstance(p, Elastic) else p for p in leg.parts)


def test_flexible_axes_are_those_of_the_description() -> None:
    whole = orthoglide(pair())
    values = {"radial_mm_per_N": 1.5e-5, "tilt_rad_per_Nmm": 1e-7}
    drawn = orthoglide(pair(radial=1.5e-5, tilt=1e-7))
    expected = stiffness_at_rest(drawn, postures(drawn, POINTS)).total
    assert relative(at_rest(with_effect(whole, EFFECTS["axis_flexibility"], values), whole), expected) < 1e-9


def test_effects_compose() -> None:
    whole = orthoglide(pair())
    one = with_effect(whole, EFFECTS["modulus_error"], {"scale": 0.8})
    both = with_effect(one, EFFECTS["modulus_error"], {"scale": 1.25})
    assert relative(at_rest(both, whole), at_rest(whole, whole)) < 1e-9


def test_a_compliant_base_is_in_series_with_the_whole() -> None:
    """Its displacement at the platform is the lever times what it gives at the base origin, once, not per leg."""
    whole = orthoglide(pair())
    effect = EFFECTS["base_compliance"]
    give = np.array([3e-5, 1e-5, 2e-5, 1e-9, 3e-9, 2e-9])
    based = with_effect(whole, effect, dict(zip((p.name for p in effect.parameters), give, strict=True)))
    found = np.linalg.inv(at_rest(based, whole)) - np.linalg.inv(at_rest(whole, whole))
    for k, (x, y, z) in enumerate(POINTS):
        lever = np.eye(6)
        lever[:3, 3:] = -np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        expected = lever @ np.diag(give) @ lever.T
        assert relative(found[k], expected) < 1e-6


def test_bars_of_wrong_length_shift_the_platform() -> None:
    """All bars longer by e in the isotropic posture: every leg pushes by e along its own axis; no force is left."""
    whole = orthoglide(pair())
    longer = with_effect(whole, EFFECTS["dimension_error"], {"length_mm": 0.1, "width_mm": 0.0})
    state = under(longer, postures(whole, POINTS[:1]), np.zeros(6))
    # Second order: the bars of the other legs turn by e / L.
    np.testing.assert_allclose(state.pose[0, :3], 0.1, rtol=0.1 / LENGTH)
    np.testing.assert_allclose(state.multipliers[0], 0.0, atol=1e-6)


def test_refined_bars_are_those_of_segments() -> None:
    """Unloaded the same 6x6; under a push that lumped bars bear without end, the legs buckle as drawn in segments."""
    whole, push = orthoglide(pair()), np.array([-1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    refined = with_effect(whole, EFFECTS["bar_geometric_nonlinearity"], {})
    assert relative(at_rest(refined, whole), at_rest(whole, whole)) < 1e-8
    at = postures(whole, POINTS[0])
    drawn = critical_load(without_load(orthoglide(pair(segments=SEGMENTS)), at), push)
    assert critical_load(without_load(refined, at), push).factor == pytest.approx(drawn.factor, rel=1e-6)
    assert not critical_load(without_load(whole, at), push, largest=2 * drawn.factor).found


def test_what_cannot_be_is_refused() -> None:
    lonely = Manipulator("spring", (Leg("spring", (elastic(0.0, paper.BAR_STIFFNESS),)),), LENGTH)
    with pytest.raises(ValueError, match="need a parallelogram, spring has none"):
        with_effect(lonely, EFFECTS["modulus_error"], {"scale": 0.8})
    with pytest.raises(ValueError, match="need a parallelogram, spring has none"):
        with_effect(lonely, EFFECTS["joint_friction"], EFFECTS["joint_friction"].typicals)
    with pytest.raises(ValueError, match="outermost fibres"):
        with_effect(orthoglide(pair()), EFFECTS["material_yield"], {"strain": 0.001})
    soft = with_effect(orthoglide(pair()), EFFECTS["modulus_error"], {"scale": 0.8})
    with pytest.raises(ValueError, match="not as drawn"):
        stiffness_at_rest(soft, postures(soft, POINTS))


def test_effects_around_a_machine_need_no_parallelogram() -> None:
    """A base on springs is in series with the machine, here one 6x6 whose platform point is the base origin."""
    lonely = Manipulator("spring", (Leg("spring", (elastic(0.0, paper.BAR_STIFFNESS),)),), LENGTH)
    give = dict.fromkeys(EFFECTS["base_compliance"].nulls, 0.0) | {"x_mm_per_N": 1e-4, "rz_rad_per_Nmm": 1e-9}
    soft = with_effect(lonely, EFFECTS["base_compliance"], give)
    at = postures(lonely, np.zeros((1, 3)))
    k = read_stiffness(under(soft, at, np.zeros(6)))[0]
    added = np.linalg.inv(k) - np.linalg.inv(paper.BAR_STIFFNESS)
    np.testing.assert_allclose(added, np.diag([1e-4, 0.0, 0.0, 0.0, 0.0, 1e-9]), atol=1e-12)
