"""`predict` on small virtual benches: fitted at low loads, predicted at 1.5 times; tables, files, what is refused."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline.assessment.virtual.bench import true_readings
from pipeline.campaign import Campaign, ParallelogramRig, write
from pipeline.campaign.bar_from import BarFrom
from pipeline.errors import InputError
from pipeline.inference.model import Model
from pipeline.inference.model_file import ModelFile, write_model
from pipeline.predict.asked import Asked, own_rows, read_table
from pipeline.predict.command import Asking, predict_readings
from pipeline.predict.comparison import area, numerical
from pipeline.predict.files import compensation_table
from pipeline.predict.predicting import fitted_as, fitted_to, predicted
from pipeline.predict.recording import recorded
from pipeline.predict.words import about
from pipeline.simulate import bench_rig
from pipeline.toml.complaints import BadCampaign
from tests.pipeline.inference import manipulators
from tests.pipeline.predict.bench import HIDDEN, IDS, bench, fitted, plan

BEYOND = 1.5
COLUMNS = ("x_mm", "y_mm", "z_mm", "rx_rad", "ry_rad", "rz_rad", "fx_N", "fy_N", "fz_N")
COLUMNS += ("mx_Nmm", "my_Nmm", "mz_Nmm")


def table(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def beyond(path: Path) -> tuple[Path, dict[tuple[str, int], np.ndarray]]:
    """A table of the loads at 1.5 times, by the id of the test, and what is there on the frame elements."""
    lines = [f"test,step,{','.join(COLUMNS)}"]
    truth = {}
    planned = plan(BEYOND)
    for test, found in zip(planned, true_readings(bench_rig(), planned, HIDDEN), strict=True):
        force = [by == "force" for by in test.control]
        for step, values in enumerate(test.values):
            cells = ["" if f else f"{v:.9g}" for f, v in zip(force, values, strict=True)]
            cells += [f"{v:.9g}" if f else "" for f, v in zip(force, values, strict=True)]
            lines.append(f"{test.id},{step},{','.join(cells)}")
            truth[test.id, step] = np.concatenate([found.displacement[step], found.wrench[step]])
    return table(path, "\n".join(lines) + "\n"), truth


def test_what_is_fitted_at_low_load_holds_the_truth_at_one_and_a_half_times(tmp_path: Path) -> None:
    """The truth is on finite elements without noise: it lies within the model's part of the interval, which noise
    widens to that of a reading; rows beyond the fitted loads say so."""
    path, truth = beyond(tmp_path / "at.csv")
    asked = read_table(path, bench())
    assert [test.id for test in asked.tests] == list(IDS) and not asked.own
    record = recorded(predicted(fitted(), asked))
    inside, of = 0, 0
    for row in record.rows:
        there = dict(zip(COLUMNS, truth[row.test, row.step], strict=True))
        assert row.role == "asked" and not row.lost
        for each in row.readings:
            assert each.measured is None and each.low95 < each.value < each.high95
            half = 0.5 * (each.high95 - each.low95) / 1.96
            parts = np.sqrt(each.parameters**2 + each.tolerances**2 + each.noise**2)
            assert half == pytest.approx(parts, rel=0.02)
            model = 3.0 * np.hypot(each.parameters, each.tolerances)
            inside += abs(there[each.column] - each.value) <= model + 0.1 * each.noise
            of += 1
    assert of == len(record.rows) * 6 and inside >= 0.97 * of
    loaded = next(row for row in record.rows if row.inputs.get("fx_N", 0.0) > 4500.0)
    assert any(said.startswith("fx_N") for said in loaded.beyond)
    at_rest = next(row for row in record.rows if row.test == IDS[0] and row.step == 0)
    assert not any(said.startswith("fx_N") for said in at_rest.beyond)


def test_tolerances_and_parameters_are_parted() -> None:
    """Where ry is held, the moment about it follows from the angle at which the linkage is mounted, which is open by
    its tolerance; the one about z follows from the stiffness of the bars, which was fitted."""
    record = recorded(predicted(fitted(), own_rows(bench())))
    parts = {each.column: each for each in record.columns}
    assert parts["my_Nmm"].tolerances > 100.0 * parts["my_Nmm"].parameters
    assert parts["mz_Nmm"].parameters > 3.0 * parts["mz_Nmm"].tolerances
    assert record.held_out.of == 8 * 6 and record.held_out.inside >= 0.85 * record.held_out.of
    assert {each.column for each in record.comparison} == {
        "x_mm",
        "fy_N",
        "fz_N",
        "mx_Nmm",
        "my_Nmm",
        "mz_Nmm",
    }
    assert all(each.u_val >= each.u_data and 0.0 <= (each.area or 0.0) <= 0.5 for each in record.comparison)


def test_unknown_zeros_are_no_error_of_the_model() -> None:
    """A dial off by 0.2 mm in the held-out test, said to be unknown there: as many readings lie inside as before."""
    whole = bench()
    *fit, held = whole.tests
    moved = replace(held.data, displacement=held.data.displacement + np.array([0.2, 0, 0, 0, 0, 0]))
    wrong, said = (replace(held, data=moved, zero=zero) for zero in ("nominal", "fitted"))
    before, off, after = (predicted(fitted(), Asked((*fit, test), True, {})) for test in (held, wrong, said))
    rows = before.cases.test == len(fit)
    inside = [int((it.inside & it.judged)[rows, 0].sum()) for it in (before, off, after)]
    assert inside[1] == 0 and inside[2] >= inside[0] - 1 > 5
    assert any("less the zero" in said for said in about(after))


def test_a_table_without_tests_says_control_and_posture_itself(tmp_path: Path) -> None:
    """The same loads by q_deg and filled columns as by the id of a test: the same readings, to the last bit."""
    text = (
        "q_deg,y_mm,z_mm,rx_rad,ry_rad,rz_rad,fx_N\n30,0,0,0,0,0,500\n30,0,0,0,0,0,1000\n0,0,0,0,0,0,1000\n"
    )
    asked = read_table(table(tmp_path / "own.csv", text), bench())
    assert [(test.id, test.q_deg, test.data.steps.size) for test in asked.tests] == [
        ("case 1", 30.0, 2),
        ("case 2", 0.0, 1),
    ]
    by_id = text.replace("q_deg", "test").replace("\n30", f"\n{IDS[2]}").replace("\n0,", f"\n{IDS[0]},")
    same = read_table(table(tmp_path / "id.csv", by_id), bench())
    one, other = (recorded(predicted(fitted(), it)) for it in (asked, same))
    for mine, its in zip(one.rows, other.rows, strict=True):
        assert mine.readings == its.readings and len(mine.readings) == 6


def test_numbers_of_the_rig_may_be_columns(tmp_path: Path) -> None:
    """Heavier by 200 N downwards: what the cell reads along z falls by that, where z is held."""
    head = "q_deg,x_mm,y_mm,z_mm,rx_rad,ry_rad,rz_rad"
    text = f"{head},platform_weight_N\n0,0,0,0,0,0,0,0\n0,0,0,0,0,0,0,200\n"
    record = recorded(predicted(fitted(), read_table(table(tmp_path / "heavy.csv", text), bench())))
    light, heavy = ({each.column: each.value for each in row.readings} for row in record.rows)
    assert abs(heavy["fz_N"] - light["fz_N"]) == pytest.approx(200.0, rel=1e-6)
    assert record.rows[1].values == {"platform_weight_N": 200.0}
    assert any("other values" in said for said in record.rows[1].beyond)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("q_deg,fx_N\n0,1\n", "z is a mechanism"),
        ("fx_N,z_mm\n1,0\n", "q_deg is missing"),
        ("test,fx_N\nnobody,1\n", "names 'nobody', allowed"),
        (f"test,fx_N\n{IDS[0]},1\n", "y_mm"),
        ("q_deg,z_mm,fz_N\n0,0,1\n", "are both written"),
        ("q_deg,z_m,fx_N\n0,0,1\n", "z_m"),
        ("q_deg,z_mm,fx_N\n0,0,a\n", "allowed is a number"),
        ("q_deg,z_mm,length_mm,fx_N\n0,0,200,1\n", "length_mm"),
        ("", "is empty"),
    ],
)
def test_a_bad_table_is_one_sentence(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(BadCampaign, match=said):
        read_table(table(tmp_path / "bad.csv", text), bench())


def test_a_missing_table_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="is missing"):
        read_table(tmp_path / "none.csv", bench())


def test_the_command_writes_every_reading_and_leaves_the_campaign_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("reports.prediction.PICTURES", 1)
    folder, out = tmp_path / "low", tmp_path / "out"
    write(folder, bench())
    write_model(folder / "model.toml", ModelFile(fitted().fit.model))
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    record = predict_readings(Asking(folder, out=out, json=tmp_path / "p.json", quiet=False))
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
    said = capsys.readouterr().out
    assert max(map(len, said.splitlines()[:-1])) <= 80 and "readings predicted at 32 rows" in said
    assert {"predictions.csv", "predictions.json", "history_1.png"} <= {p.name for p in out.iterdir()}
    assert (tmp_path / "p.json").read_text() == (out / "predictions.json").read_text()
    with (out / "predictions.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert (
        len(lines) == sum(len(row.readings) for row in record.rows) == record.held_out.of + record.fitted.of
    )
    assert {line["role"] for line in lines} == {"fit", "holdout"}
    assert sum(int(line["inside"]) for line in lines) == record.held_out.inside + record.fitted.inside
    with pytest.raises(InputError, match="campaign's folder"):
        predict_readings(Asking(folder, json=folder / "p.json"))
    with pytest.raises(InputError, match="is prescribed"):
        predict_readings(Asking(folder, compensation=tmp_path / "c.csv", quiet=True))


@pytest.mark.long
def test_the_correction_of_a_machine_is_its_deflection(tmp_path: Path) -> None:
    """Of the Orthoglide under a load at two points: K^-1 w to first order, and half the load half of it."""
    whole = manipulators.campaign()
    head = "at_x_mm,at_y_mm,at_z_mm,fx_N,fy_N,fz_N"
    text = f"{head}\n0,0,0,10,0,0\n0,0,0,20,0,0\n50,-40,60,0,5,0\n"
    asked = read_table(table(tmp_path / "at.csv", text), whole)
    record = recorded(predicted(fitted_to(whole, Model()), asked))
    lines = list(csv.DictReader(compensation_table(record).splitlines()))
    moved = [float(line["dx_mm"]) for line in lines]
    assert moved[1] == pytest.approx(2.0 * moved[0], rel=1e-2) and moved[0] > 0.0
    assert float(lines[2]["dy_mm"]) > 0.0 and lines[2]["at_y_mm"] == "-40.0"
    assert [each.column for each in record.rows[0].readings][:6] == list(COLUMNS[:6])


def test_the_area_metric_is_that_of_known_distributions() -> None:
    """Readings at the middle of their laws: a quarter; all at one end: a half; evenly spread: next to nothing."""
    assert area(np.full(5, 0.5)) == pytest.approx(0.25)
    assert area(np.zeros(4)) == pytest.approx(0.5)
    assert area((np.arange(100) + 0.5) / 100) == pytest.approx(0.0025, rel=1e-6)


def computed(share: float) -> Campaign:
    """The bench with a bar from a computation whose bands are this share of the tolerance of EIz, 0.02."""
    bands = {"EIz": 0.6 * 0.02 * share}, {"EIz": 0.8 * 0.02 * share}
    campaign = bench()
    rig = campaign.rig
    assert isinstance(rig, ParallelogramRig)
    bar = BarFrom(Path("bar.json"), rig.stiffness, None, rig.length, rig.width, *bands)
    return replace(campaign, rig=replace(rig, computed=bar))


def test_what_the_computation_of_a_bar_puts_in_is_u_num() -> None:
    """Of the variance that the prior of EIz puts into a prediction the share (band / tolerance)²; the rest of it is
    u_input, and u_val is what it was."""
    plain = predicted(fitted(), own_rows(bench()))
    assert not numerical(plain).any()
    whole, half = (
        predicted(fitted_as(fitted().fit, computed(share)), own_rows(computed(share))) for share in (1.0, 0.5)
    )
    posterior = whole.tangent.posterior
    place = posterior.count + [each.name for each in posterior.numbers].index("EIz")
    # A second way: what a shift of the prior's mean by one deviation does to the estimate, by the normal equations.
    shift = posterior.covariance[place]
    slopes = np.concatenate(
        [whole.tangent.found.by_free * posterior.sizes, whole.tangent.by_nominal], axis=-1
    )
    np.testing.assert_allclose(numerical(whole), np.abs(slopes @ shift), rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(numerical(half), 0.5 * numerical(whole), rtol=1e-9)
    assert numerical(whole).max() > 0.0
    before = {each.column: each for each in recorded(plain).comparison}
    for each in recorded(whole).comparison:
        assert each.u_num**2 + each.u_input**2 == pytest.approx(before[each.column].u_input ** 2, rel=1e-9)
        assert each.u_val == pytest.approx(before[each.column].u_val, rel=1e-9)
        assert each.u_num <= before[each.column].u_input
    assert any(each.u_num > 0.01 * each.u_val for each in recorded(whole).comparison)
