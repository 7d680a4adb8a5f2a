"""`python -m pipeline.assessment.sensitivity`: runs the study, or goes on with it, and writes reports/sensitivity."""

from pipeline.assessment.sensitivity.page import page
from pipeline.assessment.sensitivity.trial import Trial, trial
from pipeline.assessment.study import Study

FIRST, STEP = 3, 10
"""Every tenth case of the challenge: they have every kind."""

STUDY = Study(
    name="sensitivity",
    title="every criterion of the diagnosis halved and doubled alone",
    of="benches",
    count=60,
    counted="Benches of the challenge, every tenth case.",
    tasks=lambda count: [(number,) for number in range(FIRST, FIRST + STEP * count, STEP)],
    trial=trial,
    kind=Trial,
    task=lambda it: (it.number,),
    right=lambda it: not it.changes,
    page=page,
)

if __name__ == "__main__":
    STUDY.command()
