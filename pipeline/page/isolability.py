"""How alike the effects look in a campaign's tests, as a matrix."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from pipeline.attempt import Attempts
from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.page.curves import numbers
from pipeline.page.record import Isolability, Numbers
from pipeline.selection.confusability import multiple_correlation
from pipeline.selection.diagnosis import Diagnosis, suitable
from pipeline.selection.first_order import FirstOrder
from pipeline.selection.fit_cache import FitCache
from vjm.effects.base import Effect

SHOWS = 0.1
"""Sigmas of all readings together below which an effect of its typical size is invisible: noise alone makes one."""


def isolability(found: Diagnosis) -> Isolability:
    """Correlations about the model with those chosen effects that are there or not, each at its typical size."""
    return _of(found.cache, found.sets[0])


def attempted_isolability(found: Diagnosis) -> Isolability | None:
    """The same, or None where nothing was tested or it cannot be worked out: a page goes without it."""
    if found.untested:
        return None
    made = Attempts().get("what could be taken for what", lambda: isolability(found), None)
    return made if made is not None and made.effects else None


def isolability_anew(
    campaign: Campaign,
    model: Model,
    known: Mapping[str, Effect],
    added: Sequence[str],
    on_progress: OnProgress,
) -> Isolability:
    """The same from what a saved answer says that it added to the model; a quarter of a minute."""
    whole = completed(campaign)
    candidates, _ = suitable(whole, model, known)
    cache = FitCache(load_cases(whole), model, candidates, on_progress)
    # All fits begin where those of a diagnosis do.
    cache.fit(frozenset())
    return _of(cache, [name for name in added if name in candidates]).model_copy(update={"anew": True})


def _of(cache: FitCache, added: Sequence[str]) -> Isolability:
    about = cache.first_order(frozenset(name for name in added if not cache.candidates[name].parameters))
    names = tuple(cache.order(frozenset(about.signatures)))
    rows = tuple(_row(about, name, names) for name in names)
    return Isolability(about=about.fit.model.names, effects=names, correlation=rows)


def _row(about: FirstOrder, name: str, names: tuple[str, ...]) -> Numbers:
    # Columns are in typical sizes; one with kinks has a single column, of its first probe.
    mine = about.columns(name).sum(axis=1)
    if np.linalg.norm(mine) < SHOWS:
        return (None,) * len(names)
    return numbers(
        1.0 if other == name else multiple_correlation(mine, about.columns(other)) for other in names
    )
