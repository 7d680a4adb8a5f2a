"""Effects and tolerances on the drives and links of a machine: closed forms, single legs, and what has none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.vjm.effects.bench import BAR, EVERY, PARALLELOGRAM
from tests.vjm.manipulator.example import (
    AXIAL,
    BENDING,
    DRIVE,
    FOOT,
    POINTS,
    beam,
    orthoglide,
    pair,
    relative,
    under,
)
from vjm.bars import Z
from vjm.effects import for_kind
from vjm.effects.actuator_compliance import ActuatorCompliance
from vjm.effects.base import Effect
from vjm.effects.link_compliance import LinkCompliance
from vjm.effects.parts import OfParts
from vjm.frames import Array
from vjm.manipulator.effects import Shown, with_effect
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest
from vjm.parts import Actuator, Elastic, Leg, elastic
from vjm.stiffness import read_stiffness
from vjm.tolerances import tolerances

OF_PARTS: dict[str, OfParts] = {it.name: it for it in EVERY.values() if isinstance(it, OfParts)}
TOLERANCES: dict[str, OfParts] = {it.name: it for it in tolerances() if isinstance(it, OfParts)}
BOTH = {**OF_PARTS, **TOLERANCES}
GIVE = 1.5e-5


def at_rest(whole: Manipulator, drawn: Manipulator | None = None) -> Array:
    """(5, 6, 6) as read, unloaded, at the postures of the machine as drawn."""
    state = under(whole, postures(drawn or whole, POINTS), np.zeros(6))
    assert state.converged.all(), state.reason
    return read_stiffness(state)


def test_they_are_found() -> None:
    assert set(OF_PARTS) == {"actuator_compliance", "link_compliance"}
    assert set(TOLERANCES) == {"drives", "links"}


@pytest.mark.parametrize("it", BOTH.values(), ids=BOTH)
def test_null_changes_nothing_and_a_typical_value_does(it: Effect) -> None:
    whole = orthoglide(pair())
    assert with_effect(whole, it, it.nulls) is whole
    assert relative(at_rest(with_effect(whole, it, it.typicals)), at_rest(whole)) > 1e-3


@pytest.mark.parametrize("it", BOTH.values(), ids=BOTH)
@pytest.mark.parametrize("rig", [BAR, PARALLELOGRAM], ids=["bar", "parallelogram"])
def test_a_rig_of_bars_is_refused(it: Effect, rig: object) -> None:
    for values in (it.nulls, it.typicals):
        with pytest.raises(ValueError, match=f"{it.name} needs a rig of kind manipulator"):
            it.apply(rig, values)  # type: ignore[type-var]
    with pytest.raises(ValueError, match=f"{it.name} needs a rig of kind manipulator"):
        it.change(BAR, it.typicals)


def test_the_give_of_a_drive_adds_to_its_own() -> None:
    """Against drives that were drawn so: 1/k + c."""
    found = with_effect(orthoglide(pair()), ActuatorCompliance(), {"mm_per_N": GIVE, "rad_per_Nmm": 0.0})
    drawn = orthoglide(pair(), drive=1.0 / (1.0 / DRIVE + GIVE))
    assert relative(at_rest(found), at_rest(drawn)) < 1e-12


def test_a_rigid_drive_begins_to_give() -> None:
    """At the isotropic posture each drive stands along one axis: the compliance there grows by c, no other does."""
    whole = rigid_drives(orthoglide(pair()))
    home = np.zeros((1, 3))

    def compliance(of: Manipulator) -> Array:
        return np.asarray(np.linalg.inv(stiffness_at_rest(of, postures(of, home)).total[0]))

    grown = with_effect(whole, ActuatorCompliance(), {"mm_per_N": GIVE, "rad_per_Nmm": 0.0})
    more = compliance(grown) - compliance(whole)
    np.testing.assert_allclose(more[:3, :3], GIVE * np.eye(3), atol=1e-7 * GIVE)
    assert np.abs(more[3:, 3:]).max() < 1e-7 * np.abs(compliance(whole)[3:, 3:]).max()


def test_drives_that_turn_give_in_rad() -> None:
    turning = Manipulator("one", (Leg("one", (Actuator("rotation", Z, 4.0e6),)),), 100.0)
    found = with_effect(turning, ActuatorCompliance(), {"mm_per_N": 1.0, "rad_per_Nmm": 2.5e-7})
    drive = found.legs[0].parts[0]
    assert isinstance(drive, Actuator) and drive.stiffness == pytest.approx(
        1.0 / (2.5e-7 + 2.5e-7), rel=1e-14
    )


def test_the_stiffness_of_the_links_is_scaled_and_no_bar() -> None:
    """Against feet that were drawn of 0.6 of their section, between the same bars."""
    whole = orthoglide(pair())
    soft = elastic(FOOT, beam(0.6 * AXIAL, *(0.6 * b for b in (BENDING, BENDING, BENDING / 1.3)), FOOT))
    legs = (
        Leg(leg.name, tuple(soft if isinstance(p, Elastic) else p for p in leg.parts)) for leg in whole.legs
    )
    drawn = replace(whole, legs=tuple(legs))
    assert relative(at_rest(with_effect(whole, LinkCompliance(), {"scale": 0.6})), at_rest(drawn)) < 1e-10


def test_tolerances_scale_what_is_given_and_leave_what_is_rigid() -> None:
    found = with_effect(orthoglide(pair()), TOLERANCES["drives"], {"scale": 0.9})
    assert relative(at_rest(found), at_rest(orthoglide(pair(), drive=0.9 * DRIVE))) < 1e-12
    rigid = rigid_drives(orthoglide(pair()))
    with pytest.raises(ValueError, match="drives changes nothing: the machine has no drives that it acts on"):
        with_effect(rigid, TOLERANCES["drives"], {"scale": 0.9})


def test_one_leg_alone() -> None:
    whole = orthoglide(pair())
    values = {"mm_per_N": GIVE, "rad_per_Nmm": 0.0}
    found = ActuatorCompliance().apply(Shown(whole), values, "y").manipulator
    assert [found.legs[k] is whole.legs[k] for k in range(3)] == [True, False, True]
    alone = found
    for name in ("x", "z"):
        alone = ActuatorCompliance().apply(Shown(alone), values, name).manipulator
    together = with_effect(whole, ActuatorCompliance(), values)
    np.testing.assert_array_equal(at_rest(alone), at_rest(together))
    with pytest.raises(ValueError, match="there is no leg 'w', allowed are x, y, z"):
        ActuatorCompliance().apply(Shown(whole), values, "w")


@pytest.mark.parametrize("name", {**for_kind("manipulator"), **for_kind("parallelogram")})
def test_they_commute_with_every_other(name: str) -> None:
    other, whole = EVERY[name], orthoglide(pair(fibre_y=6.0, fibre_z=7.75))
    for it in OF_PARTS.values():
        if it is other:
            continue
        one = with_effect(with_effect(whole, it, it.typicals), other, other.typicals)
        two = with_effect(with_effect(whole, other, other.typicals), it, it.typicals)
        assert relative(at_rest(one, whole), at_rest(two, whole)) < 1e-10


def rigid_drives(whole: Manipulator) -> Manipulator:
    """It with drives that do not give."""
    legs = (
        Leg(leg.name, tuple(replace(p, stiffness=None) if isinstance(p, Actuator) else p for p in leg.parts))
        for leg in whole.legs
    )
    return replace(whole, legs=tuple(legs))
