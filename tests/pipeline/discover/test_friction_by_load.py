"""Friction that goes with the axial load: the mechanism against the frame elements, which share no code with it."""

from functools import cache

import numpy as np
import pytest

from fem.frame.laws.forms.sliders import CoulombByLoad
from fem.frame.placed import Placed
from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.challenge.laws.cases import law_case
from pipeline.assessment.challenge.laws.size import Scale, scale_of
from pipeline.assessment.virtual.bench import true_readings
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.inference.model import Model, Term
from pipeline.inference.prediction import predict
from vjm.effects import catalogue
from vjm.effects.base import Parameter
from vjm.site_law import SiteLaw

AT = 100.0
"""N, at which limits are told."""


@cache
def scale() -> Scale:
    bench = law_case(0).bench
    return scale_of(bench, bench.rig)


def law(site: str, form: str, values: dict[str, float]) -> Term:
    parameters = tuple(Parameter(name, "1", 0.0, value, 0.0, 1e9, "") for name, value in values.items())
    effect = SiteLaw.of(name="law", title="", site=site, form=form, parameters=parameters, held={"at_N": AT})
    return Term(effect, values)


@pytest.mark.parametrize(
    ("site", "share", "sticks", "beside"),
    [
        ("hinge_torque", 0.5, 3e5, 0.0),
        ("hinge_torque@tip", 0.5, 3e5, 0.0),
        ("along", 0.3, 6e5, 1e5),
        ("tilt_z@base", 5.0, 6e7, 2e7),
    ],
)
def test_two_programs_say_the_same(site: str, share: float, sticks: float, beside: float) -> None:
    """Friction moment or force a newton, stiffness while it sticks, and of the spring beside it."""
    if beside:
        x, y = ("rad", "Nmm") if site.startswith("tilt") else ("mm", "N")
        values = {f"give_{x}_per_{y}": 1.0 / beside, f"limit_{y}": share * AT, "stick": sticks / beside}
        term = law(site, "slip_by_load", values)
    else:
        values = {"limit_Nmm": share * AT, "reach_rad": share * AT / sticks}
        term = law(site, "friction_by_load", values)
    it = scale()
    placed = Placed(site, CoulombByLoad(share, sticks, beside))
    frame = it.signature(true_readings(it.bench.rig, it.bench.plan, {}, GAUGES, [placed]))
    plain = Model().with_effects([catalogue()[ALWAYS]])
    there = predict(Model(terms=(*plain.terms, term)), it.cases, slopes=False)
    used = it.cases.predicted & it.cases.fitted[:, None]
    mechanism = it.white.apply(there.values - it.reference.values)[np.nonzero(used)]
    assert np.linalg.norm(frame) > 10.0
    assert np.linalg.norm(mechanism - frame) < 1e-3 * np.linalg.norm(frame)
