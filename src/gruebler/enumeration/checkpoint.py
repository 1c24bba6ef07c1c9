"""Finished work on disk: files that are whole or not there, and directories from which a killed run goes on."""

from __future__ import annotations

import hashlib
import json
import os
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

from gruebler.errors import GrueblerError

__all__ = ["Checkpoint", "PieceFiles", "RunError", "whole_file"]

_MANIFEST = "manifest.json"
_ASIDE = ".aside"  # ends the names of files that are not whole yet
_LAYOUT = 2  # of the checkpoint directory


class RunError(GrueblerError):
    """A run that cannot begin or go on: workers that keep dying, a directory of another task, an unwritable file."""


class PieceFiles:
    """A directory with a file for each finished piece: a line of plain data, then bytes.

    Args:
        directory: where they are.
        durable: whether each file is flushed to the disk before it counts.
    """

    def __init__(self, directory: Path, *, durable: bool) -> None:
        self.directory = directory
        self.durable = durable

    def save(self, number: int, head: Mapping[str, Any], body: bytes = b"") -> None:
        """Keep a piece: some plain data and bytes."""
        with whole_file(self._path(number), durable=self.durable) as file:
            file.write(json.dumps({**head, **_seal(head, body)}).encode() + b"\n" + body)

    def head(self, number: int) -> dict[str, Any] | None:
        """The plain data of a piece kept before, or None; a damaged file counts as none."""
        try:
            with self._path(number).open("rb") as file:
                line = file.readline()
                found = json.loads(line)
                body = file.read()
        except (FileNotFoundError, UnicodeDecodeError, json.JSONDecodeError):
            return None
        if not isinstance(found, dict):
            return None
        kept = {"bytes": found.pop("bytes", None), "sha256": found.pop("sha256", None)}
        return found if kept == _seal(found, body) else None

    def body(self, number: int) -> bytes:
        """The bytes of a piece kept before."""
        return self._path(number).read_bytes().partition(b"\n")[2]

    def remove(self, number: int) -> None:
        """Forget a piece."""
        self._path(number).unlink()

    def _path(self, number: int) -> Path:
        return self.directory / f"{number:07d}.piece"


def _seal(head: Mapping[str, Any], body: bytes) -> dict[str, Any]:
    """What tells a piece as it was written from one that was cut off or changed."""
    text = json.dumps(head, sort_keys=True).encode()
    return {"bytes": len(body), "sha256": hashlib.sha256(text + b"\n" + body).hexdigest()}


class Checkpoint(PieceFiles):
    """A directory that keeps finished pieces, so that a run killed at any moment can be gone on with.

    Each piece is a file of its own, written aside, flushed to the disk and renamed; a manifest says what was asked
    and which version answered.

    Args:
        directory: made if it is not there.
        task: what is asked, as plain data.
        version: the version that does the work.

    Raises:
        RunError: the directory belongs to another task or version, is something else, or cannot be used.
    """

    def __init__(self, directory: Path, task: Mapping[str, Any], version: str) -> None:
        super().__init__(directory, durable=True)
        manifest = {"layout": _LAYOUT, "version": version, "task": dict(task)}
        try:
            directory.mkdir(parents=True, exist_ok=True)
            path = directory / _MANIFEST
            if path.exists():
                _compare(directory, json.loads(path.read_text(encoding="utf-8")), manifest)
            elif any(not entry.name.endswith(_ASIDE) for entry in directory.iterdir()):
                raise RunError(f"{directory} holds other files: give --checkpoint a directory of its own")
            else:
                with whole_file(path) as file:
                    file.write(json.dumps(manifest, indent=2).encode())
        except OSError as error:
            raise RunError(f"{directory} cannot keep pieces of work: {error.strerror or error}") from None
        except (UnicodeDecodeError, json.JSONDecodeError):
            raise RunError(f"{directory / _MANIFEST} cannot be read; remove the directory to begin again") from None


def _compare(directory: Path, found: Mapping[str, Any], wanted: Mapping[str, Any]) -> None:
    if found == wanted:
        return
    if found.get("task") == wanted["task"]:
        other = f"version {found.get('version')} of gruebler, this is version {wanted['version']}"
    else:
        other = f"another task, {json.dumps(found.get('task'))}"
    raise RunError(f"{directory} keeps pieces of {other}; give another directory or remove this one")


@contextmanager
def whole_file(path: Path, *, durable: bool = True) -> Iterator[BinaryIO]:
    """A file to write that appears whole or not at all: written aside, flushed to the disk, then renamed.

    Args:
        path: where it appears.
        durable: whether it is flushed to the disk, so that it is whole after a loss of power too.

    Raises:
        RunError: it cannot be written.
    """
    if not path.name:
        raise RunError(f"{str(path)!r} names no file to write")
    path = path.resolve()  # a link is followed, so that its target gets the content
    if path.exists() and not path.is_file():
        raise RunError(f"{path} cannot be written: it is not an ordinary file")
    aside = path.with_name(f".{path.name}.{os.getpid()}.{threading.get_ident()}{_ASIDE}")
    try:
        with aside.open("wb") as file:
            yield file
            if durable:
                file.flush()
                os.fsync(file.fileno())
        if path.exists():
            aside.chmod(path.stat().st_mode & 0o7777)
        aside.replace(path)
        if durable:
            _flush_directory(path.parent)
    except OSError as error:
        raise RunError(f"{path} cannot be written: {error.strerror or error}") from None
    finally:
        aside.unlink(missing_ok=True)


def _flush_directory(directory: Path) -> None:
    if os.name == "posix":  # elsewhere a directory cannot be opened, and renaming is flushed with the file
        handle = os.open(directory, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
