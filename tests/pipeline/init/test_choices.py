"""A table of somebody's bench becomes a campaign by answers alone, and its readings arrive in N and mm."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import read
from pipeline.errors import InputError
from pipeline.init.choices import Choices, Column, Run, asked_of, filled, questions_of
from pipeline.init.found import looked

TABLE = """Kraft [kN];Weg [um];Zeit [s];Bemerkung
0,0;0;0;an
0,1;12;1;
0,2;25;2;
0,1;13;3;ab
"""
FREE = dict.fromkeys(("x", "y", "z", "rx", "ry", "rz"), "force")
RUN = Run("push", None, "fit", FREE)
RIG = {
    "length_mm": 310.0,
    "bar.EA_N": 6.82e6,
    "bar.EIy_Nmm2": 1.98e8,
    "bar.EIz_Nmm2": 4.51e7,
    "bar.GJ_Nmm2": 1.08e7,
}
COLUMNS = {
    "Kraft [kN]": Column("fx", -1, ""),
    "Weg [um]": Column("x", 1, ""),
    "Bemerkung": Column("ignore", 1, ""),
}


def made(folder: Path, **changed: object) -> Path:
    file = folder / "own.csv"
    file.write_text(TABLE, encoding="utf-8")
    answers = {
        "name": "own",
        "kind": "bar",
        "rig": RIG,
        "columns": COLUMNS,
        "tests": (RUN,),
        **changed,
    }
    (folder / "campaign.toml").write_text(
        filled(file.name, looked(file), Choices(**answers)), encoding="utf-8"
    )  # type: ignore[arg-type]
    return folder


def test_readings_arrive_in_newtons_and_millimetres_with_their_sign(tmp_path: Path) -> None:
    (test,) = read(made(tmp_path)).tests
    assert (test.id, test.role, test.control) == ("push", "fit", ("force",) * 6)
    np.testing.assert_allclose(test.data.wrench[:, 0], [0.0, -100.0, -200.0, -100.0])
    np.testing.assert_allclose(test.data.displacement[:, 0], [0.0, 0.012, 0.025, 0.013])
    text = (tmp_path / "campaign.toml").read_text(encoding="utf-8")
    assert '"?"' not in text.replace('# "?"', "") and "# one bar along x" in text


def test_only_what_can_be_is_asked(tmp_path: Path) -> None:
    (tmp_path / "own.csv").write_text(TABLE, encoding="utf-8")
    force, way, time, remark = asked_of(looked(tmp_path / "own.csv"))
    assert (
        force.choices == ("fx", "fy", "fz") and way.choices == ("x", "y", "z") and time.choices == ("time",)
    )
    assert (force.unit, way.unit) == ("kN", "um") and len(remark.choices) > 12 and not force.known
    assert questions_of("bar") == tuple(RIG)


def test_every_test_has_its_posture_and_its_role(tmp_path: Path) -> None:
    runs = (replace(RUN, posture=30.0), Run("back", -30.0, "holdout", {**FREE, "z": "displacement"}))
    made(tmp_path, kind="parallelogram", rig={**RIG, "width_mm": 80.0}, tests=runs)
    tests = tomllib.loads((tmp_path / "campaign.toml").read_text(encoding="utf-8"))["tests"]
    assert [(it["id"], it["q_deg"], it["role"]) for it in tests] == [
        ("push", 30.0, "fit"),
        ("back", -30.0, "holdout"),
    ]
    assert tests[1]["control"]["z"] == "displacement"


def test_an_answer_that_cannot_be_is_the_complaint_of_reading(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="length_mm"):
        read(made(tmp_path, rig={**RIG, "length_mm": -1.0}))
    with pytest.raises(InputError, match="Weg"):
        read(made(tmp_path, columns={**COLUMNS, "Weg [um]": Column("fy", 1, "")}))
