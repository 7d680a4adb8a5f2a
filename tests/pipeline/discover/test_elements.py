"""What a law at a site would do to the readings: against models that have the law, predicted again."""

from dataclasses import replace

import numpy as np
import pytest

from pipeline.discover.elements import elements
from pipeline.inference.fit import unfitted
from pipeline.inference.model import Model, Term
from pipeline.inference.prediction import predict
from pipeline.inference.residual import residual, whitening
from tests.pipeline.bench import bench
from tests.pipeline.discover.fits import GEOMETRY, fit_of, fitted_tests
from vjm.effects.base import Parameter
from vjm.forms import forms
from vjm.law_sites import SITE_KINDS
from vjm.site_law import SiteLaw, parameters_of

SMALL = {"hinge_torque": 30.0, "shift": 1e-8, "turn": 1e-11}


def law(site: str, slope: float) -> SiteLaw:
    kind = SITE_KINDS[site.partition("@")[0]]
    name = f"slope_{kind.gives.replace('·', '')}_per_{kind.over.replace('·', '')}"
    return SiteLaw.of(
        name="law", site=site, form="linear", parameters=(Parameter(name, "1", 0.0, slope, 0.0, 1e9, ""),)
    )


@pytest.mark.parametrize(
    "site",
    [
        "hinge_torque",
        pytest.param("hinge_torque@tip.2", marks=pytest.mark.long),
        "along@base",
        pytest.param("out_of_plane@1", marks=pytest.mark.long),
        "tilt_z@tip",
        "base_x",
        pytest.param("base_ry", marks=pytest.mark.long),
    ],
)
def test_a_slight_linear_law_moves_readings_by_influence_times_coordinate(site: str) -> None:
    found = fit_of()
    kind = SITE_KINDS[site.partition("@")[0]]
    slope = SMALL["hinge_torque"] if not kind.series else SMALL["turn" if kind.turns else "shift"]
    it = law(site, slope)
    model = replace(found.model, terms=(*found.model.terms, Term(it, {it.parameters[0].name: slope})))
    cases, here = found.residual.load_cases, found.prediction
    there = predict(model, cases, slopes=False, start=here, shift=here.shift)
    change = whitening(cases, here).apply(there.values - here.values)
    truth = found.residual.flat(change)
    tags = set(filter(None, site.partition("@")[2].split(".")))
    own = [e for e in elements(found) if e.kind == kind.name and tags <= set(e.tags)]
    assert own
    rows = found.residual.rows[:, 0]
    told = slope * np.sum([e.influence * e.coordinate[rows] for e in own], axis=0)
    size = float(np.linalg.norm(truth))
    assert size > 1e-4
    assert float(np.linalg.norm(told - truth)) < 0.02 * size


LATE = [pytest.param(it, marks=pytest.mark.long) for it in ("out_of_plane@tip", "along")]


@pytest.mark.parametrize("zero", ["nominal", "first_row"])
@pytest.mark.parametrize("site", ["base_y", "tilt_z", *LATE])
def test_a_shift_without_load_moves_readings_but_no_gauge_that_is_zeroed_there(site: str, zero: str) -> None:
    """y = y0 + c x in series: gauges are zeroed in the unloaded state, or all sensors in the first row."""
    plain = bench()
    campaign = replace(plain, tests=tuple(replace(t, zero=zero) for t in plain.tests))  # type: ignore[arg-type]
    found = unfitted(Model().with_effects([GEOMETRY]), fitted_tests(campaign))
    kind = SITE_KINDS[site.partition("@")[0]]
    slope = SMALL["turn" if kind.turns else "shift"]
    form = forms()["linear+constant"]
    start = {q.name: {"slope": slope, "level": 1e-5}[q.name] for q in form.amplitudes}
    it = SiteLaw.of(
        name="shifted", title="", site=site, form=form.name, parameters=parameters_of(form, kind, start, 1.0)
    )
    values = {p.name: v for p, v in zip(it.parameters, start.values(), strict=True)}
    cases, here = found.residual.load_cases, found.prediction
    model = replace(found.model, terms=(*found.model.terms, Term(it, values)))
    there = predict(model, cases, slopes=False, start=here, shift=here.shift)
    before, after = (found.residual.flat(residual(cases, p).values) for p in (here, there))
    tags = set(filter(None, site.partition("@")[2].split(".")))
    own = [e for e in elements(found) if e.kind == kind.name and tags <= set(e.tags)]
    rows = found.residual.rows[:, 0]
    level, amplitudes = np.array([0.0, 1.0]), np.array(list(start.values()))
    told = np.sum(
        [e.moved(np.stack([e.coordinate, np.ones_like(e.coordinate)], 1), level, rows) for e in own], axis=0
    )
    truth, size = before - after, float(np.linalg.norm(before - after))
    assert size > 1e-4
    assert float(np.linalg.norm(told @ amplitudes - truth)) < 0.03 * size


