"""JSON without its repetitions: parts that occur again and again stand once in a pool and are referred to."""

import json
from collections import Counter
from collections.abc import Sequence
from typing import Any

SHORT = 40
"""Characters up to which a part is cheaper where it stands."""
KEY = "$"


def pooled(items: Sequence[Any]) -> tuple[list[Any], list[Any]]:
    """The items with every longer part that occurs twice as {"$": number}, and the pool by number."""
    counts: Counter[str] = Counter()
    for item in items:
        _count(item, counts)
    numbers: dict[str, int] = {}
    pool: list[Any] = []

    def replaced(part: Any) -> Any:
        if not isinstance(part, dict | list):
            return part
        text = json.dumps(part, sort_keys=True)
        if len(text) <= SHORT or counts[text] < 2:
            return _inside(part, replaced)
        if text not in numbers:
            inner = _inside(part, replaced)
            numbers[text] = len(pool)
            pool.append(inner)
        return {KEY: numbers[text]}

    return [replaced(item) for item in items], pool


def _count(part: Any, counts: Counter[str]) -> None:
    """Every part once for each place; inside of what has been seen nothing is counted again."""
    if not isinstance(part, dict | list):
        return
    text = json.dumps(part, sort_keys=True)
    counts[text] += 1
    if counts[text] == 1:
        for inner in part.values() if isinstance(part, dict) else part:
            _count(inner, counts)


def _inside(part: Any, change: Any) -> Any:
    if isinstance(part, dict):
        return {key: change(value) for key, value in part.items()}
    return [change(value) for value in part]
