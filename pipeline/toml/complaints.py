"""Complaints about a campaign: all of a file at once, each a sentence that names file and place."""

from dataclasses import dataclass, field

from pipeline.errors import InputError

SHOWN, LENGTH = 20, 60


class BadCampaign(InputError):
    """A campaign that cannot be used. `complaints`: one sentence each; the message has one a line, at most `SHOWN`."""

    def __init__(self, complaints: tuple[str, ...]) -> None:
        self.complaints = complaints
        more = len(complaints) - SHOWN
        shown = complaints[:SHOWN] if more > 0 else complaints
        super().__init__("\n".join([*shown, *([f"... and {more} more"] if more > 0 else [])]))


@dataclass
class Complaints:
    """Collects the complaints about one file; `file` is how the file is named in them."""

    file: str
    found: list[tuple[int, str]] = field(default_factory=list)

    def add(self, place: str, said: str, line: int | None = None) -> None:
        """A complaint about a place ("column x_mm", "rig.length_mm"), on a line counted from 1 where it is known."""
        where = [self.file] if line is None else [f"{self.file} line {line}"]
        sentence = printable(", ".join([*where, *([place] if place else [])]) + ": " + " ".join(said.split()))
        self.found.append((line or 0, sentence))

    def sentences(self) -> tuple[str, ...]:
        """In the order of the lines."""
        return tuple(dict.fromkeys(sentence for _, sentence in sorted(self.found, key=lambda pair: pair[0])))

    def check(self) -> None:
        """BadCampaign if there is any complaint."""
        if self.found:
            raise BadCampaign(self.sentences())


def printable(text: str) -> str:
    """The text with every character that has no picture of its own written as its code."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def shown(value: object) -> str:
    """A value as it is named in a sentence: on one line, printable and short."""
    text = value if isinstance(value, str) else repr(value)
    text = text if len(text) <= LENGTH else text[: LENGTH - 3] + "..."
    return repr(text) if isinstance(value, str) else text


def lines_named(lines: list[int]) -> str:
    """The first few of several lines, in brackets behind a blank; nothing for one, which is named already."""
    if len(lines) < 2:
        return ""
    first = ", ".join(map(str, lines[:3]))
    more = f" and {len(lines) - 3} more" if len(lines) > 3 else ""
    return f" (lines {first}{more})"
