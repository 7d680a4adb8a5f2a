"""What the widgets of the studio show of a plan, as plain values."""

from __future__ import annotations

from typing import Any

from pipeline.plan.command import LARGE
from pipeline.plan.record import Plan, Size
from pipeline.plan.table import following
from pipeline.studio.session import Session
from reports.campaign.names import BEFORE
from reports.formats import DASH, number


def planning(session: Session) -> dict[str, Any]:
    """Sizes, what comes next and what cannot be looked for; empty before there is a plan."""
    plan = session.plan
    if plan is None:
        return {"planned": False, "sizes": [], "following": [], "about": "", "apart_from": []}
    return {
        "planned": True,
        "sizes": [
            _size(it, k == 0 or plan.sizes[k - 1].effect != it.effect) for k, it in enumerate(plan.sizes)
        ],
        "following": following(plan),
        "about": _about(session, plan),
        "apart_from": [f"{name} cannot be looked for: {why}" for name, why in plan.refused.items()],
    }


def _about(session: Session, plan: Plan) -> str:
    then, now = session.planned, session.page
    effects = () if then is None else then.effects
    added = "" if LARGE in effects else f" with {LARGE}"
    said = f"About {' + '.join(effects) or BEFORE}{added}."
    if now is not None and now.effects != effects:
        said += " The model has changed since: Plan looks again."
    if plan.unmeasured:
        said += f" Not measured yet, sensors as in [noise]: {', '.join(plan.unmeasured)}."
    return said


def _size(it: Size, first: bool) -> dict[str, Any]:
    """first: of its effect."""
    return {
        "effect": it.effect,
        "first": first,
        "name": it.parameter,
        "typical": number(it.typical, 2),
        "detected": number(it.detected, 2),
        "apart": number(it.apart, 2),
        "unit": "" if it.unit == "1" else it.unit,
        "rival": it.rival or DASH,
        "rho": number(it.rho, 3),
        "hidden": it.detected is None or it.detected > it.typical,
        "alike": it.apart is None or it.apart > it.typical,
    }
