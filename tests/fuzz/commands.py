"""What compare, diagnose, plan, improve and add make of a small table, in process, and what is wrong with it."""

from __future__ import annotations

import re
import tempfile
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from time import process_time
from typing import Any, get_args

import numpy as np

from pipeline.add.fitting import add
from pipeline.answer.of_diagnosis import answered
from pipeline.answer.record import Answer, Verdict
from pipeline.campaign import Campaign, read
from pipeline.compare.models import compare_models
from pipeline.errors import InputError
from pipeline.improve.steps import steps
from pipeline.inference.model import Model
from pipeline.inference.suitable import Known, known_effects, named_effects
from pipeline.opened import starting_model
from pipeline.plan.command import plan_of
from pipeline.predict.asked import own_rows
from pipeline.predict.predicting import fitted_to, predicted
from pipeline.predict.recording import recorded
from pipeline.record import Record
from pipeline.selection.diagnosis import Diagnosis, diagnose
from tests.fuzz.tables import Files

LIMIT = 60.0
"""Seconds of this process that all commands may take for one small table, whatever else the machine does."""
LIBRARY = re.compile(
    r"SVD|ingular matrix|positive definite|LinAlgError|illegal value"
    r"|validation error|array dimension|broadcast|not foreseen|must be finite"
)
"""What a library says of itself, or this project of arrays that its own code hands on."""


@dataclass
class Seen:
    """What came of one table. done: `refused` or what each command found. faults: a sentence or a traceback each.

    failed: optional parts that the answer says it could not do; no fault, but worth a look.
    """

    done: dict[str, str] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)
    refusals: list[str] = field(default_factory=list)
    failed: list[str] = field(default_factory=list)
    parts: dict[str, float] = field(default_factory=dict)

    @property
    def seconds(self) -> float:
        """Of all commands."""
        return sum(self.parts.values())

    def attempt(self, what: str, work: Callable[[], str]) -> None:
        """Runs a command; InputError is a result, anything else that is raised a fault."""
        start = process_time()
        try:
            self.done[what] = work()
        except InputError as error:
            self.done[what] = "refused"
            self.refusals.append(str(error))
            self.faults += [f"{what}: {fault}" for fault in _library(str(error))]
        except Exception:
            self.done[what] = "raised"
            self.faults.append(f"{what}: {traceback.format_exc()}")
        self.parts[what] = process_time() - start


def looked(files: Files) -> Seen:
    """All commands on one table; one that fails leaves the others."""
    seen = Seen()
    with tempfile.TemporaryDirectory() as name:
        began: list[tuple[Campaign, Model, Known]] = []

        def entered() -> str:
            folder = files.laid(Path(name))
            campaign = read(folder)
            began.append((campaign, *starting_model(campaign, folder, None, known_effects())))
            return "read"

        seen.attempt("read", entered)
        if began:
            _commands(seen, files, *began[0])
    if seen.seconds > LIMIT:
        seen.faults.append(f"slow: {seen.seconds:.0f} s")
    return seen


def _commands(seen: Seen, files: Files, campaign: Campaign, model: Model, known: Known) -> None:
    found: list[Diagnosis] = []

    def compared() -> str:
        result = compare_models(campaign, model if model.terms else None)
        seen.faults += [f"compare: {fault}" for fault in _record(result)]
        seen.failed += [f"compare: {said}" for said in result.not_done]
        return "compared"

    def diagnosed() -> str:
        found.append(diagnose(campaign, model, known.effects))
        answer = answered(found[0])
        _judged(seen, "diagnose", answer)
        return answer.verdict

    def planned() -> str:
        seen.faults += [f"plan: {fault}" for fault in _record(plan_of(campaign, model, known.effects))]
        return "planned"

    def improved() -> str:
        way = list(steps(found[0]))
        seen.faults += [f"improve: {fault}" for step in way for fault in _record(step.error)]
        return f"{len(way)} steps"

    def added() -> str:
        it = add(campaign, model, named_effects([files.adding], known.effects))
        _judged(seen, "add", it.answer)
        return it.answer.verdict

    def foretold() -> str:
        found = recorded(predicted(fitted_to(campaign, model), own_rows(campaign)))
        seen.faults += [f"predict: {fault}" for fault in _record(found)]
        seen.failed += [f"predict: {said}" for said in found.not_done]
        return "predicted"

    seen.attempt("compare", compared)
    seen.attempt("predict", foretold)
    seen.attempt("diagnose", diagnosed)
    seen.attempt("plan", planned)
    if found:
        seen.attempt("improve", improved)
    seen.attempt("add", added)


def _judged(seen: Seen, what: str, answer: Answer) -> None:
    seen.faults += [f"{what}: {fault}" for fault in (*_record(answer), *_verdict(answer))]
    seen.failed += [f"{what}: {said}" for said in answer.not_done]


def _record(it: Record) -> Iterator[str]:
    """Numbers that are not finite, and words of a library."""
    for place, value in _leaves(it.model_dump(), ""):
        if isinstance(value, str):
            yield from (f"{place}: {fault}" for fault in _library(value))
        elif isinstance(value, float) and not np.isfinite(value):
            yield f"{place} is {value}"


def _library(said: str) -> Iterator[str]:
    if LIBRARY.search(said):
        yield f"words of a library: {said}"


def _leaves(it: Any, place: str) -> Iterator[tuple[str, Any]]:
    if isinstance(it, dict | list | tuple):
        for key, value in it.items() if isinstance(it, dict) else enumerate(it):
            yield from _leaves(value, f"{place}.{key}")
    else:
        yield place, it


def _verdict(answer: Answer) -> Iterator[str]:
    if answer.verdict not in get_args(Verdict):
        yield f"verdict {answer.verdict}"
    if answer.verdict != "identified":
        return
    if answer.error[-1].degrees < 1:
        yield f"identified with {answer.error[-1].degrees} degrees of freedom"
    for name, value in answer.parameters.items():
        if name.rsplit(".", 1)[0] not in answer.added:
            continue
        if value.interval == "undetermined":
            yield f"identified, but nothing determines {name}"
        if value.at_bound or name in answer.at_bound:
            yield f"identified, but {name} is at its bound"
