"""Fits of small benches in which a law is looked for."""

from dataclasses import replace
from functools import cache

from pipeline.campaign import Campaign
from pipeline.discover.locating import Map, mapped
from pipeline.discover.search import Discovery, discover
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.suitable import scale_for
from pipeline.selection.diagnosis import Diagnosis, diagnose, suitable
from tests.pipeline.bench import bench
from vjm.effects import catalogue
from vjm.effects.base import Effect
from vjm.effects.sized import all_sized

GEOMETRY = catalogue()["bar_geometric_nonlinearity"]


def fitted_tests(campaign: Campaign) -> LoadCases:
    """The load cases of the tests that may be fitted."""
    return load_cases(replace(campaign, tests=tuple(t for t in campaign.tests if t.role == "fit")))


def effects_for(campaign: Campaign) -> dict[str, Effect]:
    return suitable(campaign, Model(), all_sized(catalogue(), scale_for(campaign)))[0]


@cache
def fit_of(effect: str = "", value: float = 0.0) -> Fit:
    """Of the model with geometric nonlinearity alone."""
    return unfitted(Model().with_effects([GEOMETRY]), fitted_tests(bench(effect, value)))


@cache
def map_of(effect: str = "", value: float = 0.0) -> Map:
    return mapped(fit_of(effect, value), effects_for(bench(effect, value)))


@cache
def friction_found() -> Discovery:
    """The laws of a bench with friction in its hinges."""
    campaign = bench("joint_friction.torque_Nmm", 600.0)
    return discover(fitted_tests(campaign), Model(), effects_for(campaign))


def diagnosed(value: float, *names: str) -> Diagnosis:
    """Friction in the hinges, where only these effects and the geometry of the bars are known."""
    known = {name: catalogue()[name] for name in (GEOMETRY.name, *names)}
    return diagnose(bench("joint_friction.torque_Nmm", value), Model(), known)
