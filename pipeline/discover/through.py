"""Laws in the mechanism: a form at a site as an effect, fitted with all else that the model has."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.discover.forming import Formed
from pipeline.inference.fit import Fit, fit
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model, Term
from pipeline.inference.solvers import Effort
from vjm.site_law import SiteLaw, parameters_of

Array = NDArray[np.float64]
SHARE = 0.3
"""Of the work of a fit: one of a law begins near its end."""


@dataclass(frozen=True, eq=False)
class Through:
    """A form fitted through the mechanism. formed: as it was where influences are known. law: the effect. fit: of the
    model with it. numbers: of the law."""

    formed: Formed
    law: SiteLaw
    fit: Fit
    numbers: int

    @property
    def cost(self) -> float:
        """Chi-square and what the law's numbers cost; beyond all where rows are lost."""
        if self.fit.lost:
            return np.inf
        return self.fit.chi_square + self.numbers * float(np.log(self.fit.whitened.size))

    @property
    def values(self) -> dict[str, float]:
        """Of its numbers, by parameter."""
        own = next(term for term in self.fit.model.terms if term.effect is self.law)
        return dict(own.values)

    @property
    def there(self) -> Formed:
        """The form at the numbers that the fit through the mechanism gives it."""
        form, kind = self.formed.form, self.formed.kind
        known = {**self.law.held, **self.values}
        amplitudes, shapes = (
            np.array([known[q.identifier(kind.gives, kind.over)] for q in some])
            for some in (form.amplitudes, form.shapes)
        )
        return replace(self.formed, amplitudes=amplitudes, shapes=shapes)


def law_of(it: Formed, name: str, source: str = "") -> SiteLaw:
    """A form at a site as an effect whose numbers are sized by those found."""
    kind, form = it.kind, it.form
    held = {
        q.identifier(kind.gives, kind.over): it.values[q.name] for q in form.shapes if q.name in form.fixed
    }
    more = {"source": source} if source else {}
    return SiteLaw.of(
        name=name,
        title=f"{form.title}: {kind.title}",
        site=it.site.name,
        form=form.name,
        parameters=parameters_of(form, kind, it.values, it.largest),
        mirrored=it.site.mirrored,
        held=held,
        **more,
    )


def with_law(model: Model, law: SiteLaw, it: Formed) -> Model:
    """A model with a law at the numbers of a form, inside their bounds."""
    names = {q.identifier(it.kind.gives, it.kind.over): it.values[q.name] for q in it.form.quantities}
    values = {}
    for p in law.parameters:
        low, high = p.low + 1e-3 * abs(p.typical) * p.one_sided, p.high
        values[p.name] = float(np.clip(names[p.name], low, high))
    return replace(model, terms=(*model.terms, Term(law, values)))


def through(it: Formed, model: Model, cases: LoadCases, name: str) -> Through:
    """A form fitted through the mechanism beside the effects of a model."""
    law = law_of(it, name)
    # A fit that does not come near what the form leaves where influences are known decides nothing.
    found = fit(with_law(model, law, it), cases, effort=Effort(SHARE, it.left))
    return Through(it, law, found, it.numbers)
