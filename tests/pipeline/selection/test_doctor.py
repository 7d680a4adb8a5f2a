"""A mistake of the table is told before any physics, and no fault of a bench or missing effect is taken for one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline import check
from pipeline.answer.of_diagnosis import answer_of, answered
from pipeline.answer.record import FoundNoise
from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import SENSORS, bench_plan
from pipeline.campaign import Campaign, Data, read, write
from pipeline.check import _examined
from pipeline.compare.models import compare_models
from pipeline.compare.table import sentence
from pipeline.discover.beyond_catalogue import with_laws
from pipeline.inference.model import Model
from pipeline.selection import doctor
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import cached_fits, diagnose
from pipeline.selection.doctor import Suspicion, suspicions
from pipeline.selection.examined import Examination
from pipeline.selection.mistakes import possible
from pipeline.simulate import bench_rig
from tests.pipeline.selection.bench import bench, creeping_gauge, cross_talk, growing_gain, with_fault
from tests.pipeline.selection.mistakes import made
from tests.pipeline.selection.strip import GIVE, Y, strip
from vjm.effects import catalogue
from vjm.work import TooMuch

FEW = ("axial_held_q+0", "lateral_q+0", "swing_q+0")
LACKS = ("modulus_error.scale", 0.93)
"""The bench has an effect missing too: a mistake is not what is left of it."""


def found(campaign: Campaign) -> tuple[Suspicion, ...]:
    return suspicions(cached_fits(campaign, Model(), catalogue()))


def words(campaign: Campaign) -> list[str]:
    return [it.mistake.words for it in found(campaign)]


WRONG = {
    "all forces are in kgf": made.over(9.80665, *made.FORCES),
    "all forces are in lbf": made.over(4.4482216, *made.FORCES),
    "all moments are in N·m": made.over(1000.0, *made.MOMENTS),
    "all displacements are in m": made.over(1000.0, "x_mm", "y_mm", "z_mm"),
    "fx_N has the wrong sign": made.over(-1.0, "fx_N"),
    "fx_N and fy_N are exchanged": made.exchanged("fx_N", "fy_N"),
    "x_mm was not zeroed: absolute positions or loads": made.shifted(30.0, "x_mm"),
    "y_mm was not zeroed: absolute positions or loads": made.shifted(30.0, "y_mm"),
    "all forces were converted to kgf the wrong way round or twice": made.over(1.0 / 9.80665, *made.FORCES),
    "q_deg is in radians": made.angles_in_radians,
    "width and height of the bars' section are exchanged": made.section_turned,
}


def test_who_checked_the_table_is_asked_about_none(tmp_path: Path) -> None:
    """What looks like a mistake is a misfit of the model then, and the description keeps that it was checked."""
    table = WRONG["all forces are in kgf"](bench(*LACKS, ids=FEW))
    asked = answered(diagnose(table, Model(), {"modulus_error": catalogue()["modulus_error"]}))
    assert asked.doctor and any("write table_checked = true" in said for said in asked.sentences)
    write(tmp_path / "bench", replace(table, table_checked=True))
    right = read(tmp_path / "bench")
    assert right.table_checked and any("table_checked" in said for said in right.remarks)
    it = answered(diagnose(right, Model(), {"modulus_error": catalogue()["modulus_error"]}))
    assert not it.doctor and it.effects == ("modulus_error",)
    assert not any("kgf" in said for said in it.sentences)
    assert not any("no unit, sign" in said for said in _examined(right))


def test_what_was_found_before_the_look_ended_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    def too_long(*_: object) -> None:
        raise TooMuch("it would take too long")

    monkeypatch.setattr(doctor, "_better_than_two", too_long)
    table = WRONG["all forces are in kgf"](bench(*LACKS, ids=FEW))
    it = answered(diagnose(table, Model(), {"modulus_error": catalogue()["modulus_error"]}))
    assert it.verdict == "unknown" and not it.doctor
    assert any("it looked as if all forces are in kgf: check that by hand" in said for said in it.not_done)


@pytest.mark.long
def test_exchanged_columns_with_empty_cells_are_told() -> None:
    """Cells that are empty in one of two columns are those of the other once they are exchanged."""

    def with_gaps(data: Data) -> Data:
        wrench = data.wrench.copy()
        wrench[2:5, 1] = np.nan
        wrench[1, 2] = np.nan
        return replace(data, wrench=wrench)

    table = WRONG["fx_N and fy_N are exchanged"](with_fault(bench(*LACKS, ids=FEW), with_gaps))
    assert "fx_N and fy_N are exchanged" in words(table)


def test_no_table_that_lacks_what_is_prescribed_is_looked_at() -> None:
    """y is prescribed and x is not read in a row: with their columns exchanged that row has no y."""

    def with_gap(data: Data) -> Data:
        displacement = data.displacement.copy()
        displacement[3, 0] = np.nan
        return replace(data, displacement=displacement)

    table = with_fault(bench(ids=("lateral_q+0",)), with_gap)
    pairs = [it.columns for it in possible(table, CRITERIA) if it.kind == "exchanged"]
    assert ("y_mm", "z_mm") in pairs and ("x_mm", "y_mm") not in pairs and ("x_mm", "z_mm") not in pairs


# Quickly on seven readings: a lost sign and a slipped decimal point in tests/cases/test_small_tables.py.
@pytest.mark.long
@pytest.mark.parametrize("mistake", WRONG)
def test_a_mistake_is_told(mistake: str) -> None:
    told = found(WRONG[mistake](bench(*LACKS)))
    assert mistake in [it.mistake.words for it in told]
    assert all(it.before > 2.5 * it.after for it in told)


@pytest.mark.long
def test_a_mistake_is_told_beside_an_effect_that_would_leave_its_bounds() -> None:
    """A platform of 20 N: to first order the line weighs less than nothing."""
    table = WRONG["all forces are in kgf"](bench("self_weight.platform_z_N", -20.0))
    assert words(table) == ["all forces are in kgf"]


@pytest.mark.parametrize(
    "path",
    [
        "",
        "modulus_error.scale",
        pytest.param("joint_clearance.play_mm", marks=pytest.mark.long),
        "base_compliance.x_mm_per_N",
    ],
)
def test_a_right_table_has_none(path: str) -> None:
    name, _, parameter = path.rpartition(".")
    typical = catalogue()[name].typicals[parameter] if name else 0.0
    assert not words(bench(path, typical))


@pytest.mark.parametrize(
    "fault",
    [creeping_gauge, *(pytest.param(it, marks=pytest.mark.long) for it in (growing_gain, cross_talk))],
)
def test_a_fault_of_a_sensor_is_no_mistake_of_the_table(fault: object) -> None:
    assert not words(with_fault(bench(*LACKS), fault))  # type: ignore[arg-type]


@pytest.mark.long
def test_friction_in_a_column_of_which_little_is_predicted_is_no_unit() -> None:
    """fz in the swing is friction alone: a factor silences it, and what is left of it small effects explain."""
    whole = bench("joint_friction.torque_Nmm", 800.0)
    few = tuple(t for t in whole.tests if t.id in ("axial_held_q+0", "swing_q+0", "swing_q+30"))
    campaign = replace(whole, tests=few)
    assert not words(campaign)


@pytest.mark.long
@pytest.mark.parametrize("path", ["sensor_lag@fx_N.keeps", "sensor_gain@fx_N.share"])
def test_a_load_cell_at_fault_is_no_unit(path: str) -> None:
    assert not words(bench(path, 0.1))


@pytest.mark.long
def test_a_sensor_that_reads_nothing_is_not_explained_by_a_factor() -> None:
    """Times a thousandth explains nothing: it only silences the column."""
    rng = np.random.default_rng(5)

    def dead(data: Data) -> Data:
        wrench = data.wrench.copy()
        wrench[:, 5] = 4000.0 * rng.standard_normal(len(wrench))
        return replace(data, wrench=wrench)

    assert not [it for it in words(with_fault(bench(), dead)) if "mz_Nmm" in it]


@pytest.mark.long
def test_nothing_is_named_before_it_is_settled() -> None:
    wrong = WRONG["all forces are in kgf"](bench(*LACKS))
    it = diagnose(wrong, Model(), catalogue())
    answer = answer_of(it)
    assert answer.verdict == "unknown" and answer.effects == () and answer.added == ()
    first = answered(it).sentences[0]
    # That fy_N alone is needs a hinge that is softer than any.
    said = "unknown: it looks as if all forces are in kgf: "
    assert first.startswith(f"{said}chi-square with the best single effect falls from ")
    assert first.endswith("Nothing is named before that is settled.")
    assert answer.doctor[0].mend.startswith("multiply fx_N, fy_N, fz_N by 9.80665 (N in kgf)")
    assert any(answer.doctor[0].mend in said for said in answered(it).sentences)
    assert "all forces are in kgf" in sentence(compare_models(wrong))
    assert any("Doctor: it looks as if all forces are in kgf" in line for line in _examined(wrong))


@pytest.mark.long
def test_a_zero_of_one_column_is_told_as_a_zero() -> None:
    wrong = WRONG["x_mm was not zeroed: absolute positions or loads"](bench(*LACKS))
    it = diagnose(wrong, Model(), catalogue())
    answer = answer_of(it)
    assert answer.zeros[0].column == "x" and answer.zeros[0].value == pytest.approx(30.0, abs=1.0)
    assert answered(it).sentences[0].startswith("unknown: x starts at 30")


def test_a_sigma_is_proposed_only_for_a_sensor_that_is_no_better(monkeypatch: pytest.MonkeyPatch) -> None:
    """With a bar of 4000 mm instead of 400 each dial seems to scatter by a millimetre."""
    noise = (FoundNoise(column="y_mm", declared=0.003, found=1.32),)
    monkeypatch.setattr(check, "examined", lambda *_: Examination((), judged=True, noise=noise))
    *_, said = _examined(bench())
    assert (
        "y_mm = 1.32 under [noise] if the sensor is no better; if it is, look at the numbers of [rig]" in said
    )


def two_in_the_hinges() -> Campaign:
    """A dial and a load cell along the swing, of hinges that rub and spring back."""
    hidden = {"joint_friction.torque_Nmm": 300.0, "joint_torsional_stiffness.stiffness_Nmm_per_rad": 2e4}
    plan = [test for test in bench_plan(12) if test.id in ("swing_q+0", "swing_q+30")]
    whole = measure("swing", bench_rig(), plan, SENSORS, hidden, 1)

    def seen(data: Data) -> Data:
        """x and y are free, the turns held; neither is read."""
        along = np.arange(6) == 2
        displacement = np.where(along, data.displacement, np.where(np.arange(6) < 2, np.nan, 0.0))
        wrench = np.where(along, data.wrench, np.where(np.arange(6) < 2, 0.0, np.nan))
        return replace(data, displacement=displacement, wrench=wrench)

    return with_fault(whole, seen)


def test_two_effects_of_which_one_has_kinks_are_no_unit() -> None:
    """A factor at the load cell silences it: no single effect explains as much, the pair all."""
    campaign = two_in_the_hinges()
    assert not words(campaign)


@pytest.mark.long
def test_a_law_that_is_the_set_by_another_name_is_no_rival_of_it() -> None:
    """A spring and friction about all hinges are two effects, and one law there: not two explanations."""
    found = with_laws(diagnose(two_in_the_hinges(), Model(), catalogue()))
    assert found.verdict == "identified"
    assert set(found.sets[0]) == {"joint_friction", "joint_torsional_stiffness"}


@pytest.mark.long
def test_a_modulus_in_gpa_is_told(tmp_path: Path) -> None:
    """Steel, its clamp turning by 5e-7 rad/(N·mm): E_MPa = 210 is a unit."""
    force = np.array([0.0, 1.0, 2.0, 4.0, 6.0, 8.0, 10.0, 5.0])
    noise = np.random.default_rng(0).normal(0.0, Y, force.size)
    y = force * (GIVE / 210e3 + 5e-7 * 250.0**2) + noise
    told = found(strip(tmp_path, 210.0, force, y))
    assert "the modulus of the bars is in GPa" in [it.mistake.words for it in told]
