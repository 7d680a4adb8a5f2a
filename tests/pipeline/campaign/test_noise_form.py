"""Noise that is more than a sigma: what [noise] may say of a sensor, what is refused, and that it is written again."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import BadCampaign, read, write
from pipeline.campaign.model import Noise
from tests.pipeline.campaign.example import TOML, laid

COLUMN = "fy_N"
PLACE = 7
"""Of fy_N among the channels."""


def with_noise(folder: Path, value: str) -> Path:
    """A campaign with this noise of fy_N."""
    lines = [f"{COLUMN} = {value}" if line.startswith(f"{COLUMN} ") else line for line in TOML.splitlines()]
    assert f"{COLUMN} = {value}" in lines
    return laid(folder, "\n".join(lines) + "\n")


def test_all_that_may_be_said(tmp_path: Path) -> None:
    value = "{ sigma = 0.5, of_reading = 0.002, resolution = 0.6, gain = 0.005 }"
    noise = read(with_noise(tmp_path, value)).noise
    # Rounding to a resolution is uniform.
    assert noise.sigmas[PLACE] == pytest.approx(np.hypot(0.5, 0.6 / np.sqrt(12.0)), rel=1e-15)
    assert noise.shares[PLACE] == 0.002 and noise.gains[PLACE] == 0.005
    others = np.arange(len(noise.sigmas)) != PLACE
    assert not noise.shares[others].any() and not noise.gains[others].any()


def test_a_number_is_a_sigma_alone(tmp_path: Path) -> None:
    noise = read(with_noise(tmp_path, "0.25")).noise
    assert noise.sigmas[PLACE] == 0.25 and not noise.shares.any() and not noise.gains.any()


def test_a_resolution_alone_is_enough(tmp_path: Path) -> None:
    assert read(with_noise(tmp_path, "{ resolution = 0.12 }")).noise.sigmas[PLACE] == pytest.approx(
        0.12 / 12.0**0.5
    )


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ("{ of_reading = 0.002 }", "sigma is missing, allowed is one standard deviation, or a resolution"),
        ("{ sigma = 0.5, of_reading = 0.2 }", "of_reading: is 0.2, allowed is: at most 0.1"),
        ("{ sigma = 0.5, gain = -0.1 }", "gain: is -0.1, allowed is: at least 0"),
        ("{ sigma = 0.5, share = 0.1 }", "share"),
        ("{ sigma = 0 }", "sigma: is 0"),
    ],
)
def test_what_is_wrong_is_told_with_its_line(tmp_path: Path, value: str, said: str) -> None:
    folder = with_noise(tmp_path, value)
    line = next(
        k for k, it in enumerate((folder / "campaign.toml").read_text().splitlines(), 1) if value in it
    )
    with pytest.raises(BadCampaign) as caught:
        read(folder)
    assert (
        said in str(caught.value)
        and f"line {line}" in str(caught.value)
        and "noise.fy_N" in str(caught.value)
    )


def test_it_is_written_and_read_again(tmp_path: Path) -> None:
    campaign = read(with_noise(tmp_path / "one", "{ sigma = 0.5, of_reading = 0.002, gain = 0.005 }"))
    write(tmp_path / "two", campaign)
    again = read(tmp_path / "two").noise
    for name in ("sigmas", "shares", "gains"):
        np.testing.assert_array_equal(getattr(again, name), getattr(campaign.noise, name))


def test_the_spread_grows_with_the_reading_and_its_neighbours_tell_it() -> None:
    noise = Noise(np.ones(6), np.ones(6), np.zeros(0), of_reading=np.full(12, 0.02))
    ramp = np.outer([0.0, 50.0, 100.0, 150.0, np.nan], np.ones(12))
    expected = np.hypot(1.0, 0.02 * np.array([0.0, 50.0, 100.0, 150.0, 0.0]))
    np.testing.assert_allclose(noise.spread(ramp)[:, 3], expected, rtol=1e-15)
    # A reading that is off by its own noise is not trusted the more for it.
    ramp[2] += 8.0
    assert noise.spread(ramp)[2, 0] == pytest.approx(np.hypot(1.0, 0.02 * 104.0))
    twice = noise.times(np.full(12, 2.0))
    np.testing.assert_allclose(twice.spread(ramp), 2.0 * noise.spread(ramp), rtol=1e-15)
