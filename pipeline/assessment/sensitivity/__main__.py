"""`python -m pipeline.assessment.sensitivity`: runs the study, or goes on with it, and writes reports/sensitivity."""

from pipeline.assessment.sensitivity.page import page
from pipeline.assessment.sensitivity.trial import Programme, Trial, trial
from pipeline.assessment.study import Study

FIRST = 3
STEPS: dict[Programme, int] = {"clean": 9, "dirty": 19}
"""Every so many cases of a programme. Kinds come round after twenty: these meet all of them."""

STUDY = Study(
    name="sensitivity",
    title="every criterion of the diagnosis halved and doubled alone",
    of="benches",
    count=30,
    counted="Benches of each programme, every ninth case of the clean one and every nineteenth of the dirty one.",
    tasks=lambda count: [(name, FIRST + step * k) for k in range(count) for name, step in STEPS.items()],
    trial=trial,
    kind=Trial,
    task=lambda it: (it.programme, it.number),
    right=lambda it: not it.changes,
    page=page,
)

if __name__ == "__main__":
    STUDY.command()
