"""Labels of critical loads stand beside the panel, none over another, in the order of their loads."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from reports.curves import LABEL, Level, Panel


def panel(*loads: float) -> Panel:
    return Panel(0.0, ("z",), (), tuple(Level(f"model {k}", "black", load) for k, load in enumerate(loads)))


LOADS = st.floats(0.001, 50.0)


@given(st.lists(LOADS | LOADS.map(lambda it: -it), min_size=1, max_size=9))
def test_no_label_covers_another(loads: list[float]) -> None:
    it = panel(*loads)
    low, high = it.y_range
    places = np.array([place for place, _ in it.level_labels()])
    assert len(places) == len(loads)
    assert (np.diff(places) >= 0.999999 * LABEL * (high - low)).all()
    assert np.isclose(places.mean(), np.mean(loads), atol=1e-9 * (high - low) + 1e-12)


def test_a_label_stands_at_its_load_where_there_is_room() -> None:
    it = panel(10.0, -5.0, 10.1)
    (tension, said), (second, _), (third, last) = it.level_labels()
    assert tension == -5.0 and said == "5.000 kN tension: model 1"
    assert second < 10.0 < 10.1 < third and np.isclose((second + third) / 2, 10.05)
    assert last == "10.10 kN: model 2"
