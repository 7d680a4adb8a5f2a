"""Whatever varies, copies or writes a rig whose bars were computed keeps their K_g and their bands, or refuses."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline.assessment.challenge.dirty.dirt import true_rig
from pipeline.assessment.prediction.off import drawn_off
from pipeline.assessment.virtual.known_rig import rig_of
from pipeline.campaign import BadCampaign, Campaign, ParallelogramRig, Rig, RigOfBars, read, write
from pipeline.campaign.names import COORDINATES
from pipeline.campaign.variant import value_keys, varied
from pipeline.errors import InputError
from pipeline.predict.asked import table_of
from pipeline.selection.possible_tests import planned
from pipeline.simulate import _known
from tests.pipeline.campaign.test_bar_from import CSV, LENGTH, record, written
from vjm.effects.bar_geometric_nonlinearity import BarGeometricNonlinearity
from vjm.effects.material_yield import MaterialYield
from vjm.equilibrium import equilibrium
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stiffness import loaded_stiffness

RADIUS = 6.0
"""mm, of the record: the root of K_g44 L."""
OWN = {"width_mm": 90.0, "line_weight_N_per_mm": 0.01, "platform_weight_N": 3.0, "reference_temperature_C": 21.0,
       "fibre_y_mm": 6.0, "fibre_z_mm": 7.0, "length_mm": LENGTH}  # fmt: skip
"""A value of every single number that a table of bars has."""


def known(rig: Rig) -> bool:
    """Whether a rig has the bands of the record, and its mechanism the K_g."""
    assert isinstance(rig, RigOfBars)
    it = rig.mechanism(())
    assert isinstance(it, Parallelogram)
    # As bar_geometric_nonlinearity refines its bars.
    stiffened = it.refined().bar is not None and it.refined().bar.polar_radius == pytest.approx(RADIUS)
    return bool(stiffened) and rig.computed_bands.get("EA") == pytest.approx(np.hypot(0.001, 0.03))


@pytest.fixture
def campaign(tmp_path: Path) -> Campaign:
    out = written(tmp_path)
    path = out / "campaign.toml"
    path.write_text(path.read_text().replace("# gravity = [0, 0, -1]", "gravity = [0, 0, -1] #", 1))
    return read(out)


def test_every_number_of_the_table_can_be_varied(campaign: Campaign) -> None:
    """A new key of the table comes into the tests below by itself, or this fails."""
    assert set(value_keys(campaign.rig)) == set(OWN) and known(campaign.rig)


@pytest.mark.parametrize("key", OWN)
@pytest.mark.parametrize("there", [True, False])
def test_a_value_of_its_own_keeps_what_was_computed(key: str, there: bool, campaign: Campaign) -> None:
    """With the folder of its file and without one: nothing is read again."""
    made = varied(campaign.rig, {key: OWN[key]}, campaign.folder if there else None)
    assert made is not campaign.rig and known(made) and made.keys()[key] == OWN[key]
    assert made.usual_tolerance == campaign.rig.usual_tolerance


def test_another_length_is_refused(campaign: Campaign) -> None:
    with pytest.raises(ValueError, match="a 6x6 has its length"):
        varied(campaign.rig, {"length_mm": LENGTH + 1.0}, campaign.folder)


COPIES: dict[str, Callable[[ParallelogramRig], Rig]] = {
    "placed": lambda rig: rig.placed(10.0, None)[0],
    "drawn": lambda rig: rig.drawn,
    # K_g is that of the shape of the section: another modulus leaves it.
    "dirty bench": lambda rig: true_rig(rig, np.array([1.1, 0.9, 1.05, 0.95])),
    "off its drawing": lambda rig: drawn_off(rig, 3).rig,
    "simulated": lambda rig: _known(rig.files[0].parent)[0],
    "of the campaign's folder": lambda rig: rig_of(rig.files[0].parent),
    "of the result": lambda rig: rig_of(rig.files[0]),
}


@pytest.mark.parametrize("how", COPIES)
def test_a_copy_keeps_what_was_computed(how: str, campaign: Campaign) -> None:
    assert isinstance(campaign.rig, ParallelogramRig)
    assert known(COPIES[how](campaign.rig))


def test_load_cases_and_planned_tests_keep_it(campaign: Campaign) -> None:
    header = "test,q_deg,platform_weight_N,z_mm\n"
    asked = table_of(f"{header}test-1,,2.5,0.1\n,15.0,2.5,0.1\n", "cases.csv", campaign)
    assert [test.rig.platform_weight for test in asked.tests] == [2.5, 2.5]
    assert all(known(test.rig) for test in asked.tests)
    first = campaign.tests[0]
    assert known(planned(campaign, "next", 0.0, first.control, np.zeros((3, 6)), campaign.rig, 0.0).rig)


def two_bars(tmp_path: Path, own: str, base: str = 'bar_from = "bar.json"') -> Path:
    """A campaign whose second test has a rig of its own, with a second bar beside the first one."""
    out = written(tmp_path)
    other = record(numerical_band={"K11": 0.05}, modelling_band={}, length_mm=240.0)
    other["geometric"][3][3] = 64.0 / 240.0
    (out / "other.json").write_text(json.dumps(other))
    path = out / "campaign.toml"
    control = ", ".join(f'{name} = "{"displacement" if name == "z" else "force"}"' for name in COORDINATES)
    head = 'id = "test-2"\nq_deg = 0.0\nrole = "fit"'
    more = f"\n[[tests]]\n{head}\ncontrol = {{ {control} }}\nrig = {own}\n"
    path.write_text(path.read_text().replace('bar_from = "bar.json"', base) + more)
    (out / "measurements.csv").write_text(CSV + CSV.partition("\n")[2].replace("test-1", "test-2"))
    return out


def test_tests_with_a_rig_of_their_own_are_read_and_written_with_it(tmp_path: Path) -> None:
    campaign = read(two_bars(tmp_path, "{ platform_weight_N = 2.0, gravity = [0, 0, -1] }"))
    write(tmp_path / "again", campaign)
    for it in (campaign, read(tmp_path / "again")):
        assert it.tests[1].rig.platform_weight == 2.0 and all(known(test.rig) for test in it.tests)


@pytest.mark.parametrize("base", ['bar_from = "bar.json"', 'bar_stiffness = "of the file"', "bar"])
def test_a_test_with_another_bar_keeps_that_ones(base: str, tmp_path: Path) -> None:
    """Its K_g, and the widest bands: one factor says how far the bars of all tests are off."""
    ways = {
        'bar_stiffness = "of the file"': f"bar_stiffness = {record()['stiffness']}",
        "bar": "bar = { EA_N = 5e6, EIy_Nmm2 = 3e8, EIz_Nmm2 = 8e7, GJ_Nmm2 = 5e7 }",
    }
    own = '{ bar_from = "other.json", length_mm = 240.0 }'
    campaign = read(two_bars(tmp_path, own, ways.get(base, base)))
    write(tmp_path / "again", campaign)
    for it in (campaign, read(tmp_path / "again")):
        second = it.tests[1].rig.mechanism(())
        assert isinstance(second, Parallelogram) and second.polar_radius == pytest.approx(8.0)
        assert it.computed_bands["EA"] == pytest.approx(0.05)
        assert it.tolerance["EA"] == pytest.approx(np.hypot(0.02, 0.05))
        assert "other.json" in dict(it.digests) and any("other.json adds" in said for said in it.remarks)
        assert known(it.tests[0].rig) == (base not in ways)
    assert (tmp_path / "again" / "other.json").is_file()


def test_what_no_file_can_say_is_a_sentence(campaign: Campaign, tmp_path: Path) -> None:
    assert isinstance(campaign.rig, ParallelogramRig)
    true = replace(campaign, rig=true_rig(campaign.rig, np.array([1.1, 1.0, 1.0, 1.0])))
    with pytest.raises(ValueError, match=r"its 6x6 is not that of bar.json"):
        write(tmp_path / "true", true)
    campaign.rig.files[0].unlink()
    with pytest.raises(InputError, match=r"bar.json: is missing"):
        write(tmp_path / "gone", campaign)
    assert not list(tmp_path.glob("true/*")) and not list(tmp_path.glob("gone/*"))


def test_two_bars_of_one_name_are_refused(tmp_path: Path) -> None:
    out = two_bars(tmp_path, '{ bar_from = "more/bar.json", length_mm = 240.0 }')
    (out / "more").mkdir()
    (out / "other.json").rename(out / "more" / "bar.json")
    with pytest.raises(InputError, match="allowed is a name for each"):
        write(tmp_path / "again", read(out))


def test_a_file_of_a_test_that_cannot_be_read_is_a_complaint(tmp_path: Path) -> None:
    with pytest.raises(BadCampaign, match=r"line \d+, test 'test-2', rig.bar_from: .*no.json: is missing"):
        read(two_bars(tmp_path, '{ bar_from = "no.json" }'))


@pytest.mark.parametrize("bent", [True, False])
def test_k_g_is_there_whatever_refines_the_bar(bent: bool, tmp_path: Path) -> None:
    """An axial force stiffens the twist by K_g44, whether the bar is in segments for its bending or for its yield."""
    rig = varied(read(written(tmp_path, "bar")).rig, {"fibre_y_mm": 6.0, "fibre_z_mm": 10.0}, None)
    effect = BarGeometricNonlinearity() if bent else MaterialYield()
    values = {} if bent else {"strain": 0.019}
    targets = np.zeros((2, 6))
    targets[:, 0] = 10.0, -10.0
    state = equilibrium(effect.apply(rig.mechanism(()), values), targets, ())
    pulled, pushed = loaded_stiffness(state)
    assert (pulled - pushed)[3, 3] / 20.0 == pytest.approx(RADIUS**2 / LENGTH, rel=1e-3)
