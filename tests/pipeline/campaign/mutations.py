"""Damage to a campaign's files, as hypothesis strategies: bytes, lines, cells, keys and numbers."""

import re
from collections.abc import Callable

from hypothesis import strategies as st

Mutation = Callable[[bytes], bytes]

NUMBERS = [
    "0",
    "-1",
    "1e308",
    "-1e-320",
    "1e999",
    "inf",
    "nan",
    "12",
    "0.5",
    "3.7e5",
    "9" * 5000,
    "0x1F",
    "1_0",
    "true",
]
WORDS = [
    "x", "mid", "force", "displacement", "fit", "bar", "pinned", "guided", "schema", "rig", "tests", "gauges",
    "length_mm", "bar_stiffness", "x_mm", "z_mm", "rx_deg", "temperature_C", "first_row", "__class__", "\u00e9", "",
]  # fmt: skip
SNIPPETS = [
    b"\x00", b"\xff", b"\xef\xbb\xbf", b"\xff\xfe", b"\r", b"\n", b'"', b"'''", b"[", b"]]", b"{", b"=", b",", b";",
    b"\t", b"#", b"\xe2\x80\xa8", b"\x1b[31m", b"1,5", b"[[tests]]\n", b"[rig]\n", b"[[gauges]]\n", b"a.b.c=1\n",
]  # fmt: skip


@st.composite
def flipped(draw: st.DrawFn) -> Mutation:
    """One byte set to another."""
    place, value = draw(st.integers(0, 10**6)), draw(st.integers(0, 255))

    def apply(text: bytes) -> bytes:
        k = place % max(len(text), 1)
        return text[:k] + bytes([value]) + text[k + 1 :]

    return apply


@st.composite
def inserted(draw: st.DrawFn) -> Mutation:
    """A few bytes put in somewhere."""
    place, snippet = draw(st.integers(0, 10**6)), draw(st.sampled_from(SNIPPETS) | st.binary(max_size=4))

    def apply(text: bytes) -> bytes:
        k = place % (len(text) + 1)
        return text[:k] + snippet + text[k:]

    return apply


@st.composite
def cut(draw: st.DrawFn) -> Mutation:
    """The end lost."""
    share = draw(st.integers(0, 1000))
    return lambda text: text[: len(text) * share // 1000]


@st.composite
def relined(draw: st.DrawFn) -> Mutation:
    """A line deleted, doubled, moved to the front or to the end."""
    place, how = draw(st.integers(0, 10**4)), draw(st.sampled_from(["drop", "double", "first", "last"]))

    def apply(text: bytes) -> bytes:
        lines = text.splitlines(keepends=True) or [b""]
        k = place % len(lines)
        one, rest = lines[k], lines[:k] + lines[k + 1 :]
        changed = {
            "drop": rest,
            "double": [*lines[:k], one, *lines[k:]],
            "first": [one, *rest],
            "last": [*rest, one],
        }
        return b"".join(changed[how])

    return apply


@st.composite
def recolumned(draw: st.DrawFn) -> Mutation:
    """Two columns swapped, in all rows or in the header only."""
    a, b, whole = draw(st.integers(0, 20)), draw(st.integers(0, 20)), draw(st.booleans())

    def apply(text: bytes) -> bytes:
        rows = [line.split(b",") for line in text.split(b"\n")]
        for row in rows if whole else rows[:1]:
            i, j = a % len(row), b % len(row)
            row[i], row[j] = row[j], row[i]
        return b"\n".join(b",".join(row) for row in rows)

    return apply


def replaced(pattern: bytes, new: st.SearchStrategy[str]) -> st.SearchStrategy[Mutation]:
    """One match of a pattern replaced."""

    @st.composite
    def mutation(draw: st.DrawFn) -> Mutation:
        place, word = draw(st.integers(0, 10**4)), draw(new).encode("utf-8", "replace")

        def apply(text: bytes) -> bytes:
            found = list(re.finditer(pattern, text))
            if not found:
                return text
            start, end = found[place % len(found)].span()
            return text[:start] + word + text[end:]

        return apply

    return mutation()


numbers = st.sampled_from(NUMBERS) | st.floats().map(repr) | st.integers(-(10**20), 10**20).map(str)
words = st.sampled_from(WORDS) | st.text(max_size=8)
mutations = st.one_of(
    replaced(rb"-?\d+\.?\d*(e-?\d+)?", numbers),
    replaced(rb"[A-Za-z_]+\w*", words),
    replaced(rb'"[^"]*"', words.map(lambda word: f'"{word}"')),
    relined(),
    recolumned(),
    flipped(),
    inserted(),
    cut(),
)
