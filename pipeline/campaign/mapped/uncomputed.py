"""Cells of a workbook that hold no value: errors, and formulas that were never computed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree
from zipfile import BadZipFile, ZipFile

_NAMES = {
    "m": "http://schemas.openxmlformats.org/spreadsheetml/2006/main",
    "r": "http://schemas.openxmlformats.org/officeDocument/2006/relationships",
}
_ID = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"
_ERROR = re.compile(rb'<c r="([A-Z]+)(\d+)"[^>]*\bt="e"[^>]*>.*?<v>([^<]*)</v>', re.DOTALL)
_FORMULA = re.compile(rb'<c r="([A-Z]+)(\d+)"[^>]*>\s*<f[^>]*>([^<]*)</f>\s*(?:<v\s*/>|<v></v>)?\s*</c>')


def uncomputed(path: Path, sheet: str) -> Iterator[tuple[tuple[int, int], str]]:
    """(row, column), counted from 0, and what stands there; nothing for formats that are no zip of XML."""
    if path.suffix.lower() not in (".xlsx", ".xlsm"):
        return
    try:
        with ZipFile(path) as book:
            text = book.read(_part(book, sheet))
    except (BadZipFile, KeyError, ElementTree.ParseError, OSError):
        return
    for column, row, value in _ERROR.findall(text):
        yield (int(row) - 1, _number(column)), value.decode()
    for column, row, formula in _FORMULA.findall(text):
        yield (int(row) - 1, _number(column)), f"={formula.decode()} (never computed)"


def _part(book: ZipFile, sheet: str) -> str:
    """The part of the zip with a sheet. KeyError where there is none."""
    tree = ElementTree.fromstring(book.read("xl/workbook.xml"))
    found = {each.get("name"): each.get(_ID) for each in tree.iterfind("m:sheets/m:sheet", _NAMES)}
    relations = ElementTree.fromstring(book.read("xl/_rels/workbook.xml.rels"))
    targets = {each.get("Id"): each.get("Target", "") for each in relations}
    target = targets[found[sheet]]
    return target.lstrip("/") if target.startswith("/") else f"xl/{target}"


def _number(letters: bytes) -> int:
    number = 0
    for letter in letters:
        number = 26 * number + letter - ord("A") + 1
    return number - 1
