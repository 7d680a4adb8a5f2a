"""Shared libraries of the system that gmsh and pyvista need: looked for before either is loaded, installed by setup."""

import ctypes
import os
import shutil
import subprocess
import sys
from importlib.util import find_spec

from pipeline.errors import InputError
from pipeline.typed import INSTALLED, NAME

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


EXTRAS = {
    "solid": ("gmsh", "meshio", "pyvista"),
    "studio": ("pyvista", "trame", "trame_plotly", "trame_pyvista", "trame_vtk", "trame_vuetify"),
    "distributed": ("dask", "distributed"),
}
"""Parts of the program that are installed on demand, by the name of the extra, with the packages that each brings."""


def require(extra: str) -> None:
    """Raise InputError that names what to install, packages and libraries of the system, for such a part."""
    missing = [name for name in EXTRAS[extra] if find_spec(name) is None]
    packages = missing_packages() if extra in ("solid", "studio") else []
    if not missing and not packages:
        return
    if not missing:
        raise InputError(missing_libraries())
    install = f"pip install '{NAME}[{extra}]'" if INSTALLED else "make setup"
    system = f" and apt-get install -y {' '.join(packages)} (names of Debian and Ubuntu)" if packages else ""
    raise InputError(
        f"this needs {', '.join(missing)}, which are not installed; install them with: {install}{system}"
    )


def wanted(package: str) -> None:
    """Raise InputError that names what to install for a package that is missing, if it is one of an extra."""
    for extra, packages in EXTRAS.items():
        if package.partition(".")[0] in packages:
            require(extra)


def require_libraries() -> None:
    """Raise InputError that names the packages to install, all at once."""
    if said := missing_libraries():
        raise InputError(said)


def missing_libraries() -> str:
    """One sentence that names the packages to install; empty where nothing is missing."""
    packages = missing_packages()
    if not packages:
        return ""
    return (
        "system libraries are missing that gmsh and pyvista need; install them with: "
        f"apt-get install -y {' '.join(packages)} (names of Debian and Ubuntu)"
    )


def missing_packages() -> list[str]:
    """Debian's packages of what is missing; other systems than Linux bring their own."""
    if sys.platform != "linux":
        return []
    return [package for library, package in NEEDED.items() if not loads(library)]


def install_libraries() -> None:
    """Install what is missing, and say so, where it may without a question; else, or in vain, raise InputError."""
    packages = missing_packages()
    if packages and shutil.which("apt-get") and (rights := administrator()) is not None:
        print(f"installing with apt-get what gmsh and pyvista need: {' '.join(packages)}", flush=True)
        apt = [*rights, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]
        if call([*apt, "update", "-q"]):
            call([*apt, "install", "-y", "-q", "--no-install-recommends", *packages])
    require_libraries()


def administrator() -> list[str] | None:
    """What stands before a command that only the administrator may run; None where it may not be run unasked."""
    if os.geteuid() == 0:
        return []
    return ["sudo", "-n"] if shutil.which("sudo") and call(["sudo", "-n", "true"]) else None


def call(command: list[str]) -> bool:
    """Whether a command ends well; what it says is shown only if it does not."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode and command[-1] != "true":
        print(done.stdout, file=sys.stderr, end="")
    return not done.returncode


def loads(library: str) -> bool:
    """Whether the dynamic linker finds a library."""
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


if __name__ == "__main__":
    try:
        install_libraries()
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        raise SystemExit(2) from None
