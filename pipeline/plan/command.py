"""`plan` from the command line: what the tests of a campaign can show, and the next one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pipeline.answer.of_diagnosis import in_words
from pipeline.attempt import Attempts
from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign, Test
from pipeline.campaign.control import WAYS
from pipeline.campaign.names import FORCE
from pipeline.command import usable_places
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.suitable import check_suitable, scale_for, sized_model
from pipeline.opened import opened
from pipeline.plan.isolability import matrix, visible
from pipeline.plan.next import Worth, best_next
from pipeline.plan.record import Plan, plan_record
from pipeline.plan.seen import seen
from pipeline.plan.table import show
from pipeline.progress import Progress
from pipeline.selection.adequacy.untested import untested
from pipeline.selection.diagnosis import suitable
from vjm.effects.base import Effect
from vjm.effects.sized import all_sized
from vjm.work import at_most

Array = NDArray[np.float64]
LARGE = "bar_geometric_nonlinearity"
WORK = 4000.0
"""Work (`vjm.work`) that the next test may take to be found."""


def plan_of(
    campaign: Campaign, model: Model, known: Mapping[str, Effect], on_progress: OnProgress = lambda _: None
) -> Plan:
    """What the tests of a campaign show about a model with large deflection added. InputError for effects that the
    campaign cannot have."""
    model, known = sized_model(model, campaign), all_sized(known, scale_for(campaign))
    check_suitable([term.effect for term in model.terms], campaign)
    whole, unmeasured = foreseen(campaign)
    whole = completed(whole)
    candidates, refused = suitable(whole, model, known)
    if LARGE in candidates:
        # Signatures depend on the loads as in reality, whether or not that was found to matter yet.
        model = model.with_effects([candidates.pop(LARGE)])
    now = seen(whole, model, candidates, on_progress)
    found = visible(now, candidates)
    names, alike = matrix(now)
    fitted = replace(whole, tests=tuple(t for t in whole.tests if t.role == "fit"))
    attempts = Attempts()

    def looked_for() -> Worth | None:
        with at_most(WORK):
            return best_next(
                fitted, model, candidates, now, lambda text: on_progress(f"the next test: {text}")
            )

    worth = attempts.get("the next test", looked_for, None)
    words = None if worth is None else in_words(worth.choice)
    plan = plan_record(whole.name, found, names, alike, worth, words, unmeasured, refused)
    nothing = "" if unmeasured else untested(unfitted(model, load_cases(whole))) or ""
    return plan.model_copy(update={"untested": nothing, "not_done": tuple(attempts.failed)})


def foreseen(campaign: Campaign) -> tuple[Campaign, tuple[str, ...]]:
    """The campaign with readings, zeros, in the tests that have none yet, and the names of those tests: every sensor
    whose sigma is known reads at every step.

    A test is not measured yet where nothing was read but what it prescribes.
    """
    tests = [_read(test, campaign) if _unmeasured(test) else test for test in campaign.tests]
    named = tuple(t.id for t, old in zip(tests, campaign.tests, strict=True) if t is not old)
    return replace(campaign, tests=tuple(tests)), named


def _unmeasured(test: Test) -> bool:
    d = test.data
    by_force = np.array([by == FORCE for by in test.control])
    by_gauge = np.array([by not in WAYS for by in test.control])
    others = np.where(by_force, d.displacement, d.wrench)
    return not np.isfinite(others).any() and bool(by_gauge.any() or not np.isfinite(d.gauges).any())


def _read(test: Test, campaign: Campaign) -> Test:
    d, noise = test.data, campaign.noise
    displacement, wrench, gauges = (
        _filled(values, sigma)
        for values, sigma in (
            (d.displacement, noise.displacement),
            (d.wrench, noise.wrench),
            (d.gauges, noise.gauges),
        )
    )
    return replace(test, data=replace(d, displacement=displacement, wrench=wrench, gauges=gauges))


def _filled(values: Array, sigma: Array) -> Array:
    return np.where(np.isnan(values) & np.isfinite(sigma[: values.shape[1]]), 0.0, values)


def plan_campaign(
    folder: Path,
    model_file: Path | None = None,
    effects_from: Sequence[Path] = (),
    json: Path | None = None,
    quiet: bool = False,
    full: bool = False,
) -> Plan:
    """Look at the plan of a campaign with the model it has. full: print every parameter and pair. InputError for bad
    input."""
    campaign, model, known = opened(folder, model_file, effects_from)
    usable_places(json=json)
    with Progress(quiet).stage("what the tests show") as stage:
        plan = plan_of(campaign, model, known.effects, stage.say)
    plan.write(json)
    show(plan, quiet, full=full)
    return plan
