"""Every table on a terminal of 80 columns, whatever the record: nothing is wider, nothing is dropped or cut."""

from __future__ import annotations

from io import StringIO
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rich.cells import cell_len
from rich.console import Console, RenderableType

from pipeline.answer.evidence import Evidence, SensorInstead
from pipeline.answer.record import Answer, Candidate, ModelError, TestChange, TestNoise
from pipeline.answer.tables.added import show as show_added
from pipeline.answer.tables.diagnosis import show as show_diagnosis
from pipeline.answer.tables.headline import headline
from pipeline.answer.value import Value
from pipeline.compare.record import ChannelError, Comparison
from pipeline.compare.record import ModelError as Compared
from pipeline.compare.record import TestError as ComparedTest
from pipeline.compare.table import headline as compare_headline
from pipeline.compare.table import page
from pipeline.effects_page import page as effect_page
from pipeline.effects_page import table as effect_table
from pipeline.manipulator.table import table_1
from pipeline.manipulator.table_console import counts
from pipeline.manipulator.table_console import show as show_table
from pipeline.plan.record import Plan, Size
from pipeline.plan.table import headline as plan_headline
from pipeline.plan.table import show as show_plan
from pipeline.terminal import WIDEST, WIDTH, blocks, folded, terminal
from vjm.effects import catalogue

SCRIPTS = "abcXYZ019_.+-/ äßéжЖ漢字測試かなカナ한글😀🔧שלוםمرحبا[]{}"
EFFECTS = (
    "joint_friction",
    "bar_geometric_nonlinearity",
    "seal_spring_of_a_very_long_name_that_somebody_gave",
)
names = st.text(SCRIPTS, min_size=1, max_size=100).map(lambda s: " ".join(s.split())).filter(bool)
short_names = st.text(SCRIPTS.replace(".", ""), min_size=1, max_size=40).map(lambda s: s.strip()).filter(bool)
sizes = st.sampled_from([0.0, 1e-13, 0.978, 1.0, 12.3, 289.0, 4533.0, 1.2e5, 3.4e12])
maybe = sizes | st.none()
roles = st.sampled_from(["fit", "holdout"])
SETTINGS = settings(max_examples=60, deadline=None, derandomize=True, database=None)

noises = st.builds(
    TestNoise,
    rms=maybe,
    chi_square_p=maybe.map(lambda p: p and min(p, 1.0)),
    lag_one_p=st.none(),
    lost=st.integers(0, 200),
)
changes = st.builds(
    TestChange,
    test=names,
    q_deg=st.just(0.0),
    role=roles,
    rows=st.integers(0, 10**5),
    before=noises,
    after=noises,
)
values = st.builds(
    Value,
    value=st.floats(-1e12, 1e12),
    std=st.floats(1e-12, 1e12) | st.none(),
    low95=st.floats(-1e12, 1e12) | st.none(),
    high95=st.floats(-1e12, 1e12) | st.none(),
    interval=st.sampled_from(["wald", "profile", "undetermined", "fixed"]),
    unit=st.sampled_from(["1", "mm", "rad/(N·mm)", "N·mm/rad³", "a unit of one's own"]),
    meaning=names,
    at_bound=st.booleans(),
)
errors = st.builds(
    ModelError,
    effects=st.lists(st.sampled_from(EFFECTS), unique=True).map(tuple),
    fit=sizes,
    holdout=maybe,
    chi_square=sizes,
    degrees=st.integers(0, 10**6),
    chi_square_p=st.none(),
    lag_one_p=st.none(),
)
candidates = st.builds(
    Candidate,
    effect=short_names,
    screen=maybe,
    fit=maybe,
    crossvalidated=maybe,
    evidence=st.none() | st.floats(-1e9, 1e9),
)
answers = st.builds(
    Answer,
    campaign=names,
    verdict=st.sampled_from(["within_noise", "identified", "ambiguous", "unknown", "nothing_tested"]),
    effects=st.just(EFFECTS),
    parameters=st.dictionaries(st.tuples(short_names, short_names).map(".".join), values, max_size=4),
    error=st.lists(errors, min_size=1, max_size=3).map(tuple),
    tests=st.lists(changes, max_size=4).map(tuple),
    candidates=st.lists(candidates, max_size=4).map(tuple),
    sentences=st.lists(names, min_size=1, max_size=3).map(tuple),
)


def console() -> Console:
    return Console(file=StringIO(), highlight=False, width=300)


def text_of(out: Console) -> str:
    assert isinstance(out.file, StringIO)
    return out.file.getvalue()


def printed(*parts: RenderableType) -> str:
    out = terminal(console())
    for part in parts:
        out.print(part)
    return text_of(out)


def squeezed(text: str) -> str:
    return "".join(text.split())


