"""`python -m pipeline.assessment.left_out`: runs the study, or goes on with it, and writes reports/left_out."""

from pipeline.assessment.left_out.benches import MU
from pipeline.assessment.left_out.entries import ENTRIES
from pipeline.assessment.left_out.page import page
from pipeline.assessment.left_out.trial import Trial, trial
from pipeline.assessment.study import Study

STUDY = Study(
    name="left_out",
    title="effects that are left out of the catalogue and hidden on benches",
    of="benches",
    count=4,
    counted="Benches of each effect at each of three sizes.",
    tasks=lambda count: [(n, list(ENTRIES)[n % len(ENTRIES)]) for n in range(count * len(MU) * len(ENTRIES))],
    trial=trial,
    kind=Trial,
    task=lambda it: (it.number, it.name),
    right=lambda it: it.right,
    page=page,
)

if __name__ == "__main__":
    STUDY.command()
