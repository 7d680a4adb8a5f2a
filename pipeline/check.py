"""`check`: what a campaign's files say, as they were read; every complaint about them where they cannot be."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from rich.markup import escape
from rich.table import Table

from pipeline.campaign import Campaign, Test, read
from pipeline.campaign.names import DISPLACEMENTS, WRENCHES, gauge_column
from pipeline.terminal import terminal
from pipeline.typed import command


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
        out.print(escape(remark), soft_wrap=True)
    out.print(f"next: {escape(command('compare', folder))}", soft_wrap=True)
    return campaign


def _ranges(campaign: Campaign, test: Test) -> list[str]:
    """Each column that was read, from its least to its largest reading."""
    names = [*DISPLACEMENTS, *WRENCHES, *(gauge_column(gauge.name) for gauge in campaign.gauges)]
    values = np.column_stack([test.data.displacement, test.data.wrench, test.data.gauges])
    found = []
    for name, column in zip(names, values.T, strict=True):
        if np.isfinite(column).any():
            found.append(f"{name} {np.nanmin(column):.4g} .. {np.nanmax(column):.4g}")
    return found
