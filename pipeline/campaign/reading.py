"""A campaign folder: two files in, a frozen Campaign out, or every complaint about them. Nothing is written."""

from hashlib import sha256
from pathlib import Path

import numpy as np

from pipeline.campaign.aside import by_hand
from pipeline.campaign.description import describe
from pipeline.campaign.formats import by_suffix
from pipeline.campaign.head import Description, Draft, Head, SensorNoise
from pipeline.campaign.long_tests import thinned
from pipeline.campaign.mapped.assemble import measured as assembled
from pipeline.campaign.measured import Measured
from pipeline.campaign.model import Campaign, Data, Noise, Test
from pipeline.campaign.names import (
    DISPLACEMENTS,
    FORCE,
    PLACES,
    TEMPERATURE,
    WRENCHES,
    gauge_column,
    known_columns,
)
from pipeline.campaign.plausible import judge
from pipeline.campaign.posture_rows import parted
from pipeline.campaign.rows import data_by_test, measured_of
from pipeline.campaign.sheet import sheet
from pipeline.campaign.tolerance import widest
from pipeline.errors import unread
from pipeline.toml.complaints import BadCampaign, Complaints, shown
from pipeline.typed import command

DESCRIPTION, MEASUREMENTS = "campaign.toml", "measurements.csv"
LARGEST = {DESCRIPTION: 2**24, MEASUREMENTS: 2**30}
"""Bytes."""
CHECKED = "table_checked: no mistake of the table is looked for"
BY_ROWS = "no column is the step: of each test the rows that are read are its steps, the first is step 0"


def read(folder: Path, instead: str | None = None) -> Campaign:
    """The campaign in a folder. instead: a text in the place of its campaign.toml, to see what that would say.

    BadCampaign, an InputError, names file, line, key or column, what was found and what is allowed, for every
    mistake in campaign.toml and in the files of readings; only whether the two fit each other is looked at when
    neither has one.
    """
    there, table = _texts(folder)
    described = there if instead is None else instead
    first = Complaints(str(folder / DESCRIPTION))
    draft = describe(described, first, folder)
    paths = {source.declared.file.path or MEASUREMENTS for source in draft.sources}
    complaints = Complaints(
        str(folder / (paths.pop() if len(paths) == 1 else "readings" if paths else MEASUREMENTS))
    )
    try:
        measured, remarks, files = _readings(folder, draft, table, complaints)
    except BadCampaign as error:
        raise BadCampaign((*first.sentences(), *error.complaints)) from None
    description = draft.description
    if description is None:
        raise BadCampaign((*first.sentences(), *complaints.sentences()))
    measured, description = parted(measured, description, complaints)
    columns = {*measured.values, "test", "step"}
    data = data_by_test(measured, description, complaints)
    _unread(measured, description, complaints)
    noise = _noise(description)
    for head in description.heads:
        if head.id in data:
            remarks += judge(head, data[head.id], description.gauges, noise, columns, complaints)
    complaints.check()
    runs = {name: run for run, name in enumerate(dict.fromkeys(measured.tests))}
    tests = tuple(_test(head, data[head.id], runs[head.id], description, first) for head in description.heads)
    first.check()
    known, said = _tolerance(description)
    asked = [f"{DESCRIPTION}, {said}" for said in description.questions]
    asked += [f"{DESCRIPTION}, {CHECKED}"] if description.table_checked else []
    remarks = [*asked, *_sigma_remarks(description, tests), *said, *_by_hand_remarks(tests), *remarks]
    shorter = [thinned(test, noise, description.gauges) for test in tests]
    tests = tuple(test for test, _ in shorter)
    remarks += [said for _, said in shorter if said]
    beside = dict.fromkeys(path for rig in description.rigs for path in rig.files)
    files = [folder / DESCRIPTION, *beside, *files]
    digests = tuple((_named(path, folder), sha256(path.read_bytes()).hexdigest()) for path in files)
    return Campaign(
        description.name,
        description.rig,
        noise,
        description.gauges,
        tests,
        folder,
        tuple(remarks),
        digests,
        known,
        description.table_checked,
    )


