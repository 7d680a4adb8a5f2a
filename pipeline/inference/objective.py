"""What a fit makes least, as a function of the free numbers of a model; it knows where it was last."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.inputs import begun, kinked, linearised, sloped
from pipeline.inference.model import Model
from pipeline.inference.prediction import Prediction
from pipeline.inference.program import Program
from pipeline.inference.residual import Residual

Array = NDArray[np.float64]
Place = tuple[Prediction | None, tuple[bytes, Prediction, Residual] | None]
"""Where an objective was last: what it starts from, and what it solved there."""


@dataclass(eq=False)
class Objective:
    """Whitened residuals and derivatives at values (P,); goes on from where it was last, at first from the start.

    The inputs that fit best follow from one evaluation to the next, the first ones from the start. At them the
    derivatives that the weights have by the values cancel (envelope theorem), so the gradient of chi² is that of the
    residual alone.
    """

    model: Model
    program: Program
    last: Prediction | None = None
    count: int = 0
    _known: tuple[bytes, Prediction, Residual] | None = field(default=None, repr=False)

    def at(self, values: Array) -> tuple[Prediction, Residual]:
        """Prediction and residual at values with derivatives by the free numbers."""
        here, found = self._solved(values)
        if here.by_free.shape[-1] < len(self.model.free):
            here, found = sloped(self.model.at(values), self.program, here)
            self.last, self._known = here, (np.asarray(values).tobytes(), here, found)
        return here, found

    def _solved(self, values: Array) -> tuple[Prediction, Residual]:
        """Prediction and residual at values; where rows choose their sides, at no small cost, derivatives wait until
        they are asked for, which after a step that is not taken they are not."""
        key = np.asarray(values).tobytes()
        if self._known is None or self._known[0] != key:
            known = self._known
            shift = known[2].shift if known else begun(self.model, self.program, self.last)
            slopes = not kinked(self.model)
            found = linearised(self.model.at(values), self.program, slopes, self.last, shift)
            self.last = found[0]
            self.count += 1
            self._known = (key, *found)
        return self._known[1], self._known[2]

    @property
    def lost(self) -> int:
        """Rows without an equilibrium where it was last."""
        return 0 if self._known is None else int(self._known[1].lost.sum())

    def residuals(self, values: Array) -> Array:
        """(N + 1,) as `Residual.aimed`."""
        return self._solved(values)[1].aimed

    def again(self, values: Array) -> Array:
        """(N + 1,) linearised anew, at the inputs that fit best by what is known."""
        it = self._solved(values)[1]
        self._known = (b"", self._known[1], it) if self._known is not None else None
        return self.residuals(values)

    @property
    def place(self) -> Place:
        """Where it was last, to come back to by `back`."""
        return self.last, self._known

    def back(self, place: Place) -> None:
        """Go on from there: a step that was not taken may have ended on another branch."""
        self.last, self._known = place

    def unsettled(self, values: Array) -> float:
        """By how many of its sigmas an input that fits best is off the one near which the model was linearised."""
        prediction, it = self._solved(values)
        sigma = self.program.input_sigma
        off = np.abs(it.shift - prediction.shift)[sigma > 0.0] / sigma[sigma > 0.0]
        return float(off.max(initial=0.0))

    def jacobian(self, values: Array) -> Array:
        """(N + 1, P) as `Residual.aimed_by`."""
        return self.at(values)[1].aimed_by
