"""Which rows stay of a test with thousands of them."""

from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import read
from pipeline.campaign.long_tests import KEPT, LONG, kept, turns

SIGMA = np.full(6, 3e-3)


def path(values: np.ndarray) -> np.ndarray:
    out = np.zeros((values.size, 6))
    out[:, 2] = values
    return out


def there_and_back(count: int) -> np.ndarray:
    return np.interp(np.linspace(0.0, 4.0, count), [0.0, 1.0, 3.0, 4.0], [0.0, 1.0, -1.0, 0.0])


def test_turns_are_those_of_the_loading_and_not_of_its_noise() -> None:
    values = there_and_back(8001) + 3e-3 * np.random.default_rng(1).normal(size=8001)
    found = turns(values, 0.1)
    assert found == pytest.approx([2000, 6000], abs=20)


def test_a_ramp_has_no_turn_and_a_wave_has_all() -> None:
    assert turns(np.linspace(5.0, 0.0, 50), 0.1) == []
    wave = np.sin(np.arange(1000) / 50.0)
    assert [round(abs(wave[k]), 3) for k in turns(wave, 0.1)] == [1.0] * 6


def test_the_ends_and_the_turns_stay_and_a_short_ramp_after_a_long_rest_is_not_lost() -> None:
    values = np.concatenate([np.zeros(12_000), np.linspace(0.0, 1.0, 400)])
    rows = kept(path(values), SIGMA)
    assert rows[0] == 0 and rows[-1] == values.size - 1 and len(rows) <= KEPT + 3
    assert np.sum(rows >= 12_000) > 0.7 * KEPT


def test_rows_are_not_chosen_by_their_noise() -> None:
    """The first row to go so far is the one whose noise points ahead: chosen so, all readings would lead the truth."""
    truth = there_and_back(15_000)
    ahead = np.sign(np.gradient(truth))
    means = []
    for seed in range(20):
        noise = 3e-3 * np.random.default_rng(seed).normal(size=truth.size)
        rows = kept(path(truth + noise), SIGMA)
        means.append(np.mean((ahead * noise)[rows]))
    assert np.mean(means) == pytest.approx(0.0, abs=3.0 * 3e-3 / np.sqrt(20 * KEPT))


def folder_of(rows: int, folder: Path) -> Path:
    (folder / "campaign.toml").write_text(
        'schema = 1\nname = "logger"\n[rig]\nkind = "bar"\nlength_mm = 310.0\n'
        "bar = { EA_N = 6.8e6, EIy_Nmm2 = 4.5e7, EIz_Nmm2 = 4.5e7, GJ_Nmm2 = 1.1e7 }\n"
        "[noise]\nz_mm = 0.01\nfz_N = 0.05\n"
        '[[tests]]\nid = "slow"\nrole = "fit"\n'
        'control = { x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }\n'
    )
    force = 20.0 * there_and_back(rows)
    lines = [f"slow,{k},{f * 310.0**3 / (3 * 4.5e7):.6f},{f:.6f}" for k, f in enumerate(force)]
    (folder / "measurements.csv").write_text("\n".join(["test,step,z_mm,fz_N", *lines]) + "\n")
    return folder


def test_a_long_test_is_thinned_when_it_is_read_and_that_is_said(tmp_path: Path) -> None:
    campaign = read(folder_of(15_004, tmp_path))
    (test,) = campaign.tests
    assert KEPT <= test.data.steps.size <= LONG
    said = next(remark for remark in campaign.remarks if "of 15004 rows" in remark)
    assert f" {test.data.steps.size} are used" in said
    assert np.all(test.data.lines == test.data.steps + 2)


def test_a_test_that_is_not_long_stays_as_it_is(tmp_path: Path) -> None:
    campaign = read(folder_of(LONG, tmp_path))
    assert campaign.tests[0].data.steps.size == LONG and not any(
        "are used" in said for said in campaign.remarks
    )
