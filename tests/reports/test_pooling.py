"""What is pooled and put together again is what it was, and smaller."""

from __future__ import annotations

import json
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from reports.page import KEY, pooled

LEAVES = (
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text()
)
PARTS = st.recursive(
    LEAVES,
    lambda inner: st.lists(inner) | st.dictionaries(st.text().filter(lambda k: k != KEY), inner),
    max_leaves=20,
)


def whole(part: Any, pool: list[Any]) -> Any:
    if isinstance(part, list):
        return [whole(it, pool) for it in part]
    if isinstance(part, dict):
        if KEY in part:
            return whole(pool[part[KEY]], pool)
        return {key: whole(value, pool) for key, value in part.items()}
    return part


@given(PARTS, st.lists(PARTS, max_size=4))
def test_nothing_is_lost(again: Any, others: list[Any]) -> None:
    items = [again, {"a": again}, *others, [again]]
    out, pool = pooled(items)
    assert whole(out, pool) == items


def test_what_repeats_stands_once() -> None:
    loads = [0.5 * k for k in range(200)]
    items = [{"x": loads, "y": [n] * 3} for n in range(50)]
    out, pool = pooled(items)
    assert pool == [loads] and len(json.dumps([out, pool])) < 0.05 * len(json.dumps(items))
