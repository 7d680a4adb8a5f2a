"""Memory that arrays free stays with the process: given back, each array's pages would have to be mapped anew."""

import ctypes
import sys

_TRIM, _MAP = -1, -3
"""Numbers of the settings in <malloc.h> of the GNU C library."""
_KEPT, _LARGE = 1 << 30, 1 << 25
"""Bytes: kept at most, and from which an array has a mapping of its own, the most that the library takes."""


def keep_freed() -> None:
    """Tell the C library so where it is GNU's; any other is left as it is."""
    if sys.platform != "linux":
        return
    library = ctypes.CDLL(None)
    if hasattr(library, "mallopt"):
        library.mallopt(_TRIM, _KEPT)
        library.mallopt(_MAP, _LARGE)
