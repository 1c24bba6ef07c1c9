"""Finished pieces of work on disk, and checkpoint directories from which a killed run resumes."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gruebler.base.atomic_files import PARTIAL, atomic_file, remove_abandoned_files
from gruebler.base.errors import RunError
from gruebler.base.text import reason_of

_MANIFEST = "manifest.json"
_LAYOUT = 5  # of the checkpoint directory, and how the work is divided into pieces


class PieceFiles:
    """A directory with a file for each finished piece: a line of plain data, then bytes.

    Each file contains a digest of its content, its number and its task, so that a piece of another number or
    another task is rejected.

    Args:
        directory: the directory of the files.
        durable: whether each file is flushed to the disk before it counts.
        task: the task of the pieces, as plain data.
    """

    def __init__(self, directory: Path, *, durable: bool, task: Mapping[str, Any] | None = None) -> None:
        self.directory = directory
        self.durable = durable
        self.task = json.dumps(task, sort_keys=True)

    def save(self, number: int, head: Mapping[str, Any], body: bytes = b"") -> None:
        """Store a piece: some plain data and bytes."""
        with atomic_file(self._path(number), durable=self.durable, tidy=False) as file:
            file.write(json.dumps({**head, **self._seal(number, head, body)}).encode() + b"\n" + body)

    def head(self, number: int) -> dict[str, Any] | None:
        """The plain data of a stored piece, or None; a damaged file counts as none.

        Raises:
            RunError: the file cannot be read.
        """
        try:
            line, _, body = self._path(number).read_bytes().partition(b"\n")
            content = json.loads(line)
            seal = {key: content.pop(key) for key in ("bytes", "sha256")}
            return content if seal == self._seal(number, content, body) else None
        except FileNotFoundError:
            return None
        except OSError as error:
            raise RunError(
                "{path} cannot be read: {reason}", path=self._path(number), reason=reason_of(error)
            ) from None
        except (ValueError, RecursionError, LookupError, AttributeError, TypeError):
            return None  # no JSON, a number of thousands of digits, nested without end, no object, no seal

    def body(self, number: int) -> bytes:
        """The bytes of a stored piece; `RunError` if they cannot be read."""
        try:
            return self._path(number).read_bytes().partition(b"\n")[2]
        except OSError as error:
            raise RunError(
                "{path} cannot be read: {reason}", path=self._path(number), reason=reason_of(error)
            ) from None

    def remove(self, number: int) -> None:
        """Delete a piece."""
        self._path(number).unlink()

    def tidy(self) -> None:
        """Remove the incomplete files of killed processes."""
        remove_abandoned_files(self.directory)

    def _path(self, number: int) -> Path:
        return self.directory / f"{number:07d}.piece"

    def _seal(self, number: int, head: Mapping[str, Any], body: bytes) -> dict[str, Any]:
        """Size and digest, which detect a damaged, changed or exchanged piece."""
        digest = hashlib.sha256(f"{self.task}\n{number}\n{json.dumps(head, sort_keys=True)}\n".encode())
        digest.update(body)
        return {"bytes": len(body), "sha256": digest.hexdigest()}


def checkpoint_files(directory: Path, task: Mapping[str, Any], version: str) -> PieceFiles:
    """The files of a directory that keeps finished pieces, so that a run killed at any moment can resume.

    Each piece is an atomic file; a manifest records the task and the version. Temporary files of killed runs are
    removed.

    Args:
        directory: created if it does not exist.
        task: the request, as plain data.
        version: the version of this library.

    Raises:
        RunError: the directory belongs to another task or version, is something else, or cannot be used.
    """
    manifest = {"layout": _LAYOUT, "version": version, "task": dict(task)}
    files = PieceFiles(directory, durable=True, task=manifest)
    path = directory / _MANIFEST
    try:
        directory.mkdir(parents=True, exist_ok=True)
        files.tidy()
        if path.exists():
            _compare(directory, json.loads(path.read_text(encoding="utf-8")), manifest)
        elif any(not entry.name.endswith(PARTIAL) for entry in directory.iterdir()):
            raise RunError(
                "{directory} holds other files: give --checkpoint a directory of its own", directory=directory
            )
        else:
            with atomic_file(path, tidy=False) as file:
                file.write(json.dumps(manifest, indent=2).encode())
    except OSError as error:
        raise RunError(
            "{directory} cannot hold the finished parts: {reason}", directory=directory, reason=reason_of(error)
        ) from None
    except RunError:
        raise
    except (ValueError, RecursionError):
        raise RunError("{path} cannot be read; remove the directory to begin again", path=path) from None
    return files


def _compare(directory: Path, manifest: object, expected: Mapping[str, Any]) -> None:
    """Raise `RunError` for a manifest other than the expected one, `ValueError` for anything else."""
    if manifest == expected:
        return
    if not isinstance(manifest, dict):
        raise ValueError("no manifest")
    if manifest.get("task") == expected["task"]:
        raise RunError(
            "{directory} holds parts from version {other} of gruebler, this is version {version}; give another "
            "directory or remove this one",
            directory=directory,
            other=manifest.get("version"),
            version=expected["version"],
        )
    raise RunError(
        "{directory} holds parts of another task, {task}; give another directory or remove this one",
        directory=directory,
        task=json.dumps(manifest.get("task")),
    )
