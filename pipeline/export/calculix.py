"""A deck for CalculiX (G. Dhondt, http://www.calculix.de), whose version 2.20 reads no stiffness matrix.

K = sum of s v vᵀ over springs of one direction: each is a SPRING1 on a node of its own, whose displacement an equation
ties to v · (u, phi) at the point less what the base carries along. A body has two nodes, one for its displacement and
one whose "displacements" are its rotations, as in *RIGID BODY with REF NODE and ROT NODE.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from pipeline.export.content import Spring, commented
from pipeline.export.decks import Numbered, numbered, terms_of

# CalculiX reads twenty characters of a number and 132 of a line.
_NUMBER = ".12e"
_TERMS_A_LINE = 4

USE = (
    "Linear analysis only. A body is two nodes, BASE and BASEROT, TIP and TIPROT: degrees 1 to 3 of the ROT node are "
    "its rotations. Join: *RIGID BODY, NSET=..., REF NODE=(TIP), ROT NODE=(TIPROT). Clamp: *BOUNDARY of degrees 1 to 3 "
    "of BASE and BASEROT."
)


def deck(springs: Sequence[Spring], head: Sequence[str]) -> str:
    """The text, to be named in an *INCLUDE."""
    lines = commented("** ", (*head, USE))
    for each in numbered(springs):
        lines += _spring(each)
    return "\n".join(lines) + "\n"


def _spring(it: Numbered) -> Iterator[str]:
    spring, mark = it.spring, "" if it.number == 1 else str(it.number)
    base, base_turn, tip, tip_turn = range(it.first, it.first + 4)
    yield from commented("** ", (f"{spring.what}; {spring.frame}",))
    nodes = {"BASE": base, "BASEROT": base_turn, "TIP": tip, "TIPROT": tip_turn}
    for (name, node), place in zip(
        nodes.items(), np.repeat([spring.base, spring.point], 2, axis=0), strict=True
    ):
        yield f"*NODE, NSET={name}{mark}"
        yield f"{node},{_point(place)}"
    bodies = [(node, axis) for node in nodes.values() for axis in (1, 2, 3)]
    for k, (stiffness, direction) in enumerate(spring.terms):
        own = it.first + 10 + k
        yield "*NODE"
        yield f"{own},{_point(spring.point)}"
        # The first term is the one that CalculiX eliminates.
        terms = [f"{own},1,-1."]
        for at, value in terms_of(direction @ spring.relative):
            node, axis = bodies[at]
            terms.append(f"{node},{axis},{value:{_NUMBER}}")
        yield "*EQUATION"
        yield str(len(terms))
        for start in range(0, len(terms), _TERMS_A_LINE):
            yield ",".join(terms[start : start + _TERMS_A_LINE])
        # A spring makes all three degrees of its node unknown; two of them nothing else holds.
        yield "*BOUNDARY"
        yield f"{own},2,3"
        name = f"SPRING{mark}_{k + 1}"
        yield f"*ELEMENT, TYPE=SPRING1, ELSET={name}"
        yield f"{own},{own}"
        yield f"*SPRING, ELSET={name}"
        yield "1"
        yield f"{stiffness:{_NUMBER}}"


def _point(place: np.ndarray) -> str:
    return ",".join(f"{value:{_NUMBER}}" for value in place)
