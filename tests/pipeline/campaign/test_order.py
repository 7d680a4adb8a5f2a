"""Tests in an order that hangs on their names, and when each was done."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from pipeline.campaign import Campaign, read
from pipeline.campaign.order import by_name, run_order
from pipeline.campaign.writing import write
from pipeline.inference.load_cases import load_cases
from tests.pipeline.bench import bench


def named(*names: str) -> Campaign:
    whole = bench(steps=3)
    tests = tuple(replace(test, id=name) for test, name in zip(whole.tests, names, strict=False))
    return replace(whole, tests=tests)


def ids(campaign: Campaign) -> list[str]:
    return [test.id for test in campaign.tests]


def test_numbers_in_names_count_as_numbers() -> None:
    assert ids(by_name(named("t10", "t9", "t1b", "t1", "1t", "t01"))) == [
        "1t",
        "t01",
        "t1",
        "t1b",
        "t9",
        "t10",
    ]


def test_names_of_any_script_have_an_order() -> None:
    names = ("опыт 2", "試験10", "試験9", "٣", "²", "опыт 10")
    ordered = ids(by_name(named(*names)))
    assert sorted(ordered) == sorted(names)
    assert ordered.index("試験9") < ordered.index("試験10") and ordered.index("опыт 2") < ordered.index(
        "опыт 10"
    )


def test_the_run_of_each_test_stays_with_it() -> None:
    given = named("c", "a", "b")
    once = by_name(given)
    assert [given.tests[k].id for k in run_order(given.tests)] == ["c", "a", "b"]
    assert [once.tests[k].id for k in run_order(once.tests)] == ["c", "a", "b"]
    again = by_name(replace(once, tests=tuple(reversed(once.tests))))
    assert ids(again) == ids(once)
    assert [test.run for test in again.tests] == [test.run for test in once.tests]


def test_what_does_not_say_when_comes_after_what_does() -> None:
    first = by_name(named("c", "a", "b"))
    more = replace(first.tests[0], id="new", run=None)
    assert [it.id for it in (t[k] for t in [(more, *first.tests)] for k in run_order(t))] == [
        "c",
        "a",
        "b",
        "new",
    ]


def test_the_clock_follows_the_table_and_not_the_description(tmp_path: Path) -> None:
    """A drift is of the rows as they were read, however campaign.toml lists the tests."""
    given = named("c", "a", "b")
    write(tmp_path / "one", given)
    swapped = replace(by_name(given), tests=tuple(reversed(by_name(given).tests)))
    write(tmp_path / "other", swapped)
    one, other = read(tmp_path / "one"), read(tmp_path / "other")
    assert ids(other) == sorted(ids(one), reverse=True)
    texts = [(tmp_path / name / "measurements.csv").read_text() for name in ("one", "other")]
    assert texts[0] == texts[1]
    clocks = {
        name: {
            test.id: cases.rows.clock[cases.test == k].tolist() for k, test in enumerate(cases.campaign.tests)
        }
        for name, cases in (("one", load_cases(one)), ("other", load_cases(other)))
    }
    assert clocks["one"] == clocks["other"]
    assert np.array_equal(load_cases(one).rows.clock, np.linspace(0.0, 1.0, 9))
