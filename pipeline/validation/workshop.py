"""Stage results kept on disk by the hash of what they depend on."""

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from pydantic import TypeAdapter, ValidationError

from pipeline.progress import Progress, Stage
from pipeline.provenance import code_digest
from pipeline.validation.result import write_text

T = TypeVar("T")


@dataclass(frozen=True)
class Workshop:
    """Where intermediate results lie, and who is told what is going on."""

    folder: Path
    progress: Progress

    @property
    def meshes(self) -> Path:
        return self.folder / "meshes"

    def key(self, stage: str, inputs: object) -> str:
        """Hash of a stage's name, its inputs and the code."""
        text = json.dumps([stage, inputs, code_digest()], sort_keys=True, default=str)
        return hashlib.sha256(text.encode()).hexdigest()[:20]

    def reuse(
        self,
        stage: str,
        inputs: object,
        kind: type[T],
        compute: Callable[[Stage], T],
        files: tuple[str, ...] = (),
    ) -> T:
        """The stage's result from disk if it was made with the same inputs and code, else computed and kept.

        `files` are names in this stage's own folder that `compute` writes and that have to be there too. A damaged
        file counts as not there.
        """
        key = self.key(stage, inputs)
        path = self.folder / "stages" / f"{key}.json"
        adapter = TypeAdapter(kind)
        with self.progress.stage(stage) as running:
            if path.is_file() and all((self.files(stage, inputs) / name).is_file() for name in files):
                try:
                    value = adapter.validate_json(path.read_bytes())
                    running.note = "reused"
                    return value
                except ValidationError:
                    path.unlink(missing_ok=True)
            value = compute(running)
            write_text(path, adapter.dump_json(value).decode())
            return value

    def files(self, stage: str, inputs: object) -> Path:
        """Folder for the files of a stage."""
        return self.folder / "stages" / self.key(stage, inputs)
