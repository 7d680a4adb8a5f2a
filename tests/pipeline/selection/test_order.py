"""A diagnosis does not depend on the order in which effects are known and tests are written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from pipeline.add.fitting import add, remove
from pipeline.answer.of_diagnosis import answer_of
from pipeline.campaign import Campaign
from pipeline.campaign.order import by_name
from pipeline.discover.command import laws_found
from pipeline.inference.model import Model
from pipeline.inference.suitable import Known
from pipeline.record import Record
from pipeline.selection.diagnosis import diagnose
from tests.pipeline.bench import bench
from vjm.effects import catalogue
from vjm.effects.base import Effect

SOME = ("bar_geometric_nonlinearity", "joint_friction", "modulus_error")
TIMES = {"seconds", "versions", "commit", "digest"}


def some() -> dict[str, Effect]:
    return {name: it for name, it in catalogue().items() if name in SOME}


def answer(campaign: Campaign, effects: Mapping[str, Effect]) -> dict[str, object]:
    return timeless(answer_of(diagnose(campaign, Model(), effects)))


def timeless(record: Record) -> dict[str, object]:
    """All of a record but when and with what it was made."""
    return {key: value for key, value in record.model_dump(mode="json").items() if key not in TIMES}


def mixed(campaign: Campaign, seed: int) -> Campaign:
    """The tests in another order."""
    order = np.random.default_rng(seed).permutation(len(campaign.tests))
    assert not np.array_equal(order, np.arange(order.size))
    return replace(campaign, tests=tuple(campaign.tests[k] for k in order))


@cache
def usual() -> dict[str, object]:
    """The answer for the tests and effects as they stand."""
    it = answer(hidden(), some())
    assert it["verdict"] == "identified"
    return it


def hidden() -> Campaign:
    return bench("joint_friction.torque_Nmm", 300.0)


def test_the_order_of_effects_changes_no_digit() -> None:
    assert answer(hidden(), dict(reversed(some().items()))) == usual()


def test_the_order_of_tests_changes_no_digit() -> None:
    assert answer(mixed(hidden(), 1), some()) == usual()


def test_nor_of_what_is_added_and_removed() -> None:
    plain, answers = bench("modulus_error.scale", 0.95), []
    effects = [catalogue()[name] for name in ("modulus_error", "joint_torsional_stiffness")]
    for campaign in (plain, mixed(plain, 2)):
        more = add(campaign, Model(), effects)
        less = remove(campaign, more.model, ["joint_torsional_stiffness"])
        answers.append([timeless(more.answer), timeless(less.answer)])
    assert answers[0] == answers[1]


@pytest.mark.long
def test_nor_of_a_law_that_is_found() -> None:
    known = Known(some(), {})
    found = [laws_found(it, Model(), known) for it in (hidden(), mixed(hidden(), 4))]
    assert found[0].record.laws and found[0].effect_file == found[1].effect_file
    assert timeless(found[0].record) == timeless(found[1].record)


@pytest.mark.long
def test_where_it_is_known_when_each_was_done_no_drift_changes_either() -> None:
    """With the whole catalogue: a drift is of the order in which tests were done."""
    campaign = by_name(hidden())
    one = answer(campaign, catalogue())
    assert answer(mixed(campaign, 3), catalogue()) == one
