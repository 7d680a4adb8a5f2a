"""A step that was not worth taking is not tried again from where it was tried."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.levenberg_marquardt import levenberg_marquardt
from pipeline.inference.model import Free
from pipeline.inference.solvers import ALL
from vjm.effects.base import Parameter

Array = NDArray[np.float64]
NUMBER = Parameter("size", "1", 0.0, 1.0, -100.0, 100.0, "of a kink")


@dataclass
class Kinked:
    """Two hundred readings far above noise, of which one falls with the number by a small part of what its derivative
    says, as where a row's side of a stop changes on the way."""

    kept: float
    left: float = 2.5
    tried: list[float] = field(default_factory=list)

    @property
    def model(self) -> Any:
        return SimpleNamespace(free=(Free("kink", NUMBER),), values=np.array([1.0]))

    @property
    def load_cases(self) -> Any:
        return SimpleNamespace(unknowns=1.0, fitted=np.ones(200))

    def at(self, values: Array, near: object = None, slopes: bool = True, within: float = 0.0) -> Any:
        (x,) = values
        self.tried.append(float(x))
        residuals = np.append(np.full(199, self.left), 3.0 + self.kept * (x - 1.0))
        jacobian = np.zeros((200, 1))
        jacobian[-1] = 1.0
        it = SimpleNamespace(
            objective=self,
            values=values,
            residuals=residuals,
            jacobian=jacobian,
            settled=True,
            rounds=1,
            lost=0,
            prediction=None,
        )
        it.with_slopes = it
        return it


def test_no_step_is_tried_twice() -> None:
    aim = Kinked(kept=0.02)
    levenberg_marquardt(aim.at(aim.model.values), None, np.inf, ALL)
    assert len(aim.tried) >= 2
    assert len(set(aim.tried)) == len(aim.tried)


def test_a_step_that_keeps_what_it_promises_is_taken() -> None:
    aim = Kinked(kept=1.0)
    end = levenberg_marquardt(aim.at(aim.model.values), None, np.inf, ALL)
    assert abs(end.there.values[0] + 2.0) < 1e-6
