"""Tables with a mistake are what somebody would have written, and the page counts what is said of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.mistaken.page import page
from pipeline.assessment.mistaken.tables import KINDS
from pipeline.assessment.mistaken.trial import NONE, Trial, benches, trial
from pipeline.campaign import Campaign
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.mistakes import possible
from tests.pipeline.selection.bench import bench


def readings(campaign: Campaign) -> np.ndarray:
    return np.vstack([test.data.readings for test in campaign.tests])


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_looked_for_undoes_it(kind: str) -> None:
    right = bench("modulus_error.scale", 0.95)
    made = KINDS[kind](right, np.random.default_rng(1))
    assert made is not None
    mended = {it.words: it for it in possible(made.table, CRITERIA)}[made.words].mended(made.table)
    off = readings(mended) - readings(right)
    # Where a column began nobody wrote down: what is mended begins at the first row of each test, with its noise.
    near = 1e-2 if kind == "not zeroed" else 1e-6
    np.testing.assert_allclose(off / (1e-12 + np.abs(readings(right)).max(axis=0)), 0.0, atol=near)
    np.testing.assert_allclose([it.q for it in mended.tests], [it.q for it in right.tests])


def test_no_mistake_is_made_where_it_would_not_show() -> None:
    silent = replace(bench(), noise=bench().noise.times(np.full(13, 1e9)))
    shown = {kind for kind, make in KINDS.items() if make(silent, np.random.default_rng(1)) is not None}
    hidden = {
        "sign of a force or moment",
        "sign of a displacement or rotation",
        "two columns exchanged",
        "not zeroed",
    }
    assert set(KINDS) - shown == hidden
    level = bench(ids=("axial_held_q+0", "lateral_q+0", "swing_q+0"))
    assert KINDS["angles in radians"](level, np.random.default_rng(1)) is None


def test_benches_are_those_of_the_kind() -> None:
    assert benches("clean", 3) == (0, 4, 8)
    assert len(benches("single", 20)) == 20


@pytest.mark.long
def test_forces_in_kgf_are_told_and_a_right_table_is_left_alone() -> None:
    wrong, right = (trial(kind, 0, "", "") for kind in ("forces in kgf", NONE))
    assert wrong.named and wrong.told == ("all forces are in kgf",)
    assert right.named and not right.told and not right.error


def test_the_page_counts_what_is_named_alone_and_among_others() -> None:
    def of(
        kind: str, made: str, told: tuple[str, ...], hidden: tuple[str, ...] = (), error: str = ""
    ) -> Trial:
        return Trial(
            kind=kind, number=0, hidden=hidden, made=made, told=told, error=error, commit="c", code="d"
        )

    text = page(
        [
            of("forces in kgf", "a", ("a",)),
            of("forces in kgf", "a", ("b", "a")),
            of("forces in kgf", "a", ("b",), ("modulus_error",)),
            of("not zeroed", "", ()),
            of(NONE, "", ()),
            of(NONE, "", ("a",), error=""),
            of(NONE, "", (), error="bench"),
        ]
    )
    assert "| forces in kgf | 2 | 2 | 1 | 1 | 0 | 0 | 0.0 |" in text
    assert "| not zeroed | 0 | 0 | 0 | 0 | 0 | 0 | – |" in text
    assert "| right | 2 | 1 | 1 | 0 | 0 | 0 | 0.0 |" in text
    assert "forces in kgf, modulus_error missing: a; told: b" in text
