"""`python -m pipeline.assessment.mistaken`: runs the study, or goes on with it, and writes reports/mistaken."""

from pipeline.assessment.mistaken.page import page
from pipeline.assessment.mistaken.tables import KINDS
from pipeline.assessment.mistaken.trial import NONE, Trial, benches, trial
from pipeline.assessment.study import Study, Task


def tasks(count: int) -> list[Task]:
    """Kinds and numbers of so many benches of each kind, with and without an effect."""
    numbers = sorted((*benches("clean", count), *benches("single", count)))
    return [(kind, number) for number in numbers for kind in (NONE, *KINDS)]


STUDY = Study(
    name="mistaken",
    title="twelve kinds of mistakes of a table, and right ones",
    of="tables",
    count=20,
    counted="Benches of each kind, with and without an effect.",
    tasks=tasks,
    trial=trial,
    kind=Trial,
    task=lambda it: (it.kind, it.number),
    right=lambda it: it.counts and it.named,
    page=page,
)

if __name__ == "__main__":
    STUDY.command()
