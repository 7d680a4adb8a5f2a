"""Predicted readings in sentences, written from the record."""

from __future__ import annotations

from collections.abc import Iterator

from pipeline.predict.predicting import Predicted
from pipeline.predict.record import Counted, Predictions
from reports.quantities import percent, short
from vjm.effects.sensor_fault import SensorFault

SHOWN = 3


def sentences(it: Predictions, remarks: tuple[str, ...] = (), nothing: str = "") -> tuple[str, ...]:
    """All that is worth saying, the headline first. remarks: about the campaign and the table. nothing: why the model
    was tested by nothing."""
    return (headline(it), *_how(it, nothing), *_where(it), *(f"{said}." for said in (*remarks, *it.not_done)))


def about(it: Predicted) -> tuple[str, ...]:
    """Remarks about what was asked that the record does not say: zeros, sensors, temperatures."""
    said = []
    loose = it.tangent.cases.loose
    unknown = [test.id for k, test in enumerate(it.asked.tests) if it.asked.own and loose[k].any()]
    if unknown:
        said.append(
            f"Zeros of sensors are not known, or by one reading, in {len(unknown)} tests, the first is {unknown[0]}: "
            "their readings are compared less the zero that fits each test best"
        )
    if it.asked.own:
        return tuple(said)
    faults = [t.effect.name for t in it.tangent.posterior.model.terms if isinstance(t.effect, SensorFault)]
    if faults:
        said.append(
            f"{', '.join(faults)} is in the predicted readings; what follows the rows of a campaign follows those of "
            "the table"
        )
    heated = any(test.data.temperature is not None for test in it.fitted.whole.tests)
    if heated and all(test.data.temperature is None for test in it.asked.tests):
        said.append("The table has no temperature_C: the rig counts as at its reference temperature")
    return tuple(said)


def headline(it: Predictions) -> str:
    """How many readings are predicted, and how many that were made lie inside."""
    count = sum(len(row.readings) for row in it.rows)
    rows = len(it.rows)
    said = f"{count} {_readings(count)} predicted at {rows} {'row' if rows == 1 else 'rows'}"
    parts = [
        f"95 % intervals hold {_counted(counts)} {name}"
        for counts, name in ((it.held_out, "that were not fitted"), (it.fitted, "that were fitted"))
        if counts.of
    ]
    return f"{'; '.join([said, *parts])}."


def _counted(it: Counted) -> str:
    return f"{100.0 * it.inside / it.of:.1f} % of the {it.of} {_readings(it.of)}"


def _readings(count: int) -> str:
    return "reading" if count == 1 else "readings"


def _how(it: Predictions, nothing: str) -> Iterator[str]:
    model = ", ".join(it.effects) or "plain virtual springs"
    way = "from the tangent of the model at the fit"
    if it.sampled == len(it.rows):
        way = "by samples, each solved for: the model is not straight over its uncertainty"
    elif it.sampled:
        way = (
            f"{way}, of {it.sampled} rows by samples, each solved for: the model is not straight there over its "
            "uncertainty"
        )
    yield f"Model: {model}; intervals {way}."
    if nothing:
        yield f"The parameters count as exact: {nothing.rstrip('.')}."
    if it.noise_factor > 1.0:
        yield (
            f"What the fit leaves is {short(it.noise_factor)} times the noise: noise and parameters are wider by that "
            "factor, and what the model lacks may be larger elsewhere."
        )
    for name in it.at_bound:
        yield f"{name} ends at its bound: the intervals count it as free on both sides of that."
    for group in it.combined:
        names = " and ".join([", ".join(group[:-1]), group[-1]] if len(group) > 1 else group)
        what = "only combinations of" if len(group) > 1 else "nothing of"
        yield (
            f"The fitted tests determine {what} {names}; a reading that depends on it otherwise has a wide interval, "
            "by its plausible size."
        )


def _where(it: Predictions) -> Iterator[str]:
    beyond = [row for row in it.rows if row.beyond]
    if beyond:
        first = beyond[0]
        said = "; ".join(first.beyond[:SHOWN])
        yield (
            f"{len(beyond)} of {len(it.rows)} rows lie beyond what was fitted, there the model extrapolates; the first "
            f"is {first.test}, step {first.step}: {said}."
        )
    lost = [row for row in it.rows if row.lost]
    if lost:
        yield f"{len(lost)} rows have no prediction; the first is {lost[0].test}, step {lost[0].step}: {lost[0].lost}."
    if it.comparison:
        worst = max(it.comparison, key=lambda each: abs(each.error) / max(each.u_val, 1e-300))
        yield (
            f"Predicted less measured in tests that were not fitted is farthest from zero in {worst.column}: "
            f"{short(worst.error)} on average of {worst.readings}, with a standard uncertainty of one reading of "
            f"{short(worst.u_val)} (ASME V&V 20)."
        )
    for each in it.budget:
        if each.sources:
            first_source = each.sources[0]
            what = "what is written about" if first_source.kind == "tolerance" else "the noise of"
            share = percent(first_source.share)
            yield f"{each.parameter} is limited by {what} {first_source.name}: {share} of its variance."