def _test(head: Head, data: Data, run: int, description: Description, complaints: Complaints) -> Test:
    """A test with its readings, without those that were set aside by hand."""
    by_hands = (head.set_aside, head.keep)
    test = Test(head.id, head.q_deg, head.role, head.control, head.zero, head.rig, data, *by_hands, run)
    return by_hand(test, description.gauges, head.line, complaints)


def _by_hand_remarks(tests: tuple[Test, ...]) -> list[str]:
    """Readings that were set aside, or are kept, by hand."""
    aside, kept = (
        [f"{column} of {test.id} step {step}" for test in tests for step, column in cells(test)]
        for cells in (lambda test: test.set_aside, lambda test: test.keep)
    )
    said = (("set aside", aside), ("kept however far off it is", kept))
    return [f"{DESCRIPTION}: by hand {words}: {', '.join(names)}" for words, names in said if names]


def _tolerance(description: Description) -> tuple[dict[str, float], list[str]]:
    """What is written about the rig, by how much it may be off, and the remark where nobody said it."""
    rigs = description.rigs
    bars = dict.fromkeys(rig.tolerance_said for rig in rigs if rig.tolerance_said)
    of_bar = [f"{DESCRIPTION}, rig.bar_from: {said}" for said in bars]
    if description.tolerance is not None:
        return description.tolerance, of_bar
    known = widest(rig.usual_tolerance for rig in rigs)
    if not known:
        return known, []
    said = ", ".join(f"{key} {_deviation(key, value)}" for key, value in known.items())
    return known, [
        f"{DESCRIPTION}, tolerance: is missing, so what is written about the rig counts as known to one standard "
        f'deviation of {said}; write [tolerance] with your own, or all = "exact"',
        *of_bar,
    ]


def _deviation(key: str, value: float) -> str:
    unit = key.rpartition("_")[2] if "_" in key else ""
    return f"{value:g} {unit}" if unit else f"{100.0 * value:g} %"


def _named(path: Path, folder: Path) -> str:
    """A file as it is named from the campaign's folder."""
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else str(path)


def _texts(folder: Path) -> tuple[str, str | BadCampaign]:
    """The text of both files, or what is wrong with the table: it is not needed where another file is declared."""
    if not folder.is_dir():
        found = "is a file" if folder.exists() else "does not exist"
        allowed = f"allowed is a folder with {DESCRIPTION} and {MEASUREMENTS}"
        raise BadCampaign((f"{folder}: {found}, {allowed}",))
    described, table = (_tried(folder / name) for name in (DESCRIPTION, MEASUREMENTS))
    if isinstance(described, BadCampaign):
        more = table.complaints if isinstance(table, BadCampaign) else ()
        raise BadCampaign((*described.complaints, *more))
    return described, table


def _tried(path: Path) -> str | BadCampaign:
    """The text of a file, or every complaint about it."""
    complaints = Complaints(str(path))
    try:
        text = _text(path, LARGEST[path.name], complaints)
        complaints.check()
    except OSError as error:
        beside = _beside(path) if isinstance(error, FileNotFoundError) else ""
        return BadCampaign((f"{path}: {unread(error)}{beside}",))
    except BadCampaign as error:
        return error
    return text


def _readings(
    folder: Path, draft: Draft, table: str | BadCampaign, complaints: Complaints
) -> tuple[Measured, list[str], list[Path]]:
    """The readings, how they were converted, and from which files; complaints about measurements.csv, where that
    is as the contract has it."""
    names = draft.gauges
    if draft.sources:
        found, words, said, files = assembled(folder, MEASUREMENTS, draft.sources, names)
        if said:
            raise BadCampaign(tuple(said))
        remarks = [f"read as declared: {each}" for each in words]
        return found, [*remarks, *([BY_ROWS] if found.steps is None else [])], files
    if isinstance(table, BadCampaign):
        raise table
    otherwise = _declared(MEASUREMENTS, folder / MEASUREMENTS)
    frame = sheet(table, (*known_columns(names), *PLACES), complaints, otherwise=otherwise)
    if not {"test", "step"} <= set(frame.columns):
        complaints.check()
    return measured_of(frame, names, complaints), [], [folder / MEASUREMENTS]


