"""A matplotlib figure that a notebook draws where it ends a cell, and that nothing else shows."""

from __future__ import annotations

import io
from typing import Any

from matplotlib.figure import Figure

DPI = 110
"""Dots per inch of a picture in a page: 8 inches are as wide as a notebook."""


class Picture(Figure):
    """A figure with its PNG; it is made without pyplot, so that no window and no backend is needed."""

    def png(self) -> bytes:
        """The same bytes every time."""
        return self.saved("png")

    def saved(self, form: str) -> bytes:
        """As png, svg or pdf."""
        dates: dict[str, dict[str, Any]] = {
            "png": {"Software": None},
            "svg": {"Date": None},
            "pdf": {"CreationDate": None},
        }
        out = io.BytesIO()
        self.savefig(out, format=form, dpi=DPI, bbox_inches="tight", metadata=dates[form])
        return out.getvalue()

    def _repr_png_(self) -> bytes:
        return self.png()
