"""Shared libraries of the system that gmsh and pyvista need: looked for before either is loaded."""

import ctypes
import sys

from pipeline.errors import InputError

# Debian's package of each; without libEGL pyvista's first picture ends the process without a word.
NEEDED = {
    "libGLU.so.1": "libglu1-mesa",
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
    "libgomp.so.1": "libgomp1",
    "libXcursor.so.1": "libxcursor1",
    "libXft.so.2": "libxft2",
    "libXinerama.so.1": "libxinerama1",
}


def require_libraries() -> None:
    """Raise InputError that names the packages to install, all at once; other systems than Linux bring their own."""
    if sys.platform != "linux":
        return
    missing = [package for library, package in NEEDED.items() if not loads(library)]
    if missing:
        raise InputError(
            "system libraries are missing that gmsh and pyvista need; install them with: "
            f"apt-get install -y {' '.join(missing)} (names of Debian and Ubuntu)"
        )


def loads(library: str) -> bool:
    """Whether the dynamic linker finds a library."""
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


if __name__ == "__main__":
    try:
        require_libraries()
    except InputError as error:
        raise SystemExit(f"error: {error}") from None
