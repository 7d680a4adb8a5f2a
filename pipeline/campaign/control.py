"""What is prescribed in a test, and whether the mechanism can be held that way."""

import numpy as np

from pipeline.campaign.model import Array, Gauge, Rig, Test
from pipeline.campaign.names import COORDINATES, DISPLACEMENT, FORCE, SUPPORT
from pipeline.toml.complaints import shown
from pipeline.toml.spelling import unknown_name

NEARLY_ALONG = np.sin(np.radians(1.0))
"""A coordinate within a degree of the bars' direction does not keep them from swinging."""
SIGMAS = 5.0
"""A reading counts as a load beyond so many sigma: one in 1.7 million rows is noise."""
WAYS = (DISPLACEMENT, FORCE, SUPPORT)
"""What may control a coordinate without a gauge."""
PART = 0.01
"""Where no sigma is known, a reading counts as a load from this part of the largest one."""


def controls(written: dict[str, str], rig: Rig, names: list[str]) -> tuple[tuple[str, ...], list[str]]:
    """What controls each of the six coordinates, and what is wrong with what was written; names: of the gauges."""
    supported = rig.supports
    said = [
        f"{shown(key)} is no coordinate, {unknown_name(key, COORDINATES)}"
        for key in written
        if key not in COORDINATES
    ]
    for key, by in written.items():
        if key in supported:
            said.append(f"{key} is held by {supported[key]} already, allowed is to leave it out")
        elif key in COORDINATES and by not in (*WAYS, *names):
            near = unknown_name(by, (*WAYS, *names))
            said.append(f"{key} is {shown(by)}, neither displacement nor force nor held nor a gauge; {near}")
    if missing := [key for key in COORDINATES if key not in supported and key not in written]:
        said.append(
            f"{', '.join(missing)} missing, allowed is displacement, force, held or a gauge for each coordinate"
        )
    twice = [name for name in names if list(written.values()).count(name) > 1]
    said += [f"gauge {name} controls two coordinates, allowed is one" for name in twice]
    return tuple(SUPPORT if key in supported else written.get(key, FORCE) for key in COORDINATES), said


def swings(rig: Rig, q: float, control: tuple[str, ...], gauges: tuple[Gauge, ...]) -> bool:
    """Whether the rig has a motion that costs no energy, and no coordinate that is moved or held keeps it from that."""
    motion = rig.swing(q)
    if motion is None:
        return False
    by_name = {gauge.name: gauge for gauge in gauges}
    for k, by in enumerate(control):
        if by in (DISPLACEMENT, SUPPORT) and abs(motion[k]) > (NEARLY_ALONG if k < 3 else 0.0):
            return False
        if by in by_name:
            gauge = by_name[by]
            moved = gauge.station * motion[:3]
            if gauge.offset is not None:
                moved = motion[:3] + np.cross(motion[3:], gauge.offset)
            seen = np.dot(gauge.vector, moved)
            if abs(seen) > NEARLY_ALONG:
                return False
    return True


def pull(rig: Rig, q: float, displacement: Array, wrench: Array, sigmas: tuple[Array, Array]) -> Array:
    """(N,) -1 where the bars are pushed, 1 where they are pulled, 0 where neither is sure.

    displacement, wrench: (N, 6), NaN not measured. sigmas: (6,) of each, NaN not known. The force along the bars
    is read where the cell gives it, else the travel along them.
    """
    along = rig.along(q)
    # At small angles a reading that hardly counts must not be missing.
    along = np.where(np.abs(along) > NEARLY_ALONG, along, 0.0)
    verdict = np.zeros(len(wrench))
    for values, sigma in ((displacement, sigmas[0]), (wrench, sigmas[1])):
        used = along != 0.0
        reading = values[:, :3][:, used] @ along[used]
        noise = SIGMAS * np.linalg.norm(sigma[:3][used] * along[used])
        known = np.isfinite(reading)
        if not known.any():
            continue
        edge = noise if np.isfinite(noise) else PART * np.max(np.abs(reading[known]))
        verdict[known] = np.where(np.abs(reading[known]) > edge, np.sign(reading[known]), 0.0)
    return verdict


def control_channels(test: Test, gauges: tuple[Gauge, ...]) -> list[int]:
    """Channel that is prescribed for each of the six coordinates."""
    names = [gauge.name for gauge in gauges]
    plain = {DISPLACEMENT: 0, SUPPORT: 0, FORCE: 6}
    return [k + plain[by] if by in plain else 12 + names.index(by) for k, by in enumerate(test.control)]
