"""What of a row lies beyond the fitted tests: numbers, no rounding."""

from __future__ import annotations

from pipeline.predict.ranges import Ranges

SPANS = {"y_mm": (0.0, 3.0), "z_mm": (0.0, 0.0), "fy_N": (0.0, 200.0)}


def said(**columns: float) -> list[str]:
    return list(Ranges(SPANS, (0.0, 0.0), ()).of_readings(columns))


def test_rounding_of_what_nothing_moves_is_not_beyond() -> None:
    assert not said(z_mm=-5e-24, x_mm=1e-15, y_mm=3.02)


def test_what_moves_is() -> None:
    assert said(z_mm=-1e-4) == ["z_mm -0.0001, fitted 0 to 0"]
    assert said(x_mm=0.5) == ["x_mm 0.5, in no fitted test"]
    assert said(y_mm=3.1, fy_N=300.0) == ["y_mm 3.1, fitted 0 to 3", "fy_N 300, fitted 0 to 200"]


def test_a_zero_outside_of_what_was_fitted_is_beyond() -> None:
    """A load or a temperature of zero, where all that was fitted is above."""
    ranges = Ranges({"temperature_C": (18.0, 25.0), "fx_N": (1e3, 5e3)}, (0.0, 0.0), ())
    said = list(ranges.of_readings({"temperature_C": 0.0, "fx_N": 0.0}))
    assert said == ["temperature_C 0, fitted 18 to 25", "fx_N 0, fitted 1000 to 5000"]
