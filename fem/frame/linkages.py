"""Rigs with errors as frames: parallelogram and single bar."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fem.frame.batch import Bools
from fem.frame.chain import SLOTS
from fem.frame.errors import BarSectionError, Errors
from fem.frame.fibres import Fibres, grid
from fem.frame.joints import Joints
from fem.frame.model import Gauges, Model
from fem.frame.placed import Placed, anchored
from fem.frame.reference import Bars
from fem.frame.rig import Gauge, Rig
from fem.frame.section import Section
from fem.frame.sites import BASE
from fem.frame.so3 import exp, hat
from meshes.solid import Floats

ELEMENTS = 16
"""Elements a bar: at 0.06 rad and 4 kN, bows of 0.5 mm included, their error is below 0.2 µm, 3 µrad and 0.2 N."""


@dataclass(frozen=True, eq=False)
class Setup:
    """One test's rig, its angle q in rad, and its errors."""

    rig: Rig
    q: float
    errors: Errors


def model(
    setups: Sequence[Setup],
    gauges: Sequence[Gauge] = (),
    elements: int = ELEMENTS,
    placed: Sequence[Placed] = (),
) -> Model:
    """The frames of several tests, all with the placed laws. All rigs need the same number of bars; `elements` a power
    of two.

    Raises ValueError for other rigs, for a gauge on no bar, for errors that a rig cannot have and for sites that it
    does not have.
    """
    count = {s.rig.bars for s in setups}
    if len(count) != 1:
        raise ValueError("the rigs of one batch must have the same number of bars")
    if elements < 2 or elements & (elements - 1):
        raise ValueError(f"{elements} elements a bar, allowed are powers of two from 2")
    bars = count.pop()
    for s in setups:
        _check(s, gauges)
    e = [s.errors for s in setups]
    bow = _rows(e, "bar_initial_bow", "bow_y_mm", "bow_z_mm")
    mount = exp(_rows(e, "mounting_tilt", "rx_rad", "ry_rad", "rz_rad"))
    compliance = np.array([_values(x.base_compliance) for x in e])
    there = compliance > 0.0
    base_active = _with_base_laws(there, placed)
    weights = np.array([_known_weights(s.rig) for s in setups])
    lengths = np.array([s.rig.length + s.errors.dimension_error.length_mm for s in setups])
    length = np.repeat(lengths[:, None], bars, axis=1)
    length[:, 0] += [x.bar_length_mismatch.mismatch_mm for x in e]
    return Model(
        bars=Bars.of([_sections(s) for s in setups], bow, elements),
        length=length,
        expansion=np.array([x.thermal_expansion.alpha_per_K for x in e]),
        reference_temperature=np.array([s.rig.reference_temperature for s in setups]),
        joints=_with_laws(_joints(setups, mount), placed, setups),
        nominal=np.array([s.rig.platform(s.q) for s in setups]),
        mount=mount,
        base_active=base_active,
        base_stiffness=np.where(there, 1.0 / np.where(there, compliance, 1.0), 0.0),
        platform_force=weights[:, :3] + _rows(e, "self_weight", "fx_N", "fy_N", "fz_N"),
        line_load=weights[:, 3:] + _rows(e, "self_weight", *(f"line_{a}_N_per_mm" for a in "xyz")),
        cell=_cell(e),
        held=np.array([[c in s.rig.held for c in range(6)] for s in setups]),
        gauges=_gauges(gauges, len(setups)),
        fibres=_fibres(setups),
    )


def _rows(errors: Sequence[Errors], effect: str, *names: str) -> Floats:
    return np.array([[getattr(getattr(e, effect), n) for n in names] for e in errors])


def _values(effect: object) -> list[float]:
    return list(vars(effect).values())


def _check(setup: Setup, gauges: Sequence[Gauge]) -> None:
    rig, e = setup.rig, setup.errors
    if rig.bars == 1 and e.bar_length_mismatch.mismatch_mm:
        raise ValueError("bar_length_mismatch needs a parallelogram")
    if rig.bars == 1 and e.bar_stiffness_asymmetry.ratio != 1.0:
        raise ValueError("bar_stiffness_asymmetry needs a parallelogram")
    if any([*_values(e.actuator_compliance), e.link_compliance.scale != 1.0]):
        raise ValueError("actuator_compliance and link_compliance need a machine")
    for gauge in gauges:
        if not 1 <= gauge.bar <= rig.bars or not 0.0 <= gauge.station <= 1.0:
            raise ValueError(f"gauge {gauge.name!r} at {gauge.station:g} of bar {gauge.bar} is not on a bar")


def _known_weights(rig: Rig) -> Floats:
    down = np.asarray(rig.gravity, float) / np.linalg.norm(rig.gravity)
    return np.concatenate((rig.platform_weight * down, rig.line_weight * down))


def _sections(setup: Setup) -> list[Section]:
    scale = setup.errors.modulus_error.scale
    first = setup.rig.section if scale == 1.0 else setup.rig.section.scaled(scale)
    each = setup.errors.bar_section_error
    first = first if each == BarSectionError() else first.scaled_each(each.ea, each.eiy, each.eiz, each.gj)
    ratio = setup.errors.bar_stiffness_asymmetry.ratio
    second = first if ratio == 1.0 else first.scaled(ratio)
    return [first, second][: setup.rig.bars]


