"""A cantilever whose clamp turns, as every bench in a vice has it, by the formulas of beams; and a dial not zeroed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.answer.record import Answer
from pipeline.campaign import read
from pipeline.check import check
from pipeline.inference.model import Model
from pipeline.inference.suitable import known_effects
from pipeline.selection.diagnosis import diagnose

E, LENGTH, THICK, HIGH = 210e3, 400.0, 10.0, 20.0
"""MPa and mm: flat steel on edge, pushed across (y) and along its height (z)."""
RIGIDITY = {"y": E * HIGH * THICK**3 / 12.0, "z": E * THICK * HIGH**3 / 12.0}
CLAMP = 4e-8
"""rad/(N·mm): a tenth of what the tip gives along y, 0.4 of it along z."""
LOADS = {"y": (0, 10, 20, 30, 40, 50, 40, 20, 0), "z": (0, 40, 80, 120, 160, 80)}
SIGMA = 0.002
DESCRIPTION = f"""\
schema = 1
name = "vice"

[rig]
kind = "bar"
length_mm = {LENGTH}
section = {{ kind = "rectangle", width_mm = {THICK}, height_mm = {HIGH} }}
material = {{ E_MPa = {E}, nu = 0.3 }}
base = "clamped"
tip = "free"

[noise]
y_mm = {SIGMA}
z_mm = {SIGMA}
my_mm = {SIGMA}
mz_mm = {SIGMA}
fy_N = 0.1
fz_N = 0.1

[[gauges]]
name = "my"
on = "bar"
bar = 1
station = 0.5
direction = "y"

