"""Models of one report that differ beyond their band are its first lines, and a mode without its twin is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pipeline.validation.alarms import Difference, beyond, critical_alarms, path_difference
from pipeline.validation.bands import Band
from pipeline.validation.mode_alarms import deviating, missing, single, unmatched
from pipeline.validation.result import Buckling, Critical, Curve, Result
from tests.conftest import Done

BAND = Band(0.05, "share", "loads", "a drawing")


def mode(plane: str, number: int, load: float, **more: Any) -> Buckling:
    given = {
        "body": "bar",
        "model": "solid",
        "supports": "guided",
        "plane": plane,
        "mode": number,
        "load_N": load,
        "source": "solid finite elements",
    }
    known = Buckling.model_fields
    return Buckling.model_validate({k: v for k, v in given.items() if k in known} | more)


def test_the_largest_difference_beyond_the_band_is_told() -> None:
    off = [Difference("a", 0.02), Difference("b", -0.3), Difference("c", 0.06)]
    (said,) = beyond("Loads", BAND, off, "Look again.")
    assert said == "Loads: b, -30 %; the stated band is 5 %. 2 of 3 are beyond it. Look again."
    assert beyond("Loads", BAND, off[:1]) == []
    # What is no number is no agreement.
    assert len(beyond("Loads", BAND, [Difference("d", float("nan"))])) == 1


def test_a_mode_whose_twin_was_missed_is_found() -> None:
    pair = [mode(p, n, load) for n, load in ((1, 50.0), (2, 193.0), (3, 412.0)) for p in ("xy", "xz")]
    assert single(pair, "guided") == []
    # The twin of the highest mode may be the first that was not computed; of any other it was missed.
    assert single(pair[:-1], "guided") == []
    lame = [m for m in pair if (m.plane, m.mode) != ("xz", 2)]
    alone = single([*lame[:-1], mode("xz", 2, 412.0)], "guided")
    assert {(m.plane, m.load_N) for m in alone} >= {("xy", 193.0)}


def test_modes_without_a_formula_or_far_from_it() -> None:
    lost = mode("xz", 3, 299e6, mac=0.73, nearest_N=200e6, nearest="clamped, mode 3 in xz")
    (said,) = unmatched([lost, mode("xy", 1, 1e6, mac=0.99, formula_N=1.0e6)])
    assert "1 of 2 modes" in said and "(+50 %), MAC 0.73" in said
    (said,) = deviating([mode("xz", 5, 171e6, formula_N=124e6, deviation=0.38, mac=0.95, band=0.55)])
    assert "+38 %" in said and "estimated as 55 %" in said
    assert missing([mode("xy", 2, 5e6)]) == []


def critical(model: str, load: float | None, spring_at: str | None = None, **more: Any) -> Critical:
    given = {"q_deg": 0.0, "held": ["z"], "what": "in compression", "why": "", "load_N": load}
    return Critical.model_validate({**given, "model": model, "spring_at": spring_at, **more})


def test_a_model_without_a_critical_load_is_not_called_off_by_all_of_it() -> None:
    """Where springs find none there is no share to tell; those that find one are compared as ever."""
    solids = [critical("solid", 9.2e3, ratio_to_solid=1.0), critical("solid", 36e3, ratio_to_solid=3.9)]
    lost = critical("vjm", None, "distributed", searched_N=1e6)
    (said,) = critical_alarms([*solids, lost])
    assert said == (
        "Critical loads of the linkage: no critical load found by distributed springs up to 1 MN for q = 0°, z held, "
        "in compression, the solid has one at 9.2 kN."
    )
    far = critical("vjm", 10e3, "distributed", ratio_to_solid=1.087)
    said = " ".join(critical_alarms([*solids, lost, far]))
    assert "+8.7 %" in said and "100 %" not in said
    assert critical_alarms([*solids, critical("vjm", None, "tip", searched_N=1e6)]) == []


def curve(model: str, loads: list[float]) -> Curve:
    return Curve.model_validate(
        {
            "model": model,
            "q_deg": 0.0,
            "held": ["z"],
            "spring_at": "distributed",
            "branch": "buckled",
            "x_mm": [0.0, -0.1, -0.2],
            "fx_N": loads,
            "critical_N": [],
            "note": "",
        }
    )


def test_a_path_is_compared_at_the_travels_of_the_solid() -> None:
    solid, other = curve("fea", [0.0, -100.0, -200.0]), curve("frame", [0.0, -101.0, -230.0])
    (worst,) = path_difference(solid, [solid, other], "frame")
    assert worst.share == pytest.approx(0.15) and "x = -0.2 mm" in worst.what
    assert path_difference(solid, [solid], "frame") == []


CASE = """
schema = 1
name = "{name}"
title = "{name}"
source = "a drawing"
[material]
E_MPa = 210000.0
nu = 0.3
{limit}
source = "steel"
[linkage]
length_mm = {length}
width_mm = {width}
angles_deg = [0.0]
[bar]
section = {section}
[mesh]
size_mm = {size}
"""


def coarse(folder: Path, command: Any, **values: Any) -> tuple[Result, Done]:
    file = folder / "case.toml"
    file.write_text(CASE.format(**{"limit": "", **values}), encoding="utf-8")
    done = command("run", str(file), "--coarse", "--out", str(folder / "out"), cwd=folder)
    assert done.code == 0, done.err
    return Result.model_validate_json((folder / "out" / "result.json").read_bytes()), done


@pytest.mark.long
def test_modes_of_a_tube_come_in_pairs_and_loads_beyond_yield_are_marked(
    tmp_path: Path, pipeline_command: Any
) -> None:
    tube = '{ kind = "tube", outer_diameter_mm = 16.0, wall_mm = 2.0 }'
    result, done = coarse(
        tmp_path,
        pipeline_command,
        name="tube",
        limit="yield_MPa = 235.0",
        length=300.0,
        width=80.0,
        section=tube,
        size=6.0,
    )
    assert result.warnings == [] and done.err == ""
    for supports in ("free", "guided", "clamped"):
        loads = sorted(r.load_N for r in result.buckling if r.model == "solid" and r.supports == supports)
        assert len(loads) == 6
        np.testing.assert_allclose(loads[::2], loads[1::2], rtol=1e-3)
    # Area of one tube 87.96 mm²: 98 kN on both are 557 MPa.
    area = np.pi / 4.0 * (16.0**2 - 12.0**2)
    for record in result.critical:
        if record.load_N is not None:
            assert record.stress_MPa == pytest.approx(record.load_N / (2.0 * area), rel=0.03)
            assert record.beyond_yield == (record.stress_MPa > 235.0)
    assert "beyond yield" in (tmp_path / "out" / "report.md").read_text(encoding="utf-8")


@pytest.mark.long
def test_a_mesh_that_is_too_coarse_is_an_alarm_in_the_first_lines(
    tmp_path: Path, pipeline_command: Any
) -> None:
    square = '{ kind = "rectangle", width_mm = 100.0, height_mm = 100.0 }'
    result, done = coarse(
        tmp_path, pipeline_command, name="square", length=1000.0, width=400.0, section=square, size=100.0
    )
    assert result.warnings and done.err.startswith("warning: ")
    lines = (tmp_path / "out" / "report.md").read_text(encoding="utf-8").splitlines()
    assert lines.index("## Warnings") < lines.index("## Findings")
    assert all(any(said in line for line in lines) for said in result.warnings)