def stands(name: str, text: str) -> bool:
    """Whether a name stands in a text, folded over lines that each begin with a part of it."""
    lines = [squeezed(line) for line in text.splitlines()]
    return any(_goes_on(squeezed(name), lines[k:]) for k in range(len(lines)))


def _goes_on(rest: str, lines: list[str]) -> bool:
    for line in lines:
        at = next((k for k in range(min(len(rest), len(line)), 0, -1) if line.startswith(rest[:k])), 0)
        if not at:
            return False
        rest = rest[at:]
        if not rest:
            return True
    return False


def assert_fits(text: str) -> None:
    wide = [line for line in text.splitlines() if cell_len(line) > 80]
    assert not wide, wide
    assert "…" not in text


@SETTINGS
@given(answers, st.booleans())
def test_any_answer_fits_and_is_whole(answer: Answer, diagnosis: bool) -> None:
    out = console()
    if diagnosis:
        show_diagnosis(answer, (), False, out)
    else:
        show_added(answer, "model.toml", (), False, out)
    text = text_of(out)
    assert_fits(text)
    assert [line.rstrip() for line in text.splitlines()[:2]] == [headline(answer), ""]
    for test in answer.tests:
        assert stands(test.test, text), test.test
    for name, it in answer.parameters.items():
        effect, _, parameter = name.partition(".")
        assert stands(effect, text) and stands(parameter, text), name
        assert not it.at_bound or "at its bound" in text
        assert it.interval != "undetermined" or "not determined" in text
    for candidate in answer.candidates if diagnosis else ():
        assert stands(candidate.effect, text), candidate.effect


channel_names = st.lists(
    st.sampled_from(["x", "y", "z", "rx", "ry", "rz", "fx", "fy", "fz", "mx", "my", "mz"]) | short_names,
    min_size=1,
    max_size=20,
    unique_by=squeezed,
)
channel_errors = st.builds(
    ChannelError,
    sigmas=sizes,
    rms=sizes,
    unit=st.sampled_from(["mm", "rad", "N", "Nmm"]),
    readings=st.just(3),
)


@st.composite
def comparisons(draw: st.DrawFn) -> Comparison:
    """All models, any tests and channels."""
    channels = draw(channel_names)
    tests = tuple(
        ComparedTest(
            test=draw(names),
            q_deg=0.0,
            role=draw(roles),
            rms=draw(maybe),
            lost=draw(st.integers(0, 2)),
            channels={name: draw(channel_errors) for name in channels if draw(st.booleans())},
        )
        for _ in range(draw(st.integers(1, 3)))
    )
    every = {name: draw(channel_errors) for name in channels}
    models = tuple(
        Compared(model=key, title=key, fit=draw(maybe), tests=tests, channels=every, chi_square_p=1e-9)
        for key in ("lin", "vjm", "saved", "fea")
    )
    return Comparison(
        campaign=draw(names),
        folder="",
        kind="bar",
        tests=len(tests),
        rows=9,
        readings=9,
        shown="vjm",
        groups={},
        remarks=(draw(names),),
        models=models,
        seconds=0.0,
        versions={},
        commit="",
    )


@SETTINGS
@given(comparisons())
def test_any_comparison_fits_and_has_every_test_and_channel(result: Comparison) -> None:
    text = printed(page(result))
    assert_fits(text)
    assert text.splitlines()[0].rstrip() == compare_headline(result)
    below = text[text.index("error of each channel") :]
    for test in result.model_of("vjm").tests:
        assert stands(test.test, text) and stands(test.test, below), test.test
    for name in result.model_of("vjm").channels:
        assert heads_have(name, below), name


def heads_have(name: str, text: str) -> bool:
    """Whether every part of a folded head stands somewhere."""
    return all(piece.strip() in text for piece in folded(name, 10).split("\n"))


@st.composite
def plans(draw: st.DrawFn) -> Plan:
    """Up to thirty effects against each other."""
    effects = draw(st.lists(short_names, min_size=1, max_size=30, unique_by=squeezed))
    size = st.builds(
        Size,
        effect=st.sampled_from(effects),
        parameter=short_names,
        unit=st.sampled_from(["1", "mm/N^(2/3)", "rad/(N·mm)"]),
        typical=sizes,
        detected=maybe,
        apart=maybe,
        rival=st.sampled_from(effects),
        rho=st.floats(0.0, 1.0),
        gamma=st.just(0.0),
    )
    alike = tuple(
        tuple(0.01 * ((7 * i + 13 * j) % 101) for j in range(len(effects))) for i in range(len(effects))
    )
    return Plan(
        campaign=draw(names),
        sizes=tuple(draw(st.lists(size, max_size=4))),
        names=tuple(effects),
        alike=alike,
        next_test=None,
        unmeasured=tuple(draw(st.lists(names, max_size=2))),
        refused={draw(short_names): draw(names)},
        commit="",
        versions={},
    )


