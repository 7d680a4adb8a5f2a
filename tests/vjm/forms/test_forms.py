"""Every form: its columns are what its law does, its tangent the derivative of its force, its energy the work."""

from itertools import pairwise

import numpy as np
import pytest

from vjm.forms import forms
from vjm.forms.base import Form
from vjm.forms.curve import LEAST_SLOPE
from vjm.frames import Array
from vjm.laws import Law

WAY = np.concatenate([np.linspace(0.0, 1.0, 15), np.linspace(0.9, -0.9, 25), np.linspace(-0.8, 0.6, 12)])[1:]
FIRST = np.array([0, 30, WAY.size])
CASES = [(name, place) for name, form in forms().items() for place in form.places]


def numbers(form: Form, largest: float) -> tuple[Array, Array]:
    """Amplitudes and shapes with which it is stable everywhere."""
    amplitudes = np.array([0.7 + 0.3 * k for k in range(len(form.amplitudes))])
    shapes = np.asarray(form.starts(largest)[-1])
    if form.name in ("square", "linear+square", "square+cubic", "linear+periodic", "linear+constant"):
        amplitudes[0] = 40.0 * max(1.0, largest)
    return amplitudes, shapes


def ways(largest: float) -> tuple[Array, np.ndarray]:
    return largest * WAY, FIRST


def axial_loads(form: Form, x: Array) -> Array | None:
    """Loads of the bar beside a law that goes with them, other than in proportion to its coordinate."""
    return 40.0 + 60.0 * np.cos(np.arange(x.size)) if form.loaded else None


def followed(law: Law, strains: Array, first: np.ndarray, axial: Array | None = None) -> tuple[Array, Array]:
    """Forces and tangents along strains of tests that begin relaxed."""
    forces, tangents = np.zeros(strains.size), np.zeros(strains.size)
    for begin, end in pairwise(first.tolist()):
        memory = law.initial_memory
        for row in range(begin, end):
            answer = law.respond(strains[row : row + 1], memory)
            forces[row], tangents[row], memory = answer.force[0], answer.tangent[0, 0], answer.memory.copy()
            if axial is not None:
                memory[0] = abs(axial[row])
    return forces, tangents


@pytest.mark.parametrize(("name", "place"), CASES)
@pytest.mark.parametrize("largest", [0.02, 3000.0])
def test_columns_are_what_the_law_does(name: str, place: str, largest: float) -> None:
    form = forms()[name]
    x, first = ways(largest)
    amplitudes, shapes = numbers(form, largest)
    if name == "gap":
        pytest.skip("in the mechanism it has a centring spring: see the test of its own")
    axial = axial_loads(form, x)
    shapes = form.under(shapes, 80.0)
    y = form.columns(x, first, shapes, axial) @ amplitudes
    law = form.law(amplitudes, shapes, place == "series")
    if place == "parallel":
        assert followed(law, x, first, axial)[0] == pytest.approx(y, rel=1e-9, abs=1e-9 * np.abs(y).max())
        return
    loads, _ = followed(law, y, first, axial)
    assert loads == pytest.approx(x, rel=1e-6, abs=1e-7 * largest)


@pytest.mark.parametrize(("name", "place"), CASES)
def test_the_tangent_is_the_derivative_of_the_force(name: str, place: str) -> None:
    form = forms()[name]
    amplitudes, shapes = numbers(form, 1.0)
    law = form.law(amplitudes, shapes, place == "series")
    strains = np.array([[-0.37], [-0.11], [0.013], [0.23], [0.41]])
    if place == "series":
        y = np.abs(form.columns(np.array([1.0]), np.array([0, 1]), shapes) @ amplitudes)[0]
        strains = strains * y
    memory = np.broadcast_to(law.initial_memory, (len(strains), law.initial_memory.size)).copy()
    if form.loaded:
        memory[:, 0] = 1.0
    step = 1e-6 * np.abs(strains).max()
    up, down = law.respond(strains + step, memory), law.respond(strains - step, memory)
    here = law.respond(strains, memory)
    slope = (up.force - down.force)[:, 0] / (2.0 * step)
    assert here.tangent[:, 0, 0] == pytest.approx(slope, rel=2e-4, abs=1e-6 * np.abs(slope).max())
    if not law.initial_memory.size:
        work = (up.energy - down.energy) / (2.0 * step)
        assert here.force[:, 0] == pytest.approx(work, rel=1e-4, abs=1e-6 * np.abs(work).max())


