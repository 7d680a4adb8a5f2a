"""The command plan: with measurements and before any, and what it must know of plans that cannot tell."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from pipeline.campaign import Campaign, write
from pipeline.cli import app
from pipeline.inference.model import Model
from pipeline.plan.command import LARGE, foreseen
from pipeline.plan.next import _borne
from pipeline.selection.possible_tests import menu
from tests.pipeline.selection.bench import AXIAL, bench
from vjm.effects import catalogue

MIXED = ("axial_held_q+0", "lateral_q+0")


def unmeasured(campaign: Campaign) -> Campaign:
    """Only what was prescribed."""
    tests = []
    for test in campaign.tests:
        by_force = np.array([by == "force" for by in test.control])
        d = test.data
        data = replace(
            d,
            displacement=np.where(by_force, np.nan, d.displacement),
            wrench=np.where(by_force, d.wrench, np.nan),
            gauges=np.full_like(d.gauges, np.nan),
        )
        tests.append(replace(test, data=data))
    return replace(campaign, tests=tuple(tests))


def planned(campaign: Campaign, folder: Path) -> dict[str, Any]:
    write(folder / "bench", campaign)
    ran = CliRunner().invoke(app, ["plan", str(folder / "bench"), "--json", str(folder / "plan.json")])
    assert ran.exit_code == 0, ran.output
    found: dict[str, Any] = json.loads((folder / "plan.json").read_text())
    return found


def sizes(found: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {f"{s['effect']}.{s['parameter']}": s for s in found["sizes"]}


def test_only_tests_without_readings_are_foreseen() -> None:
    whole = bench(ids=MIXED)
    same, named = foreseen(whole)
    assert named == () and all(a is b for a, b in zip(same.tests, whole.tests, strict=True))
    none = unmeasured(whole)
    half = replace(whole, tests=(whole.tests[0], *none.tests[1:]))
    assert foreseen(half)[1] == tuple(t.id for t in whole.tests[1:])


@pytest.mark.long
def test_before_and_after_measuring_the_sizes_are_the_same(tmp_path: Path) -> None:
    """Signatures are of the model, so noise in what is prescribed moves them by its own size only."""
    after = sizes(planned(bench(ids=MIXED), tmp_path / "after"))
    found = planned(unmeasured(bench(ids=MIXED)), tmp_path / "before")
    before = sizes(found)
    assert found["unmeasured"] == list(MIXED)
    for name in ("modulus_error.scale", "bar_initial_bow.bow_y_mm", "load_offset.y_mm"):
        assert before[name]["detected"] == pytest.approx(after[name]["detected"], rel=0.03), name


@pytest.mark.long
def test_axial_tests_confuse_what_gives_along_the_bars(tmp_path: Path) -> None:
    found = planned(bench(ids=AXIAL), tmp_path)
    for name in ("modulus_error.scale", "axis_flexibility.radial_mm_per_N"):
        assert sizes(found)[name]["rho"] > 0.999
        apart = sizes(found)[name]["apart"]
        assert apart is None or apart > sizes(found)[name]["typical"]
    control = found["next_test"]["control"]
    assert found["next_test"]["newly"] and control["y"] == "displacement"


def test_tests_that_the_model_cannot_bear_are_not_offered() -> None:
    """Where a campaign pushed far beyond buckling, a menu that goes as far has no equilibrium to foretell."""
    whole = bench(ids=AXIAL)
    mild = [choice for choice in menu(whole) if choice.shape.coordinate == 0]
    beyond = [
        replace(
            choice,
            test=replace(choice.test, data=replace(choice.test.data, wrench=1e3 * choice.test.data.wrench)),
        )
        for choice in mild
    ]
    kept = _borne([*mild, *beyond], whole, Model().with_effects([catalogue()[LARGE]]))
    assert kept == mild
