"""Controls that a mechanism cannot hold: the parallelogram and the pinned bar swing, and run away when pushed."""

from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import BarRig, Gauge, ParallelogramRig, read
from pipeline.campaign.control import swings
from tests.pipeline.campaign.example import BAR, TOML, complaint, laid
from vjm import paper
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stiffness import unloaded_stiffness

FREE_Z = """schema = 1
name = "hanging"
[rig]
kind = "parallelogram"
length_mm = 310.0
width_mm = 80.0
bar = { EA_N = 6.82e6, EIy_Nmm2 = 1.98e8, EIz_Nmm2 = 4.51e7, GJ_Nmm2 = 1.08e7 }
[noise]
x_mm = 0.001
fx_N = 1.0
fz_N = 1.0
[[tests]]
id = "t"
role = "fit"
q_deg = 0.0
control = { x = "displacement", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }
"""
HEAD = "test,step,x_mm,fx_N,fz_N\n"
PUSH = HEAD + "t,1,0,0.4,\nt,2,-0.01,-440,\nt,3,-0.02,-880,\n"
PULL = PUSH.replace("-", "")


CASES = {
    "pushed": (
        0.0,
        "displacement",
        PUSH,
        "line 3, test 't': the bars are pushed while z is controlled by force",
    ),
    "pulled": (0.0, "displacement", PULL, ""),
    "by force": (0.0, "force", PUSH, "z is a mechanism and runs away"),
    "only x is read": (0.0, "displacement", "test,step,x_mm\nt,1,0\nt,2,-0.01\n", "line 3, test 't'"),
    "noise is no load": (0.0, "displacement", HEAD + "t,1,0,-3.0,\nt,2,0.01,440,\n", ""),
    "never loaded": (0.0, "displacement", HEAD + "t,1,0,-0.4,\nt,2,0.0,2,\n", "nothing holds z"),
    "x keeps it from swinging": (30.0, "displacement", PUSH, ""),
    "x hardly sees it": (0.5, "displacement", PUSH, "z is a mechanism and runs away"),
    "by force at an angle": (30.0, "force", PUSH, "z is a mechanism and runs away"),
    "z pulls at an angle": (30.0, "force", HEAD + "t,1,0,0,0\nt,2,0,-100,-400\n", ""),
}


@pytest.mark.parametrize("name", CASES)
def test_free_z_is_refused_under_compression(name: str, tmp_path: Path) -> None:
    q, x, csv, said = CASES[name]
    toml = FREE_Z.replace("q_deg = 0.0", f"q_deg = {q}").replace('x = "displacement"', f'x = "{x}"')
    found = complaint(tmp_path, toml, csv)
    assert (said in found) if said else not found, found


def test_readings_count_from_where_they_were_zeroed(tmp_path: Path) -> None:
    csv = HEAD + "t,1,0,-500,\nt,2,0.01,-60,\n"
    assert "pushed" in complaint(tmp_path, FREE_Z, csv)
    zeroed = FREE_Z.replace("q_deg = 0.0", 'q_deg = 0.0\nzero = "first_row"')
    assert not complaint(tmp_path, zeroed, csv)
    # An offset that is to be found may hide tension.
    assert not complaint(tmp_path, zeroed.replace("first_row", "fitted"), PUSH)


def test_a_bar_on_a_pin_needs_a_hold(tmp_path: Path) -> None:
    loose = BAR.replace('tip = "guided"', 'tip = "free"')
    loose = loose.replace('z = "force"', 'z = "force", rx = "force", ry = "force", rz = "force"')
    csv = "test,step,x_mm,y_mm,z_mm,ry_rad,fx_N\npush,1,,0,0,0,-5\n"
    assert "the pinned bar is a mechanism and runs away" in complaint(tmp_path, loose, csv)
    assert not complaint(tmp_path, loose, csv.replace("-5", "5"))
    for key in ("z", "ry"):
        assert not complaint(tmp_path, loose.replace(f' {key} = "force"', f' {key} = "displacement"'), csv)
    assert not complaint(tmp_path, loose.replace('base = "pinned"', 'base = "clamped"'), csv)


FORCES = ("force",) * 6


@pytest.mark.parametrize(
    ("station", "direction", "loose"), [(0.5, "z", False), (0.5, "y", True), (0.0, "z", True)]
)
def test_a_gauge_holds_what_it_sees(station: float, direction: str, loose: bool) -> None:
    rig = ParallelogramRig(length=310.0, width=80.0, bar_stiffness=paper.BAR_STIFFNESS)
    gauge = Gauge("g", station, direction)
    assert swings(rig, 0.0, ("force", "force", "g", "force", "force", "force"), (gauge,)) is loose
    assert swings(rig, 0.0, FORCES, (gauge,))


@pytest.mark.parametrize("q", [-1.0, 0.0, 0.5])
def test_the_swing_costs_no_energy(q: float) -> None:
    """Against the virtual springs' own stiffness at rest: the motion is in its kernel, for both mechanisms."""
    linkage = Parallelogram(310.0, 80.0, paper.BAR_STIFFNESS, q)
    pinned = Bar(310.0, paper.BAR_STIFFNESS, base="pinned")
    rigs = [ParallelogramRig(length=310.0, width=80.0), BarRig(length=310.0, base="pinned")]
    for rig, stiffness in zip(rigs, (unloaded_stiffness(linkage), unloaded_stiffness(pinned)), strict=True):
        motion = rig.swing(q if rig.kind == "parallelogram" else 0.0)
        assert motion is not None
        # Rounding of K11, 2.2e4 N/mm, which the kernel has to cancel.
        np.testing.assert_allclose(stiffness @ motion, 0.0, atol=1e-7)
    assert BarRig(length=310.0).swing(0.0) is None


def test_the_example_is_held(tmp_path: Path) -> None:
    assert read(laid(tmp_path, TOML)).tests
