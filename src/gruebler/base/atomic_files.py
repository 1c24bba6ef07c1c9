"""Files that appear complete or not at all, and the removal of what killed processes left on the disk.

A file is written under a temporary name beside its place and renamed when it is complete. The process that writes holds
a lock (`flock`) on it, and the system releases the lock when the process ends, however it ends. So a temporary file of
this host without a lock is abandoned: its process is gone, whatever runs under its number by now. The same holds for
temporary directories.

Nothing is removed that another host may be writing, or where the file system or the system (Windows) has no such locks.
"""

from __future__ import annotations

import os
import platform
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from secrets import token_hex
from tempfile import gettempdir, mkdtemp
from typing import BinaryIO

from gruebler.base.errors import RunError
from gruebler.base.text import reason_of

if sys.platform != "win32":
    import fcntl

PARTIAL = ".partial"
"""Ends the names of files that are not complete yet."""
_NAME = 40  # characters of the final name in the temporary one: with the rest it stays below the 255 bytes of a name


def _target(path: Path) -> Path:
    """Where links lead."""
    with suppress(OSError, RuntimeError):  # Python below 3.13 raises RuntimeError for a loop of links
        target = path.resolve()
        if not target.is_symlink():
            return target
    raise RunError("{path} cannot be written: a symbolic link in it leads nowhere", path=path)


@contextmanager
def atomic_file(path: Path, *, durable: bool = True, tidy: bool = True) -> Iterator[BinaryIO]:
    """A file to write that appears complete or not at all: written under a temporary name, then renamed.

    Args:
        path: where it appears; a link is followed, so that its target gets the content.
        durable: whether it is flushed to the disk before the renaming, so that it survives a loss of power.
        tidy: whether temporary files of the same name that killed processes left behind are removed first.

    Raises:
        RunError: it cannot be written, with the reason.
    """
    if not path.name:
        raise RunError("{path!r} names no file to write", path=str(path))
    given, path = path, _target(path)
    if path.exists() and not path.is_file():
        raise RunError("{path} cannot be written: it is not an ordinary file", path=given)
    if tidy:
        remove_abandoned_files(path.parent, path.name)
    temporary = path
    try:
        temporary, file = _created(path)
        with file:
            yield file
            file.flush()
            if durable:
                os.fsync(file.fileno())
            if sys.platform != "win32":  # the lock is held until the file has its name
                _rename(temporary, path)
        if sys.platform == "win32":  # an open file cannot be renamed there
            _rename(temporary, path)
        if durable:
            _flush_directory(path.parent)
    except OSError as error:
        about = str(path) if error.filename is None else str(error.filename)
        if about != str(path) and not about.endswith(PARTIAL):  # not the file written here
            raise RunError("{file} cannot be used: {reason}", file=about, reason=reason_of(error)) from None
        raise RunError("{path} cannot be written: {reason}", path=given, reason=reason_of(error)) from None
    finally:
        if temporary != path:
            temporary.unlink(missing_ok=True)


def write_whole(path: Path, content: bytes | str) -> None:
    """A file with this content, a text in UTF-8, that appears complete or not at all; `RunError` as `atomic_file`."""
    with atomic_file(path, durable=False) as file:
        file.write(content.encode("utf-8") if isinstance(content, str) else content)


def _created(path: Path) -> tuple[Path, BinaryIO]:
    """A new locked temporary file beside a path."""
    while True:
        temporary = path.with_name(f"{_beginning(path.name)}{token_hex(4)}{PARTIAL}")
        file = temporary.open("xb")
        _lock(file.fileno(), wait=True)
        if temporary.exists():  # else another process took it for abandoned before it was locked
            return temporary, file
        file.close()


def _rename(temporary: Path, path: Path) -> None:
    if path.exists():
        temporary.chmod(path.stat().st_mode & 0o7777)
    temporary.replace(path)


def _flush_directory(directory: Path) -> None:
    if os.name == "posix":  # elsewhere a directory cannot be opened, and renaming is flushed with the file
        handle = os.open(directory, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def remove_abandoned_files(directory: Path, name: str | None = None) -> None:
    """Remove the temporary files in a directory whose process has ended: those of one name, or all.

    What cannot be removed stays; nothing is raised.
    """
    beginning = "." if name is None else _beginning(name)
    own_prefix = f".{_host()}."
    with suppress(OSError), os.scandir(directory) as entries:
        for entry in entries:
            if entry.name.startswith(beginning) and own_prefix in entry.name and entry.name.endswith(PARTIAL):
                with suppress(OSError), _abandoned(Path(entry.path), os.O_RDWR):
                    Path(entry.path).unlink()


@contextmanager
def temporary_directory() -> Iterator[Path]:
    """A directory for this process in the system's temporary directory, removed at the end.

    Directories that killed processes of this user left behind are removed first.
    """
    beginning = f"gruebler-{_host()}-"
    with suppress(OSError), os.scandir(gettempdir()) as entries:
        for entry in entries:
            if entry.name.startswith(beginning) and entry.is_dir(follow_symlinks=False):
                with suppress(OSError), _abandoned(Path(entry.path), os.O_RDONLY):
                    shutil.rmtree(entry.path, ignore_errors=True)
    try:
        directory, handle = _created_directory(beginning)
    except OSError as error:
        raise RunError(
            "{folder} cannot be used for temporary files: {reason}",
            folder=gettempdir(),
            reason=reason_of(error),
        ) from None
    try:
        yield directory
    finally:
        shutil.rmtree(directory, ignore_errors=True)
        if handle is not None:
            os.close(handle)


def _created_directory(beginning: str) -> tuple[Path, int | None]:
    """A new locked temporary directory."""
    while True:
        directory = Path(mkdtemp(prefix=beginning))
        if sys.platform == "win32":
            return directory, None
        try:
            handle = os.open(directory, os.O_RDONLY)
        except FileNotFoundError:  # taken for abandoned before it was locked
            continue
        _lock(handle, wait=True)
        if directory.exists():
            return directory, handle
        os.close(handle)


# --- whose they are ----------------------------------------------------------------------------------


def _beginning(name: str) -> str:
    """How the names of the temporary files begin that this host writes for a file."""
    return f".{name[:_NAME]}.{_host()}."


@cache
def _host() -> str:
    """What tells this host from others that share a disk with it."""
    try:
        machine = Path("/etc/machine-id").read_text(encoding="ascii")
    except (OSError, UnicodeDecodeError):
        machine = ""
    return sha256(f"{platform.node()} {machine}".encode()).hexdigest()[:8]


@contextmanager
def _abandoned(path: Path, flags: int) -> Iterator[None]:
    """Hold the lock of a temporary file or directory of this user; `OSError` if a living process holds it."""
    if sys.platform == "win32":
        raise OSError("no locks")
    handle = os.open(path, flags | os.O_NOFOLLOW | os.O_NONBLOCK)
    try:
        if os.fstat(handle).st_uid != os.getuid() or not _lock(handle, wait=False):
            raise OSError("in use")
        yield
    finally:
        os.close(handle)


def _lock(handle: int, *, wait: bool) -> bool:
    """Whether the lock of an open file or directory could be taken; a file system without locks has none."""
    if sys.platform == "win32":
        return False
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except OSError:
        return False
    return True
