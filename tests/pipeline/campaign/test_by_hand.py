"""Readings that campaign.toml sets aside or keeps: read as said, written as they count, refused where they are not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pipeline.campaign import BadCampaign, read, write
from pipeline.campaign.edited import same, with_reading
from tests.pipeline.bench import bench

TEST = "lateral_q+0"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write(tmp_path / "rig", bench("modulus_error.scale", 0.95))
    return tmp_path / "rig"


def said(folder: Path, *cells: tuple[int, str, str]) -> Path:
    file = folder / "campaign.toml"
    for step, column, counts in cells:
        text = with_reading(file.read_text(encoding="utf-8"), TEST, step, column, counts)  # type: ignore[arg-type]
        file.write_text(text, encoding="utf-8")
    return folder


def test_one_that_was_read_is_no_reading_any_more_and_comes_back(folder: Path) -> None:
    before = (folder / "campaign.toml").read_text(encoding="utf-8")
    right = read(folder)
    one, other = right.tests[1], read(said(folder, (4, "x_mm", "set_aside"))).tests[1]
    assert one.id == TEST and other.set_aside == ((4, "x_mm"),)
    gone = np.isfinite(one.data.readings) & ~np.isfinite(other.data.readings)
    assert np.argwhere(gone).tolist() == [[int(np.flatnonzero(one.data.steps == 4)[0]), 0]]
    assert "by hand set aside: x_mm of lateral_q+0 step 4" in " ".join(read(folder).remarks)
    assert same(read(said(folder, (4, "x_mm", "as it is"))), right)
    assert (folder / "campaign.toml").read_text(encoding="utf-8") == before


def test_where_one_was_prescribed_nothing_of_its_step_is_compared(folder: Path) -> None:
    one, other = read(folder).tests[1].data, read(said(folder, (4, "y_mm", "set_aside"))).tests[1].data
    row = int(np.flatnonzero(one.steps == 4)[0])
    assert other.displacement[row, 1] == pytest.approx(one.displacement[[row - 1, row + 1], 1].mean())
    assert np.isnan(other.wrench[row, 1]) and np.isnan(other.gauges[row, 0])


def test_a_campaign_is_written_as_it_counts(folder: Path, tmp_path: Path) -> None:
    there = read(said(folder, (4, "x_mm", "set_aside"), (5, "y_mm", "set_aside"), (6, "fy_N", "keep")))
    write(tmp_path / "again", there)
    again = read(tmp_path / "again")
    assert same(again, there) and again.tests[1].keep == ((6, "fy_N"),)


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("set_aside = { x_mm = [400] }", "set_aside: step 400 is not in the test, its steps are 0 to 11"),
        ("keep = { x_m = [4] }", "keep: 'x_m' is no column of readings"),
        (
            "set_aside = { x_mm = [4] }\nkeep = { x_mm = [4] }",
            "keep: names x_mm of step 4, which is set aside; allowed is one of the two",
        ),
        (
            f"set_aside = {{ y_mm = {list(range(12))} }}",
            "set_aside: leaves no reading of what was prescribed, allowed is to leave the test out",
        ),
        ("set_aside = { x_mm = [-1] }", "set_aside.x_mm"),
    ],
)
def test_what_is_not_there_is_refused(folder: Path, line: str, complaint: str) -> None:
    file = folder / "campaign.toml"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace(f'id = "{TEST}"\n', f'id = "{TEST}"\n{line}\n'), encoding="utf-8")
    with pytest.raises(BadCampaign) as caught:
        read(folder)
    (it,) = caught.value.complaints
    assert f"test '{TEST}', {complaint}" in it and it.startswith(f"{file} line ")


def test_what_was_not_read_cannot_be_set_aside(folder: Path) -> None:
    table = pd.read_csv(folder / "measurements.csv")
    table.loc[(table.test == TEST) & (table.step == 4), "x_mm"] = np.nan
    table.to_csv(folder / "measurements.csv", index=False)
    with pytest.raises(BadCampaign, match="set_aside: x_mm was not read in step 4"):
        read(said(folder, (4, "x_mm", "set_aside")))