@pytest.mark.parametrize("name", [name for name, form in forms().items() if form.memory])
def test_friction_takes_work_over_a_closed_loop(name: str) -> None:
    form = forms()[name]
    turns = np.sin(np.linspace(0.0, 6.0 * np.pi, 600))
    amplitudes, shapes = numbers(form, 1.0)
    x, first = turns, np.array([0, turns.size])
    y = form.columns(x, first, shapes, np.ones(x.size)) @ amplitudes
    if form.places == ("series",):
        x, y = y, x
    # The last turn, begun and ended at zero.
    last = slice(400, 600)
    work = np.trapezoid(y[last], x[last])
    assert work > 0.0


@pytest.mark.parametrize("name", list(forms()))
def test_units_and_names_go_together(name: str) -> None:
    form = forms()[name]
    names = [q.identifier("N·mm", "rad") for q in form.quantities]
    assert len(set(names)) == len(names)
    assert all(q.unit("N·mm", "rad") for q in form.quantities)
    assert set(form.fixed) <= {q.name for q in form.shapes}


@pytest.mark.parametrize("name", list(forms()))
def test_a_fit_begins_with_a_number_for_every_shape_and_inside_its_bounds(name: str) -> None:
    form = forms()[name]
    low, high = form.bounds(3.0)
    free = np.array([q.name not in form.fixed for q in form.shapes], dtype=bool)
    for start in form.starts(3.0):
        assert start.shape == low.shape == high.shape == (len(form.shapes),)
        assert np.all((low <= start) & (start <= high) | ~free)


def test_a_gap_has_its_free_travel() -> None:
    form = forms()["gap"]
    x = np.array([-100.0, -1.0, 1.0, 100.0])
    y = form.columns(x, np.array([0, 4]), np.array([0.5])) @ np.array([0.02, 0.0])
    assert y == pytest.approx([-0.02, -0.02, 0.02, 0.02])
    law = form.law(np.array([0.02, 1e-4]), np.array([0.5]), series=True)
    assert law.respond(np.array([[0.03], [-0.03]]), np.zeros((2, 0))).force[:, 0] == pytest.approx(
        [100.6, -100.6]
    )


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_landing_in_series_is_never_rigid(side: float) -> None:
    form = forms()["step"]
    x = np.linspace(-3.0, 3.0, 601)
    y = form.columns(x, np.array([0, x.size]), np.array([0.5, 0.1, side])) @ np.array([2.0, 0.0])
    slopes = np.diff(y) / np.diff(x)
    flat = x[:-1][np.argmin(slopes)]
    assert flat == pytest.approx(0.5 * side, abs=0.02)
    assert LEAST_SLOPE * 2.0 < np.min(slopes) < 1.1 * LEAST_SLOPE * 2.0
    assert np.max(slopes) == pytest.approx(2.0)


def test_names_of_units() -> None:
    cubic = forms()["cubic"].amplitudes[0]
    assert cubic.unit("N·mm", "rad") == "N·mm/rad³"
    assert cubic.identifier("N·mm", "rad") == "cubic_Nmm_per_rad3"
    assert cubic.unit("rad", "N·mm") == "rad/(N·mm)³"


def test_a_compliance_that_would_fall_goes_on_straight() -> None:
    """y = k x + s x² with s below zero has its vertex at -k / 2 s."""
    form = forms()["linear+square"]
    law = form.law(np.array([2.0, -0.01]), np.zeros(0), True)
    end = (1.0 - LEAST_SLOPE) * 100.0
    loads = np.array([-50.0, 30.0, end, 300.0, 1e4])
    slope = 2.0 * LEAST_SLOPE
    at_end = 2.0 * end - 0.01 * end**2
    y = np.where(loads > end, at_end + slope * (loads - end), 2.0 * loads - 0.01 * loads**2)
    answer = law.respond(y[:, None], law.initial_memory)
    assert answer.force[:, 0] == pytest.approx(loads, rel=1e-9)
    assert answer.tangent[-1, 0, 0] == pytest.approx(1.0 / slope)
    step = 1e-4
    work = [law.respond(y[:, None] + d, law.initial_memory).energy for d in (-step, step)]
    assert (work[1] - work[0]) / (2.0 * step) == pytest.approx(loads, rel=1e-6)