@SETTINGS
@given(plans())
def test_any_plan_fits_and_its_matrix_is_whole(plan: Plan) -> None:
    out = console()
    show_plan(plan, False, out, full=True)
    text = text_of(out)
    assert_fits(text)
    assert [line.rstrip() for line in text.splitlines()[:2]] == [plan_headline(plan), ""]
    for k, name in enumerate(plan.names):
        assert stands(f"{k + 1} {name}", text), name
    for size in plan.sizes:
        assert stands(size.parameter, text), size
    shown = sum(line.split().count(str(k + 1)) for k in range(len(plan.names)) for line in text.splitlines())
    assert shown >= len(plan.names)


@SETTINGS
@given(plans())
def test_a_plan_says_first_what_its_tests_do_not_show(plan: Plan) -> None:
    out = console()
    show_plan(plan, False, out)
    text = text_of(out)
    assert_fits(text)
    assert [line.rstrip() for line in text.splitlines()[:2]] == [plan_headline(plan), ""]
    missed = {
        s.parameter
        for s in plan.sizes
        if not all(v is not None and v <= s.typical for v in (s.detected, s.apart))
    }
    for name in missed:
        assert stands(name, text), name
    for k, name in enumerate(plan.names):
        if any(max(plan.alike[k][j], plan.alike[j][k]) >= 0.95 for j in range(len(plan.names)) if j != k):
            assert squeezed(name) in squeezed(text), name
    for name in plan.refused:
        assert squeezed(name) in squeezed(text), name


def test_the_catalogue_fits() -> None:
    known = catalogue()
    text = printed(effect_table(known), *(effect_page(effect) for effect in known.values()))
    assert_fits(text)
    for name, effect in known.items():
        assert stands(name, text) and all(stands(p.name, text) for p in effect.parameters), name


def test_the_table_of_the_paper_fits() -> None:
    out = console()
    found = table_1(points=((0.0, 0.0, 0.0),))
    show_table(found, console=out)
    text = text_of(out)
    assert_fits(text)
    assert [line.rstrip() for line in text.splitlines()[:2]] == [counts(found), ""]
    for linkage, reading in ((c.linkage, r.reading) for c in found.cells for r in found.readings):
        assert stands(linkage, text) and stands(reading, text)


@pytest.mark.parametrize(("width", "used"), [(60, WIDTH), (90, 90), (300, WIDEST)])
def test_a_terminal_is_used_as_far_as_it_goes(width: int, used: int) -> None:
    """One that is no terminal has 80 columns."""
    assert terminal(Console(width=width, force_terminal=True, file=StringIO())).width == used
    assert terminal(Console(width=width, file=StringIO())).width == WIDTH


@SETTINGS
@given(names, st.integers(2, 40))
def test_a_folded_name_is_whole_and_narrow(name: str, width: int) -> None:
    lines = folded(name, width).split("\n")
    assert squeezed("".join(lines)) == squeezed(name)
    assert max(map(cell_len, lines)) <= width


def test_a_name_is_folded_where_its_words_end() -> None:
    assert folded("bar_geometric_nonlinearity", 20) == "bar_geometric_\nnonlinearity"


@SETTINGS
@given(st.lists(st.integers(1, 30), max_size=40), st.integers(1, 80))
def test_blocks_have_every_column_once(widths: list[int], room: int) -> None:
    parts = blocks(widths, room)
    assert [k for part in parts for k in part] == list(range(len(widths)))
    assert all(len(part) == 1 or sum(widths[k] for k in part) <= room for part in parts)
    assert all(sum(widths[a.start : b.start + 1]) > room for a, b in pairwise(parts))


def test_where_a_fault_of_a_sensor_would_do_the_headline_says_so() -> None:
    """The set that needs the fault beside it is no set by itself."""
    fault = SensorInstead(
        effect="joint_friction", words="y has an offset", explains=9.0, of=9.0, beside=("modulus_error",)
    )
    left = ModelError(
        effects=(), fit=2.0, holdout=None, chi_square=4.0, degrees=9, chi_square_p=None, lag_one_p=None
    )
    answer = Answer(
        campaign="bench",
        verdict="ambiguous",
        effects=("joint_friction", "modulus_error"),
        parameters={},
        error=(left, left.model_copy(update={"effects": ("joint_friction", "modulus_error"), "fit": 1.0})),
        tests=(),
        candidates=(),
        sentences=("",),
        added=("joint_friction", "modulus_error"),
        alternatives=(("modulus_error",), ()),
        evidence=Evidence(sets=(("joint_friction", "modulus_error"),), sensors=(fault,)),
    )
    assert headline(answer) == "ambiguous: joint_friction + modulus_error or a fault of a sensor"
