"""A comparison of forty postures in a screen of 24 lines, and all of it where that is asked for."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console
from typer.testing import CliRunner

from pipeline.cli import app
from pipeline.compare.record import ChannelError, Comparison, Finding, Lost, ModelError, TestError
from pipeline.compare.table import headline, page
from pipeline.terminal import WIDTH
from tests.cases.test_small_tables import DATA

LINES = 24
CHANNELS = ("x", "y", "z", "rx", "ry", "rz")


def channel(size: float) -> ChannelError:
    return ChannelError(sigmas=size, rms=0.01, unit="mm", readings=3)


def finding(k: int) -> Finding:
    told = f"x in a group with a long name: changes with the load by {k} µm more than the model says and more (9 sigma)"
    return Finding(
        group="g",
        channel="x",
        number="slope",
        value=1.0,
        std=0.1,
        unit="mm/N",
        significance=9.0,
        load="fx",
        sentence=told,
    )


def model(key: str, worst: float) -> ModelError:
    tests = tuple(
        TestError(
            test=f"log {k}",
            q_deg=0.0,
            role="fit" if k <= 32 else "holdout",
            rms=worst / k,
            lost=int(k == 5),
            channels={name: channel(worst / k) for name in CHANNELS},
        )
        for k in range(1, 41)
    )
    lost = (
        Lost(test="log 5", rows=1, of=3, step=2, reason="stop", sentence="log 5: no prediction at step 2"),
    )
    return ModelError(
        model=key,
        title=key.upper(),
        fit=worst / 5,
        holdout=worst / 9,
        chi_square_p=1e-9,
        lag_one_p=1e-9,
        lost=lost if key == "vjm" else (),
        tests=tests,
        channels={name: channel(worst / k) for k, name in enumerate(CHANNELS, 1)},
        findings=tuple(finding(k) for k in range(9)),
        headline='x is -0.00774 mm off on average: was it zeroed (zero = "fitted")? (144 sigma), and more than that',
    )


def machine() -> Comparison:
    return Comparison(
        campaign="machine 12",
        folder="",
        kind="manipulator",
        tests=40,
        rows=120,
        readings=720,
        shown="vjm",
        groups={},
        remarks=("a remark on the machine",) * 3,
        models=tuple(model(key, worst) for key, worst in (("lin", 80.0), ("vjm", 90.0), ("fea", 3.0))),
        seconds=0.0,
        versions={},
        commit="",
    )


def printed(result: Comparison, full: bool) -> str:
    out = StringIO()
    Console(file=out, width=WIDTH, highlight=False).print(page(result, full=full))
    return out.getvalue()


def test_forty_postures_are_told_in_a_screen() -> None:
    lines = printed(machine(), full=False).splitlines()
    # And the line with the next command.
    assert len(lines) < LINES, "\n".join(lines)
    assert (
        lines[0]
        == headline(machine())
        == "machine 12: VJM: 18.0 sigma, held-out tests 10.0: not within the noise"
    )
    said = "\n".join(lines)
    for part in (
        "log 1 ",
        "log 4 ",
        "36 others, at most",
        "18.0*",
        "--full",
        "3 remarks",
        "x 90.0 sigma (10.0 µm)",
    ):
        assert (part in said) is (part != "18.0*"), part
    assert "log 5 " not in said.split("* VJM")[0] and "log 5: no prediction" in said


def test_all_of_it_is_there_where_it_is_asked_for() -> None:
    said = printed(machine(), full=True)
    assert all(f"log {k} " in said for k in range(1, 41)) and said.count("a remark on the machine") == 3
    assert "18.0*" in said and "others, at most" not in said


@pytest.mark.parametrize("full", [True, False])
def test_the_option_is_one_of_the_command(full: bool, tmp_path: Path) -> None:
    folder = str(DATA / "t01_next_test_lstsq")
    done = CliRunner().invoke(app, ["compare", folder, *(["--full"] if full else [])])
    assert done.exit_code == 0 and done.output.splitlines()[0].startswith("01_next_test_lstsq: VJM")
