"""Order, limit and band of mesh studies with known answers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fem.convergence import extrapolate, limit_of_two


@settings(max_examples=40, derandomize=True, deadline=None, database=None)
@given(
    st.floats(0.5, 6.0),
    st.floats(-1e5, 1e5).filter(lambda v: abs(v) > 1e-2),
    st.floats(0.01, 0.2),
    st.sampled_from([(4.0, 2.0, 1.0), (3.0, 2.0, 1.5), (1.0, 0.7, 0.5, 0.4)]),
    st.sampled_from([-1.0, 1.0]),
)
def test_power_laws_are_recovered(
    order: float, limit: float, size: float, sizes: tuple[float, ...], sign: float
) -> None:
    h = np.array(sizes) / sizes[-1]
    values = limit * (1.0 + sign * size * h**order / h[-3] ** order)
    found = extrapolate(sizes, values.tolist())
    assert found.order == pytest.approx(order, rel=1e-5)
    assert found.limit == pytest.approx(limit, rel=1e-7)
    share = abs(values[-1] / limit - 1.0)
    # Celik et al.: a quarter more than the distance to the limit.
    assert found.band(float(values[-1])) == pytest.approx(1.25 * share, rel=1e-4)
    assert found.spread == pytest.approx(np.ptp(values[-3:]))


def test_only_the_three_finest_count() -> None:
    values = [1 + h**2 for h in (4.0, 2.0, 1.0)]
    assert extrapolate((8.0, 4.0, 2.0, 1.0), [99.0, *values]) == extrapolate((4.0, 2.0, 1.0), values)


@pytest.mark.parametrize(
    "values",
    [
        (1.0, 2.0, 1.5),  # swings
        (1.0, 1.0, 1.1),  # one pair equal
        (1.0, 1.1, 1.4),  # runs away
        (1.0, 1.0, 1.0),  # nothing to fit
        (2.0, 1.5, 1.45, 1.46),  # the last three swing
    ],
)
def test_no_order_without_monotone_approach(values: tuple[float, ...]) -> None:
    sizes = (8.0, 4.0, 2.0, 1.0)[-len(values) :]
    found = extrapolate(sizes, values)
    assert np.isnan(found.order)
    assert found.limit == values[-1]
    # The band is then the spread of the three, with the same safety.
    assert found.band(values[-1]) == pytest.approx(1.25 * np.ptp(values[-3:]) / abs(values[-1]))


@pytest.mark.parametrize(
    ("sizes", "values", "sentence"),
    [
        ((2.0, 1.0), (1.0, 1.1), "2 values on 2 meshes, needed are at least three of each"),
        ((3.0, 2.0, 1.0), (1.0, 1.1), "2 values on 3 meshes, needed are at least three of each"),
        ((1.0, 2.0, 3.0), (1.0, 1.1, 1.2), "mesh sizes are not in falling order"),
        ((2.0, 2.0, 1.0), (1.0, 1.1, 1.2), "mesh sizes are not in falling order"),
    ],
)
def test_bad_studies(sizes: tuple[float, ...], values: tuple[float, ...], sentence: str) -> None:
    with pytest.raises(ValueError) as caught:
        extrapolate(sizes, values)
    assert str(caught.value) == sentence


@pytest.mark.parametrize("sizes", [(2.0, 1.0), (1.0, 2.0)])
def test_limit_of_two_meshes(sizes: tuple[float, float]) -> None:
    """Whichever of the two is finer; the band of a value is 1.25 times its distance to the limit."""
    values = (7.0 + 0.3 * sizes[0] ** 1.6, 7.0 + 0.3 * sizes[1] ** 1.6)
    found = limit_of_two(sizes, values, 1.6)
    assert found.limit == pytest.approx(7.0, rel=1e-12)
    assert found.band(values[0]) == pytest.approx(1.25 * 0.3 * sizes[0] ** 1.6 / 7.0, rel=1e-9)


@pytest.mark.parametrize(("sizes", "order"), [((1.0, 1.0), 2.0), ((2.0, 1.0), 0.0)])
def test_limit_of_two_needs_two_sizes_and_an_order(sizes: tuple[float, float], order: float) -> None:
    with pytest.raises(ValueError, match="allowed are two sizes, order above 0"):
        limit_of_two(sizes, (1.0, 2.0), order)
