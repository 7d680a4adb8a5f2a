"""`check`: what a campaign's files say, as they were read; every complaint about them where they cannot be."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from rich.markup import escape
from rich.table import Table

from pipeline.answer.record import place_of
from pipeline.answer.wording.doctor import doctor_sentence, lines_aside, mends
from pipeline.attempt import Attempts
from pipeline.campaign import Campaign, Test, read
from pipeline.campaign.names import channel_columns
from pipeline.progress import Progress
from pipeline.selection.beginnings import Beginning
from pipeline.selection.examined import examined
from pipeline.terminal import terminal, wrapped
from pipeline.typed import command
from reports.quantities import short, sigma


def check(folder: Path) -> Campaign:
    """Read and tell. InputError with every complaint about the files."""
    campaign = read(folder)
    out = terminal()
    out.print(f"{escape(campaign.name)}: a {campaign.rig.kind} of {campaign.rig.length:g} mm")
    for name, digest in campaign.digests:
        out.print(f"  {escape(name)}  sha256 {digest[:16]}")
    table = Table(box=None, pad_edge=False)
    for head in ("test", "role", "rows", "read"):
        table.add_column(head, overflow="fold")
    for test in campaign.tests:
        table.add_row(
            escape(test.id), test.role, str(test.data.steps.size), ", ".join(_ranges(campaign, test))
        )
    out.print(table)
    for remark in campaign.remarks:
        out.print(escape(wrapped(remark, out.width)), soft_wrap=True)
    for said in _examined(campaign):
        out.print(escape(wrapped(said, out.width)), soft_wrap=True)
    out.print(f"next: {escape(command('compare', folder))}", soft_wrap=True)
    return campaign


def _examined(campaign: Campaign) -> Iterator[str]:
    """What the table has wrong beside plain virtual springs with the best single effect."""
    attempts = Attempts()
    with Progress().stage("mistakes of the table") as stage:
        it = attempts.get("mistakes of the table", lambda: examined(campaign, stage.say), None)
    yield from attempts.failed
    if it is None:
        return
    if it.mistakes:
        yield f"Doctor: {doctor_sentence(it.mistakes)}"
        yield from mends(it.mistakes)
        return
    if not campaign.table_checked:
        yield "Doctor: no unit, sign, exchange or order that would explain most of the misfit."
    if it.zero is not None:
        yield f"Doctor: {it.zero.words}"
    for begin in it.begins:
        yield f"Doctor: {_begins(campaign, begin)}"
    if not it.judged:
        yield (
            "Doctor: single readings and sigmas cannot be judged before a model leaves nothing that follows the load: "
            "diagnose does that."
        )
    for bad in it.readings.bad:
        yield (
            f"Doctor: {bad.column} at {place_of(bad.test, bad.step, bad.line)} is off alone, by {sigma(bad.sigmas)} "
            f"sigma: look it up, or leave it out of all commands by {lines_aside([bad.cell])}."
        )
    for noise in it.noise:
        law = (
            ""
            if noise.tails is None
            else f", with long tails (Student's law of {noise.tails:.1f} degrees of freedom)"
        )
        yield (
            f"Doctor: {noise.column} scatters by {short(noise.found)}, {short(noise.declared)} is declared{law}: "
            f"{noise.column} = {noise.found:.3g} under [noise] if the sensor is no better; if it is, look at the "
            "numbers of [rig] first: a wrong length looks like this too."
        )


def _begins(campaign: Campaign, it: Beginning) -> str:
    """Where a channel begins, and what that may be."""
    column = channel_columns(campaign.gauges)[it.channel]
    name, _, unit = column.rpartition("_")
    where = it.tests[0] if len(it.tests) == 1 else f"{len(it.tests)} of the {it.of} tests that read it"
    value = f"{it.value:.4g} {unit.replace('Nmm', 'N·mm')}"
    return (
        f"{name} begins at {value} in {where}, by {sigma(it.sigmas)} sigma, where the model expects nothing: the "
        'sensor was not zeroed (zero = "fitted" in the test leaves that open), or the rig is mounted off or has other '
        "lengths."
    )


def _ranges(campaign: Campaign, test: Test) -> list[str]:
    """Each column that was read, from its least to its largest reading."""
    names = channel_columns(campaign.gauges)
    values = np.column_stack([test.data.displacement, test.data.wrench, test.data.gauges])
    found = []
    for name, column in zip(names, values.T, strict=True):
        if np.isfinite(column).any():
            found.append(f"{name} {np.nanmin(column):.4g} .. {np.nanmax(column):.4g}")
    return found
