"""Benches with one doubt have that and nothing else, and an answer is judged by what it says of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.doubts.answers import Cells, Told
from pipeline.assessment.doubts.benches import KNOCKED, doubt_case, rig_of, table
from pipeline.assessment.doubts.kinds import BENCHES, FAR_OFF, KINDS, typed, with_lugs
from pipeline.assessment.doubts.page import page
from pipeline.assessment.doubts.trial import Trial, drawn_for, trial
from pipeline.campaign import UniformBar

SAID = Told("identified", ((),), frozenset(), (), (), (), False)
BAR = UniformBar(EA=6.8e6, EIy=2.0e8, EIz=4.5e7, GJ=1.1e7)


def test_a_bar_without_lugs_is_the_uniform_one() -> None:
    length = 310.0
    plain = with_lugs(BAR, length, 0.0)
    assert np.diag(plain) == pytest.approx(
        [
            BAR.EA / length,
            12 * BAR.EIz / length**3,
            12 * BAR.EIy / length**3,
            BAR.GJ / length,
            4 * BAR.EIy / length,
            4 * BAR.EIz / length,
        ]
    )
    assert (plain[1, 5], plain[2, 4]) == pytest.approx((-6 * BAR.EIz / length**2, 6 * BAR.EIy / length**2))


def test_lugs_make_the_ratio_of_the_papers_bar() -> None:
    """K22 K66 / K26² of Eq. 12 is 1.313, that of any uniform bar at least 4/3."""
    k = with_lugs(BAR, 310.0, 0.0155)
    assert k[1, 1] * k[5, 5] / k[1, 5] ** 2 == pytest.approx(1.313, abs=2e-3)


def test_what_is_typed_of_a_uniform_bar_is_its_section() -> None:
    rig = replace(rig_of(0), bar=None, bar_stiffness=with_lugs(BAR, rig_of(0).length, 0.0))
    again = typed(rig)
    for name in ("EA", "EIy", "EIz", "GJ"):
        assert getattr(again, name) == pytest.approx(getattr(BAR, name))


@pytest.mark.parametrize("kind", BENCHES)
def test_benches_are_the_same_but_for_the_doubt(kind: str) -> None:
    for number in (0, 1):
        it = doubt_case(number, drawn_for(kind, number))
        clear = doubt_case(number, drawn_for("right sigmas", number))
        assert (it.bench.label, it.seed) == (clear.bench.label, clear.seed)
        assert [t.id for t in it.bench.plan] == [t.id for t in clear.bench.plan]
        if BENCHES[kind].beside:
            assert it.hidden == clear.hidden
            assert bool(it.hidden) == bool(number)


def test_bars_are_off_by_as_much_as_is_said() -> None:
    near, far = (
        np.array([drawn_for(kind, n).dirt.bar - 1.0 for n in range(40)])
        for kind in ("bar within 3 %", "bar off by 10 %")
    )
    assert 0.025 < np.abs(near).max() <= 0.03
    assert np.abs(far) == pytest.approx(FAR_OFF)
    assert np.ptp(far[1::2], axis=1).max() == 0.0 < np.ptp(far[::2], axis=1).max()


def test_six_readings_are_knocked_in_rows_that_are_fitted() -> None:
    with_them, without = (table(0, drawn_for(kind, 0), "bench") for kind in ("six knocked", "right sigmas"))
    off = [
        b.data.readings - a.data.readings for a, b in zip(without[1].tests, with_them[1].tests, strict=True)
    ]
    assert len(with_them[2]) == KNOCKED == sum(int(np.count_nonzero(each)) for each in off)
    for knock in with_them[2]:
        assert with_them[1].tests[knock.test].role == "fit"
        assert off[knock.test][knock.row, knock.channel] != 0.0


def of(*sets: tuple[str, ...], verdict: str = "identified", certain: tuple[str, ...] = ()) -> Told:
    return replace(SAID, verdict=verdict, sets=sets or ((),), certain=frozenset(certain))


@pytest.mark.parametrize(
    ("kind", "right", "wrong"),
    [
        ("bar within 3 %", of((), ("modulus_error",)), of(("joint_friction",))),
        ("bar within 3 %", of(("base_compliance",), verdict="unknown"), replace(SAID, doctor=("kgf",))),
        ("bar within 3 %", SAID, of(certain=("axis_flexibility",))),
        ("bar off by 10 %", of(("modulus_error",), ("bar_section_error",)), SAID),
        ("bar off by 10 %", of(("modulus_error",)), of(("modulus_error",), ("axis_flexibility",))),
        ("bar off by 10 %", of(verdict="unknown", certain=("modulus_error",)), of(verdict="unknown")),
        ("lugged bar", of(("bar_section_error",)), of(("axis_flexibility",))),
        ("long tails", replace(SAID, tails=True, beside=("identified", ((),))), SAID),
        ("long tails", replace(SAID, tails=True), replace(SAID, tails=True, beside=("unknown", ((),)))),
        ("rounded", SAID, replace(SAID, rescaled=("x_mm",))),
        ("play, friction", SAID, replace(SAID, aside=(frozenset({(0, 0, 0)}),))),
    ],
)
def test_an_answer_is_judged(kind: str, right: Told, wrong: Told) -> None:
    assert not KINDS[kind].judged(right)
    assert KINDS[kind].judged(wrong)


def test_knocked_cells_have_to_be_found_and_no_others() -> None:
    one, other = (0, 1, 2), (0, 3, 4)
    made = frozenset({one, other})

    def judged(*aside: Cells) -> str:
        return KINDS["six knocked"].judged(replace(SAID, made=made, seen=frozenset({one}), aside=aside))

    assert not judged(frozenset({one})) and not judged(frozenset({one, (0, 1, 3)}), frozenset({other}))
    assert judged() == "1 of 1 not found, 0 good ones set aside"
    assert judged(frozenset({one}), frozenset({(1, 1, 1)})) == "0 of 1 not found, 1 good ones set aside"


@pytest.mark.long
def test_a_bench_without_anything_is_right() -> None:
    it = trial("right sigmas", 0, "", "")
    assert it.right and it.verdict == "identified" and it.sets == "nothing"


def test_the_page_counts_and_tells() -> None:
    def tried(kind: str, wrong: str = "") -> Trial:
        return Trial(kind=kind, number=3, hidden=(), verdict="unknown", wrong=wrong, commit="abc", code="d")

    text = page([tried("rounded"), tried("rounded", "sigma of x_mm changed")])
    assert "50.0 %" in text and "rounded 3: sigma of x_mm changed; unknown" in text