def _cell(errors: Sequence[Errors]) -> Floats:
    """(B, 6, 6) reading of the load cell for a wrench at the platform point: offset, then turn."""
    offset = np.zeros((len(errors), 6, 6))
    offset[:] = np.eye(6)
    offset[:, 3:, :3] = -hat(_rows(errors, "load_offset", "x_mm", "y_mm", "z_mm"))
    turn = np.zeros_like(offset)
    R = exp(_rows(errors, "load_misalignment", "rx_rad", "ry_rad", "rz_rad"))
    turn[:, :3, :3] = turn[:, 3:, 3:] = np.swapaxes(R, 1, 2)
    return np.asarray(turn @ offset)


def _joints(setups: Sequence[Setup], mount: Floats) -> Joints:
    tests, bars = len(setups), setups[0].rig.bars
    per_end = np.ones((tests, bars, 2))
    q = exp(np.array([[0.0, s.q, 0.0] for s in setups]))
    wide = np.array([s.rig.width + s.errors.dimension_error.width_mm for s in setups])
    across = np.array([-0.5, 0.5]) if bars == 2 else np.zeros(1)
    place = np.zeros((tests, bars, 2, 3))
    place[..., 2] = wide[:, None, None] * across[:, None]
    place[:, :, 0] = (mount[:, None] @ place[:, :, 0, :, None])[..., 0]
    frame = np.empty((tests, bars, 2, 3, 3))
    frame[:, :, 0], frame[:, :, 1] = (mount @ q)[:, None], q[:, None]
    hinge = np.array([[s.rig.hinged(0), s.rig.hinged(1)] for s in setups], bool)[:, None, :]
    e = [s.errors for s in setups]
    flexible = _rows(e, "axis_flexibility", "radial_mm_per_N", "tilt_rad_per_Nmm")[:, None, None, :]
    friction = _rows(e, "joint_friction", "torque_Nmm", "presliding_rad")[:, None, None, :]
    at_base = per_end * np.array([1.0, 0.0])
    play = _rows(e, "joint_clearance", "play_mm")[:, None] * at_base
    contact = _rows(e, "contact_stiffening", "c_mm_per_N23")[:, None] * at_base
    size = {
        "hinge": per_end,
        "play": play,
        "contact": contact,
        "radial_x": flexible[..., 0] * per_end,
        "radial_z": flexible[..., 0] * per_end,
        "tilt_x": flexible[..., 1] * per_end,
        "tilt_z": flexible[..., 1] * per_end,
    }
    there = {slot: (size[slot] > 0.0) & hinge for slot in SLOTS}
    slots = tuple(slot for slot in SLOTS if there[slot].any())
    empty = np.zeros((*per_end.shape, 0))
    return Joints(
        place=place,
        frame=frame,
        active=np.stack([there[s] for s in slots], -1) if slots else empty.astype(bool),
        compliance=np.stack([size[s] for s in slots], -1) if slots else empty,
        return_spring=_rows(e, "joint_torsional_stiffness", "stiffness_Nmm_per_rad")[:, None] * per_end,
        torque=friction[..., 0] * per_end,
        presliding=friction[..., 1] * per_end,
        relaxed=0.0 * per_end,
        play=play,
        contact=contact,
        bodies=((0, 1),) * bars,
        slots=slots,
    )


def _with_laws(joints: Joints, placed: Sequence[Placed], setups: Sequence[Setup]) -> Joints:
    """The joints with the coordinates of series laws after their own."""
    if not placed:
        return joints
    hinged = np.array([[s.rig.hinged(0), s.rig.hinged(1)] for s in setups], bool)
    laws, slots = anchored(placed, joints.slots, hinged, joints.active.shape[1])
    active = np.zeros((*joints.active.shape[:3], len(slots)), bool)
    active[..., : len(joints.slots)] = joints.active
    for law in laws:
        if not law.of_base and not law.of_hinge:
            active[..., law.slot] = law.at
    compliance = np.zeros(active.shape)
    compliance[..., : len(joints.slots)] = joints.compliance
    return replace(joints, active=active, compliance=compliance, slots=slots, placed=laws)


def _with_base_laws(springs: Bools, placed: Sequence[Placed]) -> Bools:
    """(B, 6) coordinates of the base that give, by springs or by laws."""
    out = springs.copy()
    for it in placed:
        if it.site in BASE:
            if out[:, BASE.index(it.site)].any():
                raise ValueError(
                    f"{it.site}: the base gives along it already, allowed is one law or compliance"
                )
            out[:, BASE.index(it.site)] = True
    return out


def _gauges(gauges: Sequence[Gauge], tests: int) -> Gauges:
    direction = np.array([g.direction for g in gauges], float).reshape(len(gauges), 3)
    offset = np.array([g.offset or (0.0, 0.0, 0.0) for g in gauges], float).reshape(len(gauges), 3)
    return Gauges(
        tuple(None if g.offset is not None else g.bar - 1 for g in gauges),
        np.tile(np.array([g.station for g in gauges], float), (tests, 1)),
        np.tile(direction, (tests, 1, 1)),
        np.tile(offset, (tests, 1, 1)),
    )


def _fibres(setups: Sequence[Setup]) -> Fibres | None:
    limit = np.array([s.errors.material_yield.strain for s in setups])
    if not np.isfinite(limit).any():
        return None
    rows = []
    for s in setups:
        section = s.rig.section
        elastic = not np.isfinite(s.errors.material_yield.strain)
        edges = (np.inf, np.inf) if elastic else (s.rig.fibre_y, s.rig.fibre_z)
        rows.append(
            tuple(np.zeros(49) for _ in range(3))
            if elastic
            else grid(*edges, section.EA, section.about_y.EI, section.about_z.EI)
        )
    y, z, weight = (np.array(column) for column in zip(*rows, strict=True))
    return Fibres(y, z, weight, limit)
