"""A discovery on a terminal of 80 columns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from pipeline.answer.law import LawFound
from pipeline.answer.tables.added import NAME
from pipeline.discover.record import Discovered
from pipeline.discover.search import GEOMETRY
from pipeline.terminal import cell, lean, one_line, terminal
from reports.quantities import short, sigma

FORM, PLACE = 18, 30


def show(it: Discovered, following: Iterable[str], quiet: bool, console: Console | None = None) -> None:
    """Print what was found; unless quiet as a table too, with what to do next."""
    out = terminal(console)
    if not quiet:
        out.print(Text(f"{headline(it)}\n"))
        if it.laws or it.entered:
            out.print(table(it), "")
    for sentence in it.sentences[:1] if quiet else it.sentences:
        out.print(escape(sentence))
    if not quiet:
        for command in following:
            out.print(f"next: {escape(command)}", soft_wrap=True)


def headline(it: Discovered) -> str:
    """Where the rest sits and how far the error falls, in one line."""
    names = [law.site for law in it.laws] + [each.effect for each in it.entered]
    before, after = sigma(it.error[0].fit), sigma(it.error[-1].fit)
    if not names:
        return one_line(f"{it.campaign}: no law is found, {before} sigma", f"no law is found, {before} sigma")
    fall = f"{before} -> {after} sigma"
    return one_line(
        f"{it.campaign}: {', '.join(names)}; {fall}",
        f"{', '.join(names)}; {fall}",
        f"{len(names)} places explain what is left; {fall}",
    )


def table(it: Discovered) -> Table:
    """Each law and effect with its evidence and the error with it."""
    table = lean("site", "form", "ln evidence", "fitted", "held out", title=f"{it.campaign}: error in sigmas")
    first = it.error[0]
    table.add_row("as it is", "", "", sigma(first.fit), sigma(first.holdout))
    if it.geometry:
        bent = it.error[1]
        table.add_row(cell(f"+ {GEOMETRY}", NAME), "", "", sigma(bent.fit), sigma(bent.holdout))
    for law in it.laws:
        form = cell(law.form or "", FORM)
        table.add_row(
            cell(f"+ {law.site}", NAME), form, short(law.evidence), sigma(law.fit), sigma(law.holdout)
        )
    for each in it.entered:
        table.add_row(cell(f"+ {each.effect}", NAME), "", short(each.evidence), "", "")
    return table


def law_table(laws: Sequence[LawFound]) -> Table:
    """Laws beside an answer that has its own verdict: where each sits in words, its form, how sure it is."""
    table = lean("site", "place and form", "ln evidence", "fitted", "held out", title="laws, error in sigmas")
    for law in laws:
        form = f"{law.where}: {law.form or 'no form'}"
        numbers = (short(law.evidence), sigma(law.fit), sigma(law.holdout))
        table.add_row(cell(law.site, FORM), cell(form, PLACE), *numbers)
    table.columns[1].justify = "left"
    return table
