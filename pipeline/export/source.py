"""From a campaign with its model, a result of `run` or the record of `bar`, to what is exported."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
from numpy.linalg import LinAlgError

from pipeline.bar.part_result import PartResult
from pipeline.bar.record import BarRecord
from pipeline.campaign import Campaign, Rig, read
from pipeline.campaign.reading import DESCRIPTION
from pipeline.errors import InputError
from pipeline.export.content import Export, Linkage, Spring
from pipeline.inference.model import Model
from pipeline.inference.model_file import NAME
from pipeline.inference.model_reading import read_model_file
from pipeline.inference.suitable import known_effects
from pipeline.provenance import made_with
from pipeline.validation.result import read_result
from vjm.equilibrium import unloaded
from vjm.frames import Array, exp, inverse_rotation_jacobian
from vjm.link import Link
from vjm.lumped import Lumped
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stiffness import rank, unloaded_stiffness

RESULT, RECORD = "result.json", "bar.json"
BAR_FRAME = "bar frame: x along the bar from base hinge to tip, y along the hinges, origin at the base hinge"
BASE_FRAME = "base frame: x along the bars at q = 0, y along the hinges, z along the width, origin amid the base hinges"
ALLOWED = "allowed are a campaign's folder, the result.json of run and the bar.json of bar"
SAME = 1e-9
"""Relative difference below which two matrices are one: far above rounding, far below any effect."""


@dataclass(frozen=True)
class Sources:
    """What was asked for. q_deg: angle of a parallelogram; None: every angle of the source."""

    path: Path
    q_deg: float | None = None
    model: Path | None = None
    effects_from: Sequence[Path] = ()


@dataclass(frozen=True, eq=False)
class _Found:
    """A mechanism with its effects, at which angles, and of which files."""

    model: Model
    build: Callable[[Model], Bar | Parallelogram]
    angles: tuple[float, ...]
    digests: Mapping[str, str]


def exported(asked: Sources) -> Export:
    """What is to be written. InputError for a source that is none, RuntimeError where there is no stiffness."""
    found = _found(asked)
    if asked.q_deg is not None:
        if isinstance(found.build(Model()), Bar):
            raise InputError(
                f"--q is the angle of a parallelogram, {asked.path} is a single bar, which has none"
            )
        if not abs(asked.q_deg) < 90.0:
            raise InputError(f"--q is {asked.q_deg:g}, allowed are degrees between -90 and 90")
    model, angles = found.model, found.angles if asked.q_deg is None else (asked.q_deg,)
    whole = _Stiffness(found.build(model), angles, model.turn)
    without = {name: _Stiffness(found.build(model.without(name)), angles, model.turn) for name in model.names}
    bars = whole.bars
    if len({_key(bar) for bar in bars}) == 1:
        bars = (
            (replace(bars[0], what=bars[0].what.replace(" of bar 1 ", " of each bar ")),)
            if bars[1:]
            else bars
        )
    return Export(
        source=str(asked.path),
        digests=found.digests,
        bars=bars,
        linkages=whole.linkages,
        chosen=asked.q_deg is not None,
        effects={term.effect.name: dict(term.values) for term in model.terms},
        in_bars=frozenset(name for name, other in without.items() if _differ(whole.bars, other.bars)),
        in_whole=frozenset(
            name
            for name, other in without.items()
            if _differ(whole.bars, other.bars) or _differ(whole.wholes, other.wholes)
        ),
        **made_with(),
    )


class _Stiffness:
    """The springs of a mechanism. turn: rad by which its bars stand beside the angle that is named."""

    def __init__(self, mechanism: Bar | Parallelogram, angles: Iterable[float], turn: float) -> None:
        links = mechanism.links
        self.bars = tuple(_bar(number, link, len(links)) for number, link in enumerate(links, 1))
        self.linkages: tuple[Linkage, ...] = ()
        if isinstance(mechanism, Parallelogram):
            first, second = self.bars
            at = {q: replace(mechanism, q=float(np.radians(q)) + turn) for q in angles}
            self.linkages = tuple(
                Linkage(q, it.width + it.wider, _tips(it), (first, second), _whole(it, q))
                for q, it in at.items()
            )

    @property
    def wholes(self) -> tuple[Spring, ...]:
        """K_p at every angle."""
        return tuple(linkage.whole for linkage in self.linkages)


def _found(asked: Sources) -> _Found:
    path = asked.path
    if path.is_dir() and (path / DESCRIPTION).exists():
        return _of_campaign(read(path), asked)
    file = (
        next((p for p in (path / RESULT, path / RECORD) if p.is_file()), path / RESULT)
        if path.is_dir()
        else path
    )
    if not file.is_file():
        what = f"has neither {DESCRIPTION} nor {RESULT} nor {RECORD}" if path.is_dir() else "is missing"
        raise InputError(f"{path} {what}, {ALLOWED}")
    if file.suffix != ".json":
        raise InputError(f"{path} is no result of run, {ALLOWED}")
    if asked.model is not None or asked.effects_from:
        raise InputError(f"--model and --effects-from belong to a campaign, {path} is a result of run")
    mechanism, angles = _computed(file)
    return _Found(Model(), lambda _: mechanism, angles, {file.name: _digest(file)})


def _computed(file: Path) -> tuple[Bar | Parallelogram, tuple[float, ...]]:
    """The mechanism of a result of `run` or of the record of `bar`, and the angles that were computed.

    A record without a width is that of a single bar.
    """
    kind = _kind(file)
    if kind == "bar":
        record = BarRecord.read(file, "record of bar")
        k_b = _symmetric(record.stiffness)
        if record.width_mm is None:
            return Bar(record.length_mm, k_b), ()
        return Parallelogram(record.length_mm, record.width_mm, k_b), (0.0,)
    result = PartResult.read(file, "saved result") if kind == "part" else read_result(file)
    linkage = Parallelogram(result.length_mm, result.width_mm, _symmetric(result.bar.stiffness))
    return linkage, tuple(each.q_deg for each in result.parallelogram)


def _kind(file: Path) -> str | None:
    """What a file says that it is; None where it says nothing or cannot be read."""
    try:
        raw = json.loads(file.read_bytes())
    except (OSError, ValueError):
        return None
    found = raw.get("kind") if isinstance(raw, dict) else None
    return found if isinstance(found, str) else None


def _of_campaign(campaign: Campaign, asked: Sources) -> _Found:
    if not isinstance(campaign.rig.mechanism(()), Bar | Parallelogram):
        raise InputError(
            f"{asked.path} is a campaign of a {campaign.rig.kind}, allowed are those of a bar or a parallelogram"
        )
    file, digests, model = asked.model or asked.path / NAME, dict(campaign.digests), Model()
    if asked.model is not None or file.exists():
        known = known_effects(asked.effects_from).sized(campaign)
        model = read_model_file(file, known, campaign.rig).model
        digests[file.name] = _digest(file)
    try:
        _built(campaign.rig.drawn, model)
    except ValueError as error:
        raise InputError(f"{file}: {error}") from error
    angles = dict.fromkeys(test.q_deg for test in campaign.tests)
    return _Found(model, partial(_built, campaign.rig.drawn), tuple(angles), digests)


def _built(rig: Rig, model: Model) -> Bar | Parallelogram:
    it = model.mechanism(rig, ())
    assert isinstance(it, Bar | Parallelogram)
    return it


def _bar(number: int, link: Link, count: int) -> Spring:
    # Lumped at its tip it has the 6x6 of the straight bar with its bow and its ends; yielding begins above no load.
    stiffness = Lumped("tip").limb(replace(link, fibres=None)).stiffness
    of = "the bar" if count == 1 else f"bar {number}"
    return Spring(
        name="K_b" if number == 1 else f"K_b{number}",
        what=f"K_b of {of} with what gives at its ends, at its tip, base clamped",
        frame=BAR_FRAME,
        matrix=_symmetric(stiffness),
        base=np.zeros(3),
        point=np.array([link.length, 0.0, 0.0]),
        length=link.length,
        rank=int(rank(stiffness, link.length)),
    )


def _whole(mechanism: Parallelogram, q_deg: float) -> Spring:
    try:
        stiffness = unloaded_stiffness(mechanism)
    except LinAlgError:
        raise RuntimeError(
            f"K_p at {q_deg:g} degrees does not exist at no load: a hinge or a contact of the model is rigid or loose "
            "there; give a model without it by --model FILE"
        ) from None
    pose = unloaded(mechanism).pose
    # From rates of the rotation vector, which a tilted platform counts from as drawn, to small turns about the axes.
    turns = np.eye(6)
    turns[3:, 3:] = inverse_rotation_jacobian(pose[3:])
    stiffness = _symmetric(turns.T @ stiffness @ turns)
    return Spring(
        name="K_p",
        what=f"K_p of the parallelogram at q = {q_deg:g} degrees, at the platform point, base clamped",
        frame=BASE_FRAME,
        matrix=stiffness,
        base=np.zeros(3),
        point=np.asarray(pose[:3]),
        length=mechanism.length,
        rank=int(rank(stiffness, mechanism.length)),
        q_deg=q_deg,
    )


def _tips(mechanism: Parallelogram) -> Array:
    """(2, 3) mm, where the tip hinges stand without load when the linkage is mounted as drawn."""
    pose = unloaded(replace(mechanism, mount=np.zeros(3))).pose
    half = exp(pose[3:]) @ np.array([0.0, 0.0, 0.5 * (mechanism.width + mechanism.wider)])
    return np.stack([pose[:3] - half, pose[:3] + half])


def _differ(some: Sequence[Spring], others: Sequence[Spring]) -> bool:
    """Whether matrices or points are not the same, rotations counted as arcs."""
    for one, other in zip(some, others, strict=True):
        arc = np.repeat([1.0, one.length], 3)
        scaled = [each.matrix / np.outer(arc, arc) for each in (one, other)]
        if np.abs(scaled[0] - scaled[1]).max() > SAME * np.abs(scaled[0]).max():
            return True
        if np.abs(one.point - other.point).max() > SAME * one.length:
            return True
    return False


def _key(bar: Spring) -> tuple[float, bytes]:
    return bar.length, bar.matrix.tobytes()


def _symmetric(matrix: object) -> Array:
    found = np.asarray(matrix, dtype=float)
    return np.asarray(0.5 * (found + found.T))


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