[[gauges]]
name = "mz"
on = "bar"
bar = 1
station = 0.5
direction = "z"
"""
TEST = """
[[tests]]
id = "along_{0}"
role = "fit"
control = {{ x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }}
"""


def give(force: float, rigidity: float, a: float, clamp: float) -> float:
    """mm at a from the clamp: a cantilever under a force at its tip, and the turn of its clamp."""
    return force * a**2 * (3.0 * LENGTH - a) / (6.0 * rigidity) + clamp * force * LENGTH * a


def measured(
    folder: Path,
    clamp: float,
    thinner: float = 1.0,
    offset: float = 0.0,
    middle: bool = True,
    knock: tuple[str, int, float] = ("", 0, 0.0),
    lost: float = 0.0,
    play: float = 0.0,
    loads: dict[str, tuple[int, ...]] = LOADS,
) -> Path:
    """The folder of such a bench. thinner: share of the thickness. offset: mm that the dial along y began with. knock:
    direction and step at which the dial at the tip was knocked, and by how many mm. lost: rad by which the clamp gives
    way to any load. play: mm by which the dial at the tip along y is late where the motion turns."""
    rng = np.random.default_rng(7)
    rows = ["test,step,y_mm,z_mm,my_mm,mz_mm,fy_N,fz_N"]
    for way, steps in loads.items():
        rigidity = RIGIDITY[way] * thinner ** (3 if way == "y" else 1)
        late = np.where(np.diff(steps, prepend=0) < 0, play, 0.0)
        for step, load in enumerate(steps):
            force = load + rng.normal(0.0, 0.1)
            tip, half = (
                give(force, rigidity, a, clamp) + lost * np.sign(load) * a + rng.normal(0.0, SIGMA)
                for a in (LENGTH, LENGTH / 2.0)
            )
            tip += late[step] + offset if way == "y" else 0.0
            tip += knock[2] if (way, step) == knock[:2] else 0.0
            half_said = f"{half:.6f}" if middle else ""
            cells = (f"{tip:.6f}", "", half_said, "") if way == "y" else ("", f"{tip:.6f}", "", half_said)
            forces = (f"{load}", "") if way == "y" else ("", f"{load}")
            rows.append(",".join([f"along_{way}", str(step), *cells, *forces]))
    folder.mkdir()
    (folder / "measurements.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    text = DESCRIPTION + "".join(TEST.format(way) for way in LOADS)
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    return folder


def said(folder: Path) -> Answer:
    """The diagnosis of a bench."""
    return answered(diagnose(read(folder), Model(), known_effects(()).effects))


def test_a_clamp_that_turns_is_named(tmp_path: Path) -> None:
    found = said(measured(tmp_path / "a", CLAMP))
    assert (found.verdict, found.added) == ("identified", ("base_compliance",))
    turns = {name.rpartition(".")[2]: it.value for name, it in found.parameters.items()}
    assert turns["ry_rad_per_Nmm"] == pytest.approx(CLAMP, rel=0.1)
    assert turns["rz_rad_per_Nmm"] == pytest.approx(CLAMP, rel=0.1)


@pytest.mark.parametrize(
    "knock",
    [
        ("y", 5, 0.1),
        pytest.param(("y", 2, -0.15), marks=pytest.mark.long),
        pytest.param(("z", 2, -0.15), marks=pytest.mark.long),
        pytest.param(("z", 4, 0.3), marks=pytest.mark.long),
    ],
)
def test_one_knocked_reading_of_some_thirty_rows_changes_nothing(
    tmp_path: Path, knock: tuple[str, int, float]
) -> None:
    """It pulls the fit to itself, so that its neighbours are off too: that is neither long tails nor another sigma."""
    found = said(measured(tmp_path / "a", CLAMP, knock=knock))
    assert (found.verdict, found.added) == ("identified", ("base_compliance",))
    cells = [(it.test, it.step, it.column) for it in found.set_aside]
    assert cells == [(f"along_{knock[0]}", knock[1], f"{knock[0]}_mm")] and not found.noise


@pytest.mark.long
def test_a_dial_with_backlash_is_not_one_that_follows_late(tmp_path: Path) -> None:
    """It was set against the first motion, so that all of the backlash shows on the way back, alike at any load."""
    twice = {"y": (0, 20, 40, 50, 30, 0, 30, 50, 10, 0), "z": LOADS["z"]}
    found = said(measured(tmp_path / "a", 0.0, play=0.04, loads=twice))
    assert (found.verdict, found.added) == ("identified", ("sensor_backlash@y_mm",))


@pytest.mark.long
def test_lost_motion_of_a_clamp_is_no_noise(tmp_path: Path) -> None:
    """The clamp rocks by 60 µm at the tip as the load turns its sign: the dials are not worse than was declared, and
    nothing smooth explains it."""
    both = (0, 20, 40, 60, 40, 20, 0, -20, -40, -60, -40, -20, 0)
    found = said(
        measured(tmp_path / "a", 0.0, lost=1.5e-4, loads={"y": both, "z": tuple(4 * k for k in both)})
    )
    assert found.verdict == "unknown" and not found.noise and not found.set_aside and not found.certain


@pytest.mark.long
def test_dials_at_the_tip_alone_do_not_tell_it_from_a_thinner_bar(tmp_path: Path) -> None:
    found = said(measured(tmp_path / "a", CLAMP, middle=False))
    assert found.verdict == "ambiguous"
    assert {("base_compliance",), ("bar_section_error",)} <= {found.added, *found.alternatives}


def test_nothing_hidden_is_nothing(tmp_path: Path) -> None:
    assert said(measured(tmp_path / "a", 0.0)).verdict == "within_noise"


@pytest.mark.long
def test_a_dial_that_was_not_zeroed_is_asked_about_first(tmp_path: Path) -> None:
    """A tilt of the mounting moves the tip along y as well: it is neither named nor certain."""
    found = said(measured(tmp_path / "a", CLAMP, offset=2.37))
    assert found.verdict in ("ambiguous", "unknown") and not found.certain
    assert 'y starts at 2.37 mm: zero = "fitted"?' in found.sentences[0]
    (zero,) = found.zeros
    assert zero.column == "y" and zero.value == pytest.approx(2.37, abs=0.05)


def test_the_table_alone_says_that_a_dial_begins_far_off(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    check(measured(tmp_path / "a", CLAMP, offset=2.37))
    told = " ".join(capsys.readouterr().out.split())
    assert "y begins at 2.371 mm in along_y, by 1185 sigma, where the model expects nothing" in told
    check(measured(tmp_path / "b", CLAMP))
    assert "begins at" not in capsys.readouterr().out
