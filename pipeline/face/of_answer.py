"""What results that are an answer have in common."""

from __future__ import annotations

from dataclasses import dataclass

from pipeline.answer.record import Answer
from pipeline.answer.tables.headline import headline
from pipeline.face.about import AboutBench


@dataclass(frozen=True, eq=False, repr=False)
class OfAnswer(AboutBench):
    """answer: all of it as a record, values in the units of their parameters."""

    answer: Answer

    @property
    def headline(self) -> str:
        return headline(self.answer)

    @property
    def verdict(self) -> str:
        """nothing_tested, within_noise, identified, ambiguous or unknown."""
        return self.answer.verdict

    @property
    def sentences(self) -> tuple[str, ...]:
        return self.answer.sentences
