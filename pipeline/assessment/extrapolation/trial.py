"""One case of the study: what every approach made of it."""

from __future__ import annotations

from collections.abc import Mapping

from pipeline.assessment.challenge.cases import ALWAYS, Kind, case
from pipeline.assessment.extrapolation.approaches import compared
from pipeline.assessment.extrapolation.bench import measured
from pipeline.assessment.extrapolation.yardstick import Error
from pipeline.assessment.study import Tried
from vjm.effects.base import Effect

BENCH = "bench"


class Trial(Tried):
    """A case. share: of the loads, that the bench bears even 1.5 times. sizes: mu, sigmas by which each hidden effect
    shows. verdict, sets: of the diagnosis, selected: by AIC; without what every bench has. errors, seconds, failed: by
    approach, failed with the reason; "bench" where nothing could be measured."""

    number: int
    kind: Kind
    plan: str
    share: float
    hidden: dict[str, float]
    sizes: dict[str, float]
    verdict: str
    sets: tuple[tuple[str, ...], ...]
    selected: tuple[str, ...]
    errors: dict[str, Error]
    seconds: dict[str, float]
    failed: dict[str, str]

    @property
    def mu(self) -> float:
        """The least of the effects' sizes."""
        return min(self.sizes.values(), default=0.0)


def trial(number: int, commit: str, code: str, known: Mapping[str, Effect] | None = None) -> Trial:
    """The case of that number; known: effects that can be added, the catalogue by default."""
    whole = case(number)
    common = {
        "number": number,
        "kind": whole.kind,
        "plan": whole.bench.label,
        "hidden": dict(whole.hidden),
        "commit": commit,
        "code": code,
    }
    try:
        it = measured(number)
    except RuntimeError as error:
        return Trial(
            **common, share=0.0, sizes={}, verdict="", sets=(), selected=(), errors={}, seconds={},
            failed={BENCH: str(error)},
        )  # fmt: skip
    book = compared(it, known)
    return Trial(
        **common,
        share=it.share,
        sizes=it.sizes,
        verdict=book.verdict,
        sets=tuple(_hideable(names) for names in book.sets),
        selected=_hideable(book.selected),
        errors=book.errors,
        seconds=book.seconds,
        failed=book.failed,
    )


def _hideable(names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(name for name in names if name != ALWAYS)
