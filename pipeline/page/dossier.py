"""The validation dossier of a campaign's page: the model of the page, predicted and compared with its readings."""

from __future__ import annotations

from pipeline.attempt import Attempts
from pipeline.campaign import Campaign
from pipeline.inference.fit import Fit
from pipeline.inference.model import Model
from pipeline.page.record import Dossier
from pipeline.predict.asked import own_rows
from pipeline.predict.comparison import comparison
from pipeline.predict.predicting import fitted_as, fitted_to, predicted
from pipeline.predict.recording import recorded


def dossier(
    campaign: Campaign, model: Model, fit: Fit | None = None
) -> tuple[Dossier | None, tuple[str, ...]]:
    """The dossier, and why it could not be made; both empty where nothing was measured. fit: of the model to these
    readings, made now where it is not given."""
    attempts = Attempts()
    return attempts.get("the validation dossier", lambda: _made(campaign, model, fit), None), tuple(
        attempts.failed
    )


def _made(campaign: Campaign, model: Model, fit: Fit | None) -> Dossier | None:
    fitted = fitted_to(campaign, model) if fit is None else fitted_as(fit, campaign)
    if fitted.untested:
        return None
    it = predicted(fitted, own_rows(campaign))
    record = recorded(it)
    held = bool(record.held_out.of)
    return Dossier(
        held_out=held,
        comparison=record.comparison if held else comparison(it, it.judged),
        inside=record.held_out.inside if held else record.fitted.inside,
        readings=record.held_out.of if held else record.fitted.of,
        budget=record.budget,
        noise_factor=record.noise_factor,
        computed=campaign.rig.tolerance_said,
        data=record.data,
    )
