"""`python -m pipeline.assessment.challenge.laws`: all benches with laws; it may be stopped and started again."""

from __future__ import annotations

from pipeline.assessment.challenge.laws.cases import CASES
from pipeline.assessment.challenge.laws.outcome import LawOutcome, law_outcome
from pipeline.assessment.challenge.laws.page import law_page
from pipeline.assessment.challenge.laws.score import law_scored
from pipeline.assessment.study import Study

STUDY = Study(
    name="laws",
    title="benches with laws",
    of="benches",
    count=CASES["law"],
    counted="Benches with one law; those with two and with none go with it.",
    # Of each kind a share.
    tasks=lambda count: [
        (kind, k) for kind, n in CASES.items() for k in range(max(1, count * n // CASES["law"]))
    ],
    trial=law_outcome,
    kind=LawOutcome,
    task=lambda it: (it.kind, it.number),
    right=lambda it: all(it.right),
    page=lambda found: law_page(law_scored(found)),
    beside=lambda found: {"laws.json": law_scored(found).text()},
    folder="challenge",
    store="laws_outcomes.jsonl",
)

if __name__ == "__main__":
    STUDY.command()
