"""The Markdown twin of the page, for a repository browser."""

import re
from collections.abc import Iterator, Sequence

from reports.blocks import (
    Bars,
    Bullets,
    Cell,
    Code,
    Columns,
    Details,
    Explorer,
    Figure,
    Gallery,
    Heading,
    Lead,
    Section,
    Table,
    Tables,
    Text,
)
from reports.formats import plain
from reports.quantities import sigma


def escaped(text: str) -> str:
    """Text that Markdown prints as it stands: a backslash where a sign would be taken for markup, no entities."""
    text = " ".join(text.split())
    text = re.sub(r"([\\`*\[\]|])", r"\\\1", text)
    # A < begins a tag only before one of these, an & an entity only if a ; follows, a > a quotation only at the start.
    text = re.sub(r"<(?=[A-Za-z/!?])", r"\\<", text)
    text = re.sub(r"&(?=#?\w+;)", r"\\&", text)
    text = re.sub(r"^(?=[>#+-])", r"\\", text)
    # An underscore inside a word is left alone by Markdown; elsewhere it starts emphasis.
    return re.sub(r"(?<!\w)_|_(?!\w)", r"\\_", text)


def render(title: str, sections: Sequence[Section]) -> str:
    """The whole document."""
    lines = [f"# {escaped(title)}", ""]
    for section in sections:
        lines += [f"## {escaped(section.title)}", ""]
        for block in section.blocks:
            lines += [*block_lines(block), ""]
    return "\n".join(lines).rstrip() + "\n"


def block_lines(block: object) -> Iterator[str]:
    """The lines of one block."""
    match block:
        case Gallery() | Explorer() | Tables() | Columns() | Details():
            if isinstance(block, Details):
                yield from (f"### {escaped(block.title)}", "")
            for part in parts(block):
                yield from block_lines(part)
                yield ""
        case Figure():
            yield from figure_lines(block)
        case Table():
            yield from table_lines(block)
        case Bars():
            yield from bar_lines(block)
        case _:
            yield from plain_lines(block)


def plain_lines(block: object) -> Iterator[str]:
    """Those of what is words alone."""
    match block:
        case Text():
            yield escaped(block.text)
        case Heading():
            yield f"### {escaped(block.text)}"
        case Lead():
            yield f"**{escaped(block.text)}**"
        case Bullets():
            yield from (f"- {escaped(item)}" for item in block.items)
        case Code():
            yield from ("```", block.text, "```")


def bar_lines(block: Bars) -> Iterator[str]:
    """A line for each bar."""
    for row in block.rows:
        said = [
            f"{name} {sigma(value)}"
            for name, value in zip(block.series, row.values, strict=True)
            if value is not None
        ]
        code = f" (`{row.code}`)" if row.code else ""
        yield f"- {escaped(row.label)}{code}: {escaped(', '.join(said))} sigma"


def parts(block: Gallery | Explorer | Tables | Columns | Details) -> Sequence[object]:
    """What a block of several holds."""
    if isinstance(block, Columns):
        return [*block.left, *block.right]
    if isinstance(block, Details):
        return block.blocks
    if isinstance(block, Tables):
        return block.tables
    return block.figures if isinstance(block, Gallery) else block.pictures


def figure_lines(figure: Figure) -> Iterator[str]:
    """The picture with its caption; a plot without a picture is in the page only."""
    if figure.png:
        yield f"![{escaped(plain(figure.name))}](pictures/{figure.name}.png)"
        yield ""
        yield f"*{escaped(figure.caption)}*"


def table_lines(table: Table) -> Iterator[str]:
    """A pipe table with its caption above and its notes below."""
    if table.caption:
        yield f"**{escaped(table.caption)}**"
        yield ""
    heads = [f"{escaped(c.title)} ({escaped(c.unit)})" if c.unit else escaped(c.title) for c in table.columns]
    yield f"| {' | '.join(heads)} |"
    yield f"| {' | '.join('---:' if c.numeric else '---' for c in table.columns)} |"
    for row in table.rows:
        yield f"| {' | '.join(cell_text(cell) for cell in row)} |"
    for note in table.notes:
        yield ""
        yield escaped(note)


def cell_text(cell: Cell) -> str:
    """A cell with its remark."""
    said = escaped(f"{cell.text} ({cell.mark})" if cell.mark and cell.text else cell.text)
    return f"{said} (`{cell.code}`)" if cell.code else said
