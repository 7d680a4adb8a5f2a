"""What adding effects changed, in sentences."""

from __future__ import annotations

from collections.abc import Iterator

from pipeline.answer.record import LEVEL, Answer, ModelError
from reports.quantities import Estimate, short, sigma, value_text

CLEARLY = 1.0 - LEVEL
MANY = 4
"""Sets that are named where more could be."""


def verdict_sentence(answer: Answer, nothing: str = "") -> str:
    """The verdict with its numbers. nothing: why nothing could be tested."""
    if answer.verdict == "nothing_tested":
        return nothing or "nothing_tested: no reading is left to test the model by."
    before, after = answer.error[0], answer.error[-1]
    fall = f"error {sigma(before.fit)} -> {sigma(after.fit)} sigma (whitened RMS, 1 is noise)"
    if after.holdout is not None and before.holdout is not None:
        fall += f", held-out tests {sigma(before.holdout)} -> {sigma(after.holdout)}"
    if answer.verdict == "within_noise":
        return f"within_noise: what is left looks like noise; {fall}."
    return f"{answer.verdict}: {_not_noise(after)}; {fall}."


def sentences(
    answer: Answer, remarks: tuple[str, ...], nothing: str = "", units: tuple[str, ...] = (), keep: str = ""
) -> tuple[str, ...]:
    """All that is worth saying, the verdict first. nothing: why nothing could be tested. units: what is known of
    channels without a sigma. keep: why the model is not saved."""
    details = () if answer.verdict == "nothing_tested" else _details(answer)
    unsaved = (f"The model is not saved: {keep}.",) if keep else ()
    failed = (f"{said}." for said in answer.not_done)
    return (
        verdict_sentence(answer, nothing),
        *unsaved,
        *units,
        *details,
        *_lost(answer),
        *failed,
        *(f"{r}." for r in remarks),
    )


def _not_noise(error: ModelError) -> str:
    if error.lost:
        return "the model has no prediction for some rows"
    said = "; ".join(error.not_noise)
    return f"what is left is no noise: {said}"


def _with(answer: Answer) -> str:
    return f", with {', '.join(answer.added)}" if answer.added else ""


def _details(answer: Answer) -> Iterator[str]:
    before, after = answer.error[0], answer.error[-1]
    if before.chi_square is not None and after.chi_square is not None:
        numbers = before.degrees - after.degrees if answer.added else 0
        gain = before.chi_square - after.chi_square
        word = "fell" if gain >= 0.0 else "rose"
        cost = {0: "without a further number that they determine", 1: "for one further number"}
        yield (
            f"Chi-square {word} by {short(abs(gain), 4)} to {short(after.chi_square, 4)} on {after.degrees} degrees of "
            f"freedom, {cost.get(numbers, f'for {numbers} further numbers')}{_with(answer)}."
        )
    if after.chi_square_p is not None and after.chi_square_p > CLEARLY:
        yield "The residual is smaller than its noise: the sigmas of the campaign may be too large."
    if answer.parameters and after.chi_square_p is not None and after.chi_square_p < LEVEL:
        yield (
            "The intervals assume that the noise is as given and the model complete; what is left is larger "
            "than noise, so they are too narrow."
        )
    for name in _absent(answer):
        yield f"{name} is not larger than zero by these tests: its interval begins where the effect is absent."
    yield from limits(answer)
    yield from written(answer)
    alone = [group[0] for group in answer.undetermined if len(group) == 1]
    if alone:
        yield f"These tests say nothing about {_list(tuple(alone))}: not determined."
    for group in answer.undetermined:
        if len(group) > 1:
            yield f"Only combinations of {_list(group)} are determined by these tests, none of them alone."
    for pair in answer.correlations:
        yield f"{pair.first} and {pair.second} are hardly told apart: correlation {pair.value:+.3f}."


def limits(answer: Answer) -> Iterator[str]:
    """Parameters whose fit ended at their bound, and sets that only an implausible size makes fit."""
    for name in answer.at_bound:
        yield f"{name} ends at its bound: what the effect explains there, it explains with a size that is not allowed."
    out = [" + ".join(names) for names in answer.out_by_plausibility]
    if len(out) == 1:
        yield f"{out[0]} would fit as well, but only with an implausible size."
    elif out:
        more = f" and {len(out) - MANY} more" if len(out) > MANY else ""
        yield f"Only with implausible sizes would fit as well: {'; '.join(out[:MANY])}{more}."


def written(answer: Answer) -> Iterator[str]:
    """What was written about the rig and fits best far from that, and what is not seen."""
    if answer.as_written is not None:
        yield (
            f"With the rig exactly as it is written {sigma(answer.as_written)} sigma are left; all errors here begin "
            "with it where it fits best within its tolerances."
        )
    far = sorted((it for it in answer.nominals if it.moved), key=lambda it: -abs(it.pull))
    if far:
        said = "; ".join(
            f"{it.name} = {value_text(Estimate(it.value, it.std))}{'' if it.unit == '1' else f' {it.unit}'}, written "
            f"{it.nominal:g} ± {it.tolerance:g} ({it.pull:+.1f} of that)"
            for it in far
        )
        yield f"Of what is written about the rig some fits best elsewhere: {said}."
    seen = [it.name for it in answer.nominals if it.seen]
    if answer.nominals:
        told = f"more of {_list(tuple(seen))} than is written" if seen else "no more than is written"
        yield f"These tests say {told} about the rig{'; the rest stays as it was' if seen else ''}."


def _absent(answer: Answer) -> Iterator[str]:
    for name, it in answer.parameters.items():
        if it.interval == "profile" and it.low95 == 0.0 and it.value >= 0.0:
            yield name


def _lost(answer: Answer) -> Iterator[str]:
    was, now = set(answer.error[0].lost), answer.error[-1].lost
    for said in now:
        yield f"{said}."
    gone = len(was - set(now))
    if gone and not now:
        yield f"Rows without a prediction before, in {gone} tests, have one now."


def _list(names: tuple[str, ...]) -> str:
    *others, last = names
    return f"{', '.join(others)} and {last}" if others else last
