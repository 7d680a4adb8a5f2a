"""Effects that are left out of the catalogue: what is hidden, what is right, and what the page counts."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from pipeline.assessment.challenge.benches import Bench, whole_plan
from pipeline.assessment.challenge.laws.size import OutOfSight, scale_of
from pipeline.assessment.left_out.__main__ import STUDY
from pipeline.assessment.left_out.benches import MU, LeftOut, Way, measured, sized
from pipeline.assessment.left_out.entries import ENTRIES
from pipeline.assessment.left_out.page import page
from pipeline.assessment.left_out.trial import Trial, is_right, trial
from pipeline.assessment.trials import kept
from pipeline.assessment.virtual.plan import SENSORS
from pipeline.discover.search import Law
from pipeline.provenance import code_digest
from pipeline.simulate import bench_rig, scaled
from vjm.effects import catalogue
from vjm.law_sites import SITE_KINDS

SPRING = list(ENTRIES).index("hinge spring")


def test_twelve_are_laws_of_places_that_there_are_and_six_are_none() -> None:
    assert {it.effect for it in ENTRIES.values()} <= set(catalogue())
    assert sum(it.a_law for it in ENTRIES.values()) == 12 and len(ENTRIES) == 18
    kinds = {kind for it in ENTRIES.values() for kind in it.kinds if not kind.startswith("column")}
    assert kinds <= set(SITE_KINDS)


def test_an_effect_is_brought_to_the_size_at_which_it_shows() -> None:
    rig = bench_rig()
    plan = tuple(scaled([test for test in whole_plan(8) if test.id == "swing_q+0"], rig, 1.0))
    scale = scale_of(Bench(rig, SENSORS, plan, "swing"), rig)
    path = "joint_torsional_stiffness.stiffness_Nmm_per_rad"
    way = Way({path: 0.0}, {path: 1e4}, {path: 0.0}, {path: 1e8})
    hidden, shown = sized(way, 30.0, scale, rig)
    assert np.linalg.norm(shown) == pytest.approx(30.0, rel=0.021) and hidden[path] > 0.0
    with pytest.raises(OutOfSight, match="shows by 30"):
        sized(Way({path: 0.0}, {}, {path: 0.0}, {path: 1e8}), 30.0, scale, rig)


def found(*groups: tuple[tuple[str, str], ...]) -> tuple[Law, ...]:
    """Laws with sites of these kinds and names, in groups."""
    made = [
        SimpleNamespace(
            group=[SimpleNamespace(site=SimpleNamespace(kind=kind, name=name)) for kind, name in group],
            site=SimpleNamespace(kind=group[0][0], name=group[0][1]),
        )
        for group in groups
    ]
    return tuple(cast(Law, each) for each in made)


def hidden(name: str) -> LeftOut:
    return LeftOut(0, name, {}, np.zeros(1), ())


def test_right_is_a_place_of_the_first_group_or_that_there_is_none() -> None:
    contact, bow = hidden("contact"), hidden("bow")
    base, along = (("base_x", "base_x"),), (("base_x", "base_x"), ("along", "along@tip"))
    assert is_right(contact, found(along), doubted=False)
    assert not is_right(contact, found(base, along), doubted=False) and not is_right(contact, (), False)
    assert is_right(bow, (), doubted=False) and is_right(bow, found(base), doubted=True)
    assert not is_right(bow, found(base), doubted=False)
    column = (("column", "column fx_N"),)
    assert is_right(bow, found(column), doubted=False)
    assert is_right(hidden("weight"), found(column), doubted=False)


def made(number: int, **more: Any) -> Trial:
    name = list(ENTRIES)[number % len(ENTRIES)]
    return Trial.model_validate({"number": number, "name": name, "commit": "c", "code": "d", **more})


def test_the_page_counts_what_it_says() -> None:
    every = [
        made(0, mu=15.0, told=2.0),
        made(
            18, mu=50.0, told=45.0, right=True, sites=(("along", "across"),), forms=("linear",), held_out=1.2
        ),
        made(3, mu=15.0, told=15.5, right=True, sites=(("along",),), forms=("power",), held_out=1.05),
        made(14, mu=15.0, right=True, sites=(("base_x",),), forms=("",), doubted=True),
        made(1, error="OutOfSight: no size"),
    ]
    text = page(every)
    assert "| place or its group right, from 50 sigmas | 95 % | 100.0 % (2.5 .. 100.0) of 1 |" in text
    assert "| place or its group right, at 15 sigmas | 80 % | 50.0 % (1.3 .. 98.7) of 2 |" in text
    assert "| the same, 15 to 40 of them | 80 % | 100.0 % (2.5 .. 100.0) of 1 |" in text
    assert "| held out as small as it should be, place right | 90 % | 50.0 % (1.3 .. 98.7) of 2 |" in text
    assert "| no place where there is none | always | 100.0 % (2.5 .. 100.0) of 1 |" in text
    assert "| 18 | axis, radial | 50 | 45 | along (+1) linear | yes | 1.20 | 0 |" in text
    assert "base_x, doubted" in text and "OutOfSight: no size" in text
    assert all(len(line) <= 120 for line in text.splitlines() if not line.startswith("|"))


def test_a_study_goes_on_from_what_is_kept(tmp_path: Path) -> None:
    """Of the trials of one round all but the first are there already."""
    code = code_digest()
    store = tmp_path / "trials.jsonl"
    count = len(MU) * len(ENTRIES)
    store.write_text(
        "".join(made(k, code=code).model_dump_json() + "\n" for k in range(1, count)), encoding="utf-8"
    )
    study = replace(STUDY, trial=lambda number, name, *_: made(number, code=code, mu=15.0))
    study.run(1, 1, store, tmp_path)
    assert len(kept(store, Trial)) == count and (tmp_path / "left_out.md").is_file()


@pytest.mark.long
def test_a_spring_of_the_hinges_is_found_there_without_its_name() -> None:
    number = SPRING + len(ENTRIES)
    it, campaign = measured(number)
    assert it.mu == pytest.approx(50.0, rel=0.03) and len(campaign.tests) > 3
    done = trial(number, it.name, "", "")
    assert not done.error and done.right and done.told > 30.0
    assert "joint_torsional_stiffness" not in done.effects
