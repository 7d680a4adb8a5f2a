"""Whether the data of a test can be what its control, its rig and its sensors allow."""

import numpy as np

from pipeline.campaign.control import pull, swings
from pipeline.campaign.head import Head
from pipeline.campaign.model import Array, Data, Gauge, Noise
from pipeline.campaign.names import COORDINATES, DISPLACEMENT, DISPLACEMENTS, FORCE, SUPPORT, gauge_column
from pipeline.campaign.rig import LARGE_TURN
from pipeline.toml.complaints import Complaints, lines_named, shown

HELD_Z = (
    f'z = "{DISPLACEMENT}" with a column z_mm, or z = "{SUPPORT}" where a clamp keeps it where it is unloaded'
)


def judge(
    head: Head, data: Data, gauges: tuple[Gauge, ...], noise: Noise, columns: set[str], complaints: Complaints
) -> list[str]:
    """Complaints about one test's data; returns remarks. `columns`: those that the file has."""
    place = f"test {shown(head.id)}"
    q = float(np.radians(head.q_deg))
    _controlled(head, data, gauges, columns, complaints, place)
    _clamped_readings(head, data, complaints, place)
    _reach(head, data, complaints, place)
    _held(head, data, gauges, noise, q, complaints, place)
    if data.temperature is not None:
        cold = data.temperature < -273.15
        for line in data.lines[cold][:1]:
            said = f"reads {data.temperature[cold][0]:g}, allowed is -273.15 and above"
            complaints.add("column temperature_C", said, int(line))
        if head.rig.reference_temperature is None:
            said = "temperature_C is measured, allowed with rig.reference_temperature_C in campaign.toml"
            complaints.add(place, said)
    return [*_turns(head, data, complaints, place), *_nothing_to_predict(head, data, place)]


def _controlled(
    head: Head,
    data: Data,
    gauges: tuple[Gauge, ...],
    columns: set[str],
    complaints: Complaints,
    place: str,
) -> None:
    """A controlled displacement or gauge has to be there in every row."""
    names = [gauge.name for gauge in gauges]
    for k, by in enumerate(head.control):
        if by in (FORCE, SUPPORT) or (by != DISPLACEMENT and by not in names):
            continue
        column = DISPLACEMENTS[k] if by == DISPLACEMENT else gauge_column(by)
        values = data.displacement[:, k] if by == DISPLACEMENT else data.gauges[:, names.index(by)]
        kind = "displacement" if by == DISPLACEMENT else f"gauge {by}"
        why = f"{place} controls {COORDINATES[k]} by {kind}"
        if column not in columns:
            complaints.add(f"column {column}", f"is missing, but {why}{_clamped(COORDINATES[k], by)}")
        elif (empty := data.lines[np.isnan(values)]).size:
            lines = [int(line) for line in empty]
            said = f"is empty, but {why}, allowed is a number{lines_named(lines)}"
            complaints.add(f"column {column}", said, lines[0])


def _clamped(coordinate: str, by: str) -> str:
    """What to write where nothing reads a coordinate because a clamp keeps it where it is; empty for a gauge."""
    way = f'; where a clamp holds it and nothing reads it, write {coordinate} = "{SUPPORT}" in its control'
    return way if by == DISPLACEMENT else ""


def _clamped_readings(head: Head, data: Data, complaints: Complaints, place: str) -> None:
    """What is held without a sensor has no readings: one other than zero is of something that was moved."""
    for k, by in enumerate(head.control):
        if by != SUPPORT or COORDINATES[k] in head.rig.supports:
            continue
        read = np.flatnonzero(np.nan_to_num(data.displacement[:, k]))
        if read.size:
            first = int(read[0])
            said = (
                f"reads {data.displacement[first, k]:g} in {place}, which holds {COORDINATES[k]} where it is unloaded; "
                f'what is moved and read is {COORDINATES[k]} = "{DISPLACEMENT}"'
            )
            complaints.add(f"column {DISPLACEMENTS[k]}", said, int(data.lines[first]))


def _reach(head: Head, data: Data, complaints: Complaints, place: str) -> None:
    """The platform point stays within a bar's length of the base, and was there before."""
    far = 2.0 * head.rig.length
    travel = np.nan_to_num(np.abs(_moved(head, data)[:, :3]))
    beyond = np.flatnonzero(travel.max(axis=1) > far)
    if beyond.size:
        i = int(beyond[0])
        k = int(np.argmax(travel[i]))
        said = f"reads {data.displacement[i, k]:g} mm in {place}, bars of {head.rig.length:g} mm allow at most {far:g}"
        complaints.add(f"column {DISPLACEMENTS[k]}", said, int(data.lines[i]))


def _moved(head: Head, data: Data) -> Array:
    """(N, 6) displacement without an offset that the sensors may have."""
    return data.displacement - (0.0 if head.zero == "nominal" else data.displacement[:1])


def _turns(head: Head, data: Data, complaints: Complaints, place: str) -> list[str]:
    """Rotations that no rotation vector has are refused, large ones remarked on."""
    turn = np.nan_to_num(np.abs(_moved(head, data)[:, 3:]))
    i, k = (int(n) for n in np.unravel_index(np.argmax(turn), turn.shape))
    largest, column = float(turn[i, k]), DISPLACEMENTS[3 + k]
    allowed = head.rig.largest_turn
    if largest > allowed:
        said = f"reads {largest:g} rad in {place}, allowed is at most {allowed:.3g}; are these degrees?"
        complaints.add(f"column {column}", said, int(data.lines[i]))
    elif largest > LARGE_TURN:
        return [f"{place}: {column} reaches {largest:.3g} rad ({np.degrees(largest):.0f} degrees)"]
    return []


def _nothing_to_predict(head: Head, data: Data, place: str) -> list[str]:
    """A test that measures nothing beyond what it controls says nothing about a model."""
    predicted: list[Array] = [
        data.wrench[:, k] if by != FORCE else data.displacement[:, k] for k, by in enumerate(head.control)
    ]
    predicted += [data.gauges[:, k] for k in range(data.gauges.shape[1])]
    if all(np.isnan(values).all() for values in predicted):
        return [f"{place}: nothing is measured beside what is controlled, so nothing is compared"]
    return []


def _held(
    head: Head,
    data: Data,
    gauges: tuple[Gauge, ...],
    noise: Noise,
    q: float,
    complaints: Complaints,
    place: str,
) -> None:
    """Bars that may swing run away under compression and have no place of their own without tension."""
    # With unknown offsets a reading does not tell which way the bars are loaded.
    if head.zero == "fitted" or not swings(head.rig, q, head.control, gauges):
        return
    forced = [by == FORCE for by in head.control]
    wrench = np.where(forced & np.isnan(data.wrench), 0.0, data.wrench)
    displacement = data.displacement
    if head.zero == "first_row":
        wrench, displacement = wrench - wrench[0], displacement - displacement[0]
    loaded = pull(head.rig, q, displacement, wrench, (noise.displacement, noise.wrench))
    mechanism = head.rig.runaway
    pushed = data.lines[loaded < 0]
    if pushed.size:
        said = (
            f"the bars are pushed while z is controlled by force{lines_named([int(n) for n in pushed])}: "
            f"{mechanism} and runs away; allowed is tension, or {HELD_Z}"
        )
        complaints.add(place, said, int(pushed[0]))
    elif not (loaded > 0).any():
        said = (
            f"nothing holds z: it is controlled by force, no step pulls the bars, and {mechanism}; "
            f"allowed is tension, or {HELD_Z}"
        )
        complaints.add(place, said, int(data.lines[0]))
