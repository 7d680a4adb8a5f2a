"""The Markdown twin of the page, for a repository browser."""

import re
from collections.abc import Iterator, Sequence

from reports.blocks import Bullets, Cell, Code, Explorer, Figure, Gallery, Lead, Section, Table, Tables, Text
from reports.formats import plain


def escaped(text: str) -> str:
    """Text that Markdown prints as it stands."""
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    text = re.sub(r"([\\`*\[\]|])", r"\\\1", text)
    # An underscore inside a word is left alone by Markdown; elsewhere it starts emphasis.
    return re.sub(r"(?<!\w)_|_(?!\w)", r"\\_", " ".join(text.split()))


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
    if isinstance(block, Text):
        yield escaped(block.text)
    elif isinstance(block, Lead):
        yield f"**{escaped(block.text)}**"
    elif isinstance(block, Bullets):
        yield from (f"- {escaped(item)}" for item in block.items)
    elif isinstance(block, Code):
        yield from ("```", block.text, "```")
    elif isinstance(block, Figure):
        yield from figure_lines(block)
    elif isinstance(block, Gallery | Explorer | Tables):
        for part in parts(block):
            yield from block_lines(part)
            yield ""
    elif isinstance(block, Table):
        yield from table_lines(block)


def parts(block: Gallery | Explorer | Tables) -> Sequence[object]:
    """What a block of several holds."""
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
    return escaped(f"{cell.text} ({cell.mark})" if cell.mark and cell.text else cell.text)
