"""`python -m pipeline.assessment.doubts`: runs the study, or goes on with it, and writes reports/doubts."""

from pipeline.assessment.doubts.kinds import KINDS
from pipeline.assessment.doubts.page import page
from pipeline.assessment.doubts.trial import Trial, trial
from pipeline.assessment.study import Study

STUDY = Study(
    name="doubts",
    title="each kind of doubt by itself, on as many benches",
    of="benches",
    count=200,
    counted="Benches of each kind.",
    # Of every kind as many, wherever it is stopped.
    tasks=lambda count: [(kind, number) for number in range(count) for kind in KINDS],
    trial=trial,
    kind=Trial,
    task=lambda it: (it.kind, it.number),
    right=lambda it: it.right,
    page=page,
)

if __name__ == "__main__":
    STUDY.command()