def _beside(path: Path) -> str:
    """What to do with other tables in the folder of one that is missing; empty where there is none."""
    if path.name != MEASUREMENTS or not path.parent.is_dir():
        return ""
    others = [it for it in sorted(path.parent.iterdir()) if it.suffix.lower() in by_suffix() and it.is_file()]
    return f", {others[0].name} lies beside it: {_declared(others[0].name, others[0])}" if others else ""


def _declared(name: str, path: Path) -> str:
    """How a table that is not as the contract has it is read."""
    return (
        f'a file as a logger writes it is declared in {DESCRIPTION}, [file] path = "{name}" and [columns]; '
        f"{command('init', 'NEW', path)} writes both"
    )


def _text(path: Path, largest: int, complaints: Complaints) -> str:
    """UTF-8 text, with or without a byte order mark."""
    if (size := path.stat().st_size) > largest:
        complaints.add("", f"has {size / 2**20:.0f} MB, allowed are {largest / 2**20:.0f}")
        return ""
    content = path.read_bytes()
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        complaints.add("", "is written in UTF-16, allowed is UTF-8")
        return ""
    if b"\0" in content:
        complaints.add(
            "", "is a binary file, allowed is text", content.count(b"\n", 0, content.index(b"\0")) + 1
        )
        return ""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        said = f"byte {error.object[error.start]:#04x} is no UTF-8, allowed is text in UTF-8"
        complaints.add("", said, error.object.count(b"\n", 0, error.start) + 1)
        return ""
    if not text.strip():
        complaints.add("", "is empty")
    return text


def _unread(measured: Measured, description: Description, complaints: Complaints) -> None:
    """Complaints about loads that were not read though something was there: only an empty cell is no force."""
    ids = np.array(measured.tests, dtype=object)
    for head in description.heads:
        mine = np.flatnonzero(ids == head.id)
        for column, by in zip(WRENCHES, head.control, strict=True):
            rows = mine[measured.blank(column)[mine]] if by == FORCE else mine[:0]
            if rows.size:
                said = f"has a word for no reading, but test {shown(head.id)} is controlled by it; leave the row out"
                complaints.add(f"column {column}", said, int(measured.lines[rows[0]]))


def _noise(description: Description) -> Noise:
    gauges = tuple(gauge_column(gauge.name) for gauge in description.gauges)
    unknown = SensorNoise(np.nan)
    every = [description.noise.get(it, unknown) for it in (*DISPLACEMENTS, *WRENCHES, *gauges)]
    sigmas = np.array([it.sigma for it in every])
    return Noise(
        sigmas[:6],
        sigmas[6:12],
        sigmas[12:],
        description.noise.get(TEMPERATURE, unknown).sigma,
        np.array([it.of_reading for it in every]),
        np.array([it.gain for it in every]),
    )


def _sigma_remarks(description: Description, tests: tuple[Test, ...]) -> list[str]:
    """Columns that are measured without a sigma, and sigmas of what is not measured."""
    measured = {column for test in tests for column in measured_columns(test.data, description)}
    remarks = []
    for column in known_columns(gauge.name for gauge in description.gauges):
        if column in measured and column not in description.noise:
            remarks.append(f"{DESCRIPTION}, noise.{column}: is missing, so the sigma is estimated")
        elif column not in measured and column in description.noise:
            remarks.append(f"{DESCRIPTION}, noise.{column}: is given, but {column} is not measured")
    unmeasured = [gauge.name for gauge in description.gauges if gauge_column(gauge.name) not in measured]
    return remarks + [f"{DESCRIPTION}, gauge {name!r}: is not measured" for name in unmeasured]


def measured_columns(data: Data, description: Description) -> list[str]:
    """Columns of which a test has at least one reading."""
    gauges = [gauge_column(gauge.name) for gauge in description.gauges]
    readings = np.column_stack([data.displacement, data.wrench, data.gauges])
    names = [*DISPLACEMENTS, *WRENCHES, *gauges]
    found = [name for k, name in enumerate(names) if np.isfinite(readings[:, k]).any()]
    return found + ([] if data.temperature is None else [TEMPERATURE])
