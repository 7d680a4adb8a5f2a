"""Work on a file that may be hostile, in a process of its own with a time limit: arrays come back, or a sentence."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Arrays = dict[str, npt.NDArray[Any]]
ASKED, TOLD, ARRAYS = "asked.json", "told.json", "arrays.npz"
# Of the memory of the machine, which a file may ask for without end.
MEMORY_SHARE = 0.8


class Child:
    """`module.work(asked)` in another process, which starts at once; what is open is ended and cleared away."""

    def __init__(self, module: str, asked: dict[str, Any]) -> None:
        self._kept = tempfile.TemporaryDirectory()
        self.folder, self.start = Path(self._kept.name), time.monotonic()
        (self.folder / ASKED).write_text(json.dumps(asked), encoding="utf-8")
        code = f"from {__name__} import main; main({module!r}, {str(self.folder)!r})"
        self.process = subprocess.Popen(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(p or os.getcwd() for p in sys.path)},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
        )

    def __enter__(self) -> "Child":
        return self

    def __exit__(self, *_: object) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
        self._kept.cleanup()

    def found(self, seconds: float) -> tuple[dict[str, Any], Arrays]:
        """Told and arrays, both plain, at the latest so many seconds after the start.

        ValueError with the sentence of the work's own ValueError, or that the file took too long or ended the reader.
        """
        try:
            left = max(self.start + seconds - time.monotonic(), 0.0)
            _, said = self.process.communicate(timeout=left)
        except subprocess.TimeoutExpired:
            raise ValueError(
                f"took longer than {seconds:g} s to read and mesh, allowed is a file that takes less; a larger mesh "
                "size takes less"
            ) from None
        if not (self.folder / TOLD).exists():
            why = _ending(self.process.returncode, said)
            raise ValueError(f"ended the program that reads it ({why}): it is damaged")
        told = json.loads((self.folder / TOLD).read_text(encoding="utf-8"))
        if "error" in told:
            raise ValueError(told["error"])
        with np.load(self.folder / ARRAYS) as kept:
            return told, {key: kept[key] for key in kept.files}


def in_child(module: str, asked: dict[str, Any], seconds: float) -> tuple[dict[str, Any], Arrays]:
    """What `module.work(asked)` returns, run in another process and waited for; ValueError as `Child.found`."""
    with Child(module, asked) as child:
        return child.found(seconds)


def main(module: str, folder: str) -> None:
    """The child: run the work, leave what it found or its complaint in the folder."""
    from importlib import import_module

    _limited()
    place = Path(folder)
    asked = json.loads((place / ASKED).read_text(encoding="utf-8"))
    work: Callable[[dict[str, Any]], tuple[dict[str, Any], Arrays]] = import_module(module).work
    try:
        told, arrays = work(asked)
        np.savez(place / ARRAYS, **arrays)  # type: ignore[arg-type]
    except ValueError as error:
        told = {"error": str(error)}
    except MemoryError:
        told = {"error": "needs more memory than this machine has; a larger mesh size takes less"}
    except Exception as error:
        # gmsh raises the bare class.
        if type(error) is not Exception:
            raise
        told = {"error": f"could not be read or meshed: {' '.join(str(error).split())[:200]}"}
    (place / TOLD).write_text(json.dumps(told), encoding="utf-8")


def _limited() -> None:
    """No core file, and no more memory than most of what the machine has."""
    try:
        import resource
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    pages, size = os.sysconf("SC_PHYS_PAGES"), os.sysconf("SC_PAGE_SIZE")
    most = int(MEMORY_SHARE * pages * size)
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    if hard == resource.RLIM_INFINITY or hard > most:
        resource.setrlimit(resource.RLIMIT_AS, (most, hard))


def _ending(code: int, said: bytes) -> str:
    if code < 0:
        return signal.Signals(-code).name
    last = said.decode("utf-8", "replace").strip().splitlines()
    return last[-1][:120] if last else f"exit code {code}"
