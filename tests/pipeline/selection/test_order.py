"""A diagnosis does not depend on the order in which effects are known and tests are written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import pytest

from pipeline.answer.of_diagnosis import answer_of
from pipeline.campaign import Campaign
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import diagnose
from tests.pipeline.bench import bench
from vjm.effects import catalogue
from vjm.effects.base import Effect

SOME = ("bar_geometric_nonlinearity", "joint_friction", "modulus_error")
TIMES = {"seconds", "versions", "commit", "digest"}


def some() -> dict[str, Effect]:
    return {name: it for name, it in catalogue().items() if name in SOME}


def answer(campaign: Campaign, effects: Mapping[str, Effect]) -> dict[str, object]:
    whole = answer_of(diagnose(campaign, Model(), effects)).model_dump(mode="json")
    return {key: value for key, value in whole.items() if key not in TIMES}


def test_the_order_of_effects_changes_no_digit() -> None:
    campaign, effects = bench("joint_friction.torque_Nmm", 300.0), some()
    one = answer(campaign, effects)
    assert one["verdict"] == "identified"
    assert answer(campaign, dict(reversed(effects.items()))) == one


@pytest.mark.long
def test_the_order_of_tests_changes_rounding_alone() -> None:
    campaign = bench("joint_friction.torque_Nmm", 300.0)
    one, other = (
        diagnose(replace(campaign, tests=tests), Model(), some())
        for tests in (campaign.tests, tuple(reversed(campaign.tests)))
    )
    assert (other.verdict, other.sets, other.certain) == (one.verdict, one.sets, one.certain)
    assert other.model.values == pytest.approx(one.model.values, rel=1e-9)
    assert other.fit.chi_square == pytest.approx(one.fit.chi_square, rel=1e-9)
