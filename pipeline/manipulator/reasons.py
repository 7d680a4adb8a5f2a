"""Why a point of a sweep lacks a number: sentences of each manipulator, of which a map keeps the numbers."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vjm.manipulator.freedom import LOOSE, RIGID
from vjm.manipulator.legs import UNSOLVED
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import BEYOND, UNREACHED
from vjm.manipulator.rest import SINGULAR

MOVES = "the platform moves without load"
NO_EQUILIBRIUM = "no stable equilibrium is found under the wrench or with the effect"
NO_NODE = "has no stiffness at any point where critical loads are computed"
OTHER = "the numbers of this point cannot be computed"


def no_critical_load(leg: str, why: str) -> str:
    """The sentence of a leg whose critical load cannot be found; why: what it "is" or "has"."""
    return f"no critical load: leg {leg} {why}"


def reasons_of(manipulator: Manipulator) -> tuple[str, ...]:
    """All reasons that a point of a sweep may have, the empty one first and `OTHER` last."""
    said = [""]
    for leg in manipulator.legs:
        said += [UNREACHED.format(leg.name), BEYOND.format(leg.name)]
        said += [f"leg {leg.name} {why}" for why in (RIGID, LOOSE, SINGULAR)]
        said += [no_critical_load(leg.name, why) for why in (RIGID, LOOSE, UNSOLVED, NO_NODE)]
    return (*said, MOVES, NO_EQUILIBRIUM, OTHER)


def numbers_of(sentences: Sequence[str] | np.ndarray, reasons: Sequence[str]) -> NDArray[np.float64]:
    """(B,) number of each sentence (B,) in the list of reasons; one that is not there is `OTHER`."""
    place = {sentence: float(number) for number, sentence in enumerate(reasons)}
    return np.array([place.get(str(sentence), place[OTHER]) for sentence in sentences], dtype=float)
