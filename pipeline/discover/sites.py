"""Sites: places that share one function. All parts of a kind alike come first, then those of one end, one bar, one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pipeline.discover.elements import Element

SEEN = 2.0
"""Root mean square of a coordinate over that of its standard deviations, from which it is seen: three quarters of its
mean square are more than noise then."""
TAGS = ("base", "tip", "1", "2")


@dataclass(frozen=True, eq=False)
class Site:
    """name: kind, and after @ the tags of the parts that have it, as in an effect's site. elements: of one function.

    mirrored: whether it is a function of the coordinate with the other sign at the tips of the bars; a law that is odd
    is the same either way.
    """

    name: str
    elements: tuple[Element, ...]
    mirrored: bool = False

    @property
    def kind(self) -> str:
        """Without its tags."""
        return self.name.partition("@")[0]

    @property
    def parts(self) -> int:
        """How many places share the function."""
        return len(self.elements)

    @property
    def moved(self) -> bool:
        """Whether the tests move its coordinate by more than the noise of readings leaves unknown."""
        signal = sum(float(np.sum(each.coordinate**2)) for each in self.elements)
        noise = sum(float(np.sum(each.unsure**2)) for each in self.elements)
        return signal > SEEN**2 * noise

    def sign(self, element: Element) -> float:
        """Of the element's coordinate in the function, and of what the function says there."""
        return -1.0 if self.mirrored and "tip" in element.tags else 1.0


def sites(every: Sequence[Element]) -> Iterator[Site]:
    """All sites that elements make, the coarsest first."""
    for kind in dict.fromkeys(each.kind for each in every):
        own = [each for each in every if each.kind == kind]
        yield from _with_both_signs(kind, own)
        if len(own) == 1:
            continue
        seen = {frozenset(map(id, own))}
        for tags in _subsets():
            some = [each for each in own if set(tags) <= set(each.tags)]
            key = frozenset(map(id, some))
            if some and key not in seen:
                seen.add(key)
                yield from _with_both_signs(f"{kind}@{'.'.join(tags)}", some)


def _subsets() -> Iterable[tuple[str, ...]]:
    yield from ((tag,) for tag in TAGS)
    yield from ((end, bar) for end in TAGS[:2] for bar in TAGS[2:])


def _with_both_signs(name: str, own: Sequence[Element]) -> Iterator[Site]:
    yield Site(name, tuple(own))
    ends = {tag for each in own for tag in each.tags if tag in TAGS[:2]}
    if len(ends) == 2:
        yield Site(name, tuple(own), mirrored=True)
