"""What an answer says of a bench: names, cells, sigmas, and whether it is that of the bench without the doubt."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from pipeline.answer.of_diagnosis import answer_of
from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.challenge.dirty.dirt import Knock
from pipeline.campaign import Campaign
from pipeline.selection.diagnosis import Diagnosis

Sets = tuple[tuple[str, ...], ...]
Cells = frozenset[tuple[int, int, int]]


@dataclass(frozen=True)
class Told:
    """sets: without what every bench has. doctor: mistakes of the table. aside: of each reading that was set aside, the
    cells (test, row, channel) of which one is off. rescaled: columns whose sigma was changed. tails: whether long ones
    were found. made, seen: cells that were knocked, and those of them that show. beside: verdict and sets of the bench
    without the doubt."""

    verdict: str
    sets: Sets
    certain: frozenset[str]
    doctor: tuple[str, ...]
    aside: tuple[Cells, ...]
    rescaled: tuple[str, ...]
    tails: bool
    made: Cells = frozenset()
    seen: Cells = frozenset()
    beside: tuple[str, Sets] | None = None

    @property
    def named(self) -> frozenset[str]:
        """All names: certain ones, those of the sets where each has some, mistakes of the table."""
        every = self.verdict in ("identified", "ambiguous") and all(self.sets)
        sets = {name for names in self.sets for name in names} if every else set[str]()
        return self.certain | sets | frozenset(self.doctor)

    def every_set_has(self, names: frozenset[str]) -> bool:
        """Whether every set of the answer, or what is certain, has one of these names."""
        sets = self.verdict in ("identified", "ambiguous") and all(names & set(each) for each in self.sets)
        return sets or bool(names & self.certain)

    @property
    def shown(self) -> int:
        """Knocked readings that show."""
        return len(self.seen)

    @property
    def unseen(self) -> int:
        """Of these, those that are not set aside."""
        return sum(not any(cell in cells for cells in self.aside) for cell in self.seen)

    @property
    def good_aside(self) -> int:
        """Readings that are set aside and were not knocked."""
        return sum(not cells & self.made for cells in self.aside)

    @property
    def other_than_beside(self) -> str:
        """What the bench without the doubt has for an answer, where it is another one."""
        if self.beside is None or (self.verdict, self.sets) == self.beside:
            return ""
        verdict, sets = self.beside
        return f"without: {verdict} {in_words(sets)}"

    @staticmethod
    def words(names: Iterable[str]) -> str:
        """Names in the order of the alphabet."""
        return ", ".join(sorted(names))


def told(
    answer: Diagnosis, campaign: Campaign, made: Iterable[Knock] = (), seen: Iterable[Knock] = ()
) -> Told:
    """What a diagnosis says; made, seen: readings that were knocked, and those that show."""
    record = answer_of(answer)
    columns = answer.cache.whole.rows.columns
    numbers = {test.id: k for k, test in enumerate(campaign.tests)}
    return Told(
        verdict=answer.verdict,
        sets=sets_of(answer),
        certain=frozenset(answer.certain) - {ALWAYS},
        doctor=tuple(each.mistake.words for each in answer.doctor),
        aside=tuple(
            frozenset((numbers[a.test], int(a.step), columns.index(name)) for name in (a.column, *a.instead))
            for a in record.set_aside
        ),
        rescaled=tuple(n.column for n in record.noise if n.tails is None),
        tails=any(n.tails is not None for n in record.noise),
        made=_cells(made),
        seen=_cells(seen),
    )


def sets_of(answer: Diagnosis) -> Sets:
    """The sets of an answer without what every bench has."""
    return tuple(tuple(n for n in names if n != ALWAYS) for names in answer.possible)


def in_words(sets: Sets) -> str:
    """Sets of names."""
    return " | ".join(" + ".join(names) or "nothing" for names in sets)


def _cells(knocks: Iterable[Knock]) -> Cells:
    return frozenset((it.test, it.row, it.channel) for it in knocks)
