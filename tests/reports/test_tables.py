"""Numbers of a table stand by their points, or end in one line where some have powers of ten."""

from __future__ import annotations

import pytest

from reports.blocks import Column, table


@pytest.mark.parametrize(("cells", "width"), [(("1.25", "0.5"), 3), (("0", "4.9×10⁻⁸"), 0), ((), 0)])
def test_what_is_reserved_right_of_the_point(cells: tuple[str, ...], width: int) -> None:
    it = table("", [Column("value", numeric=True)], [[cell] for cell in cells])
    assert it.fraction_width(0) == width