def test_a_compliance_that_falls_from_no_load_on_has_its_end_there() -> None:
    """Two slopes of unlike signs: the search for the end came never nearer than half of nothing, and did not stop."""
    it: Law = forms()["two_slopes"].law(np.array([-1e-6, 2e-6]), np.zeros(0), series=True)
    assert it.give(np.array([-10.0, 0.0])) == pytest.approx([-2e-5, 0.0])
    rising = it.respond(np.array([[-1e-5]]), np.zeros((1, 0)))
    assert rising.force[0] == pytest.approx(-5.0) and rising.tangent[0, 0, 0] == pytest.approx(5e5)


def test_friction_of_iwan_is_a_parabola_and_masing_comes_back() -> None:
    """W. D. Iwan, J. Appl. Mech. 33 (1966) 893-900: limits spread evenly from zero on springs alike make
    y = T (2 x/r - (x/r)²), and a way back of twice that over half of it (G. Masing, 1926)."""
    reach, limit = 0.3, 7.0
    there = np.linspace(0.0, 1.2, 121)
    back = there[-1] - np.linspace(0.0, 2.0, 201)
    x = reach * np.concatenate([there, back[1:]])
    y = limit * forms()["iwan"].columns(x, np.array([0, x.size]), np.array([reach]))[:, 0]

    def first(share: Array) -> Array:
        share = np.minimum(share, 1.0)
        return np.asarray(limit * (2.0 * share - share**2))

    # A polygon of twelve sides leaves half of (1/12)² of the parabola, and its last corner is half a side early.
    assert np.abs(y[:121] - first(there)).max() < limit / 144.0
    assert np.abs(y[121:] - (limit - 2.0 * first((there[-1] - back[1:]) / 2.0))).max() < 2.0 * limit / 144.0
    assert y[-1] == pytest.approx(-limit)


def test_a_table_rises_from_knot_to_knot_and_goes_on() -> None:
    rises, far = np.array([1.0, 0.0, 2.0, 4.0, 0.5, 0.5, 1.0, 3.0]), 20.0
    form = forms()["table"]
    x = far * np.array([0.0, 0.1, 0.3, 0.6, 0.8, 1.0, 1.5, -0.1, -0.3, -0.6, -1.0, -1.2])
    y = np.array([0.0, 1.0, 1.0, 3.0, 5.0, 7.0, 12.0, -0.5, -1.0, -2.0, -5.0, -6.5])
    assert form.columns(x, np.array([0, x.size]), np.array([far])) @ rises == pytest.approx(y)
    spring = form.law(rises, np.array([far]), series=False)
    answer = spring.respond(x[:, None], np.zeros((x.size, 0)))
    assert answer.force[:, 0] == pytest.approx(y)
    # Areas below the polygon, from zero on either side.
    area = far * np.array([0.0, 0.05, 0.25, 0.85, 1.65, 2.85, 7.6, 0.025, 0.175, 0.625, 2.025, 3.175])
    assert answer.energy == pytest.approx(area)


HELD: dict[str, tuple[list[float], list[float]]] = {
    "two_slopes": ([], []),
    "two_level": ([0.2, 0.2], [0.2]),
    "power": ([1.0, 1.0], []),
}
"""Shapes of a form that holds another, and of the other, at which both are one."""


def test_a_form_that_holds_another_is_that_one_at_some_of_its_numbers() -> None:
    assert set(HELD) == {name for name, form in forms().items() if form.holds}
    x, first = ways(1.0)
    for name, (shapes, others) in HELD.items():
        form = forms()[name]
        columns = form.columns(x, first, np.array(shapes))
        for other in form.holds:
            wanted = forms()[other].columns(x, first, np.array(others))
            found = columns @ np.linalg.lstsq(columns, wanted, rcond=None)[0]
            assert found == pytest.approx(wanted, abs=1e-12)