def test_a_column_is_over_what_is_predicted_of_it() -> None:
    found = fit_of()
    own = {e.kind: e for e in elements(found) if e.kind.startswith("column")}
    cases, z, x = found.residual.load_cases, own["column z_mm"], own["column x_mm"]
    ruled, read = cases.channels[:, 2] == 2, cases.predicted[:, 0]
    assert ruled.any() and read.any()
    # Where it is prescribed it is what was prescribed, as that fits best; where it is read, the prediction.
    off = np.abs(z.coordinate[ruled] - cases.measured[ruled, 2])
    assert 0.0 < off.max() < 6.0 * cases.input_sigma[ruled, 2].max()
    assert x.coordinate[read] == pytest.approx(found.prediction.values[read, 0])


@pytest.mark.parametrize(
    ("site", "name", "amplitude", "shapes"),
    [
        ("hinge_torque", "friction_by_load", 2.0, (0.002, 100.0)),
        ("hinge_torque@tip", "friction_by_load", 2.0, (0.002, 100.0)),
        ("along@base", "slip_by_load", 1e-8, (20.0, 2.0, 100.0)),
        ("tilt_z@tip", "slip_by_load", 1e-11, (50.0, 2.0, 100.0)),
    ],
)
def test_slight_friction_by_load_does_what_its_columns_say(
    site: str, name: str, amplitude: float, shapes: tuple[float, ...]
) -> None:
    """Its limit follows the axial load of the bar beside it, a load step later, in the mechanism as in its columns."""
    found = fit_of()
    kind, form = SITE_KINDS[site.partition("@")[0]], forms()[name]
    values = dict(zip((q.name for q in form.quantities), (amplitude, *shapes), strict=True))
    held = {q.identifier(kind.gives, kind.over): values[q.name] for q in form.shapes if q.name in form.fixed}
    it = SiteLaw.of(
        name="law",
        title="",
        site=site,
        form=name,
        parameters=parameters_of(form, kind, values, 1.0),
        held=held,
    )
    known = {q.identifier(kind.gives, kind.over): values[q.name] for q in form.quantities}
    own = {p.name: known[p.name] for p in it.parameters}
    cases, here = found.residual.load_cases, found.prediction
    model = replace(found.model, terms=(*found.model.terms, Term(it, own)))
    there = predict(model, cases, slopes=False, shift=here.shift)
    truth = found.residual.flat(whitening(cases, here).apply(there.values - here.values))
    tags = set(filter(None, site.partition("@")[2].split(".")))
    rows = found.residual.rows[:, 0]
    told = np.zeros(rows.size)
    for e in elements(found):
        if e.kind == kind.name and tags <= set(e.tags):
            assert e.axial is not None
            says = form.columns(e.coordinate, cases.first, np.array(shapes), e.axial)
            told += e.moved(says * amplitude, np.zeros(1), rows)[:, 0]
    size = float(np.linalg.norm(truth))
    assert size > 1e-4
    assert float(np.linalg.norm(told - truth)) < 0.03 * size
