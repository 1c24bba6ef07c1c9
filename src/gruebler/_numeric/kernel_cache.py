"""Where compiled kernels are kept on disk, and whether that folder can be trusted.

Loading a kernel runs code that stands in its file (a pickle). So a folder is used only if nobody but this user can
write there: it belongs to the user, is no link, and neither group nor others may write to it; the same holds for all
folders above it, but that root and folders with the sticky bit are trusted there. Where there is no such folder,
kernels are compiled in memory. Of group rights, those of the user's own group are trusted above the folder, since
many systems give every user a group.
"""

from __future__ import annotations

import os
import shutil
import stat
import sys
import time
from collections.abc import Callable, Iterator
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

_SOURCES = Path(__file__).parent
_PACKAGE = _SOURCES.parent
_UNUSED_DAYS = 60  # after so long without use the kernels of another version are removed


def kernel_sources() -> list[Path]:
    """The files that go into compiled code: kernels, and the numbers and the memory that they use."""
    inner = (path for path in _SOURCES.rglob("*.py") if path.name not in ("kernel_cache.py", "work_estimates.py"))
    return sorted([*inner, *_PACKAGE.rglob("*_kernels.py"), *_PACKAGE.rglob("*_memory.py")])


@cache
def _name() -> str:
    digest = sha256()
    for path in kernel_sources():
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    return f"kernels-{digest.hexdigest()[:16]}"


def _places() -> Iterator[Path]:
    """Where kernels may be kept: where NUMBA_CACHE_DIR says, else beside the sources, else in the user's cache."""
    asked = os.environ.get("NUMBA_CACHE_DIR", "")
    if Path(asked).is_absolute():
        yield Path(asked)
    beside = _SOURCES / "__pycache__"
    if os.access(beside if beside.is_dir() else _SOURCES, os.W_OK):
        yield beside
    for variable in ("XDG_CACHE_HOME", "LOCALAPPDATA"):
        base = os.environ.get(variable, "")
        if Path(base).is_absolute():
            yield Path(base) / "gruebler"
            return
    try:
        home_folder = Path.home()
    except RuntimeError:
        return
    if home_folder.is_absolute() and home_folder.is_dir():
        yield home_folder / ".cache" / "gruebler"


def _only_mine(folder: Path) -> bool:
    """Whether this folder, if it exists, belongs to the user and nobody else may write to it."""
    if os.name != "posix":  # the folders are in the user's profile, whose access lists Python does not show
        return not folder.is_symlink()
    try:
        status = os.lstat(folder)
    except FileNotFoundError:
        return True
    except OSError:
        return False
    return stat.S_ISDIR(status.st_mode) and status.st_uid == os.geteuid() and not status.st_mode & 0o022


def _guarded(folder: Path) -> bool:
    """Whether only the user and root can replace what is in a folder; a sticky bit guards what is theirs."""
    if os.name != "posix" or not folder.exists():
        return True
    status = folder.stat()
    if status.st_uid not in (os.geteuid(), 0):
        return False
    others = stat.S_IWOTH if status.st_gid in (os.getegid(), 0) else stat.S_IWOTH | stat.S_IWGRP
    return bool(status.st_mode & stat.S_ISVTX) or not status.st_mode & others


def _trusted(place: Path) -> Path | None:
    """The folder for kernels in a place, if it can be trusted."""
    folder = place / _name()
    try:
        if not _only_mine(folder):
            return None
        if place.parent == _SOURCES:  # who can write further up can replace the sources themselves
            return folder if not place.is_symlink() and _guarded(place) and _guarded(_SOURCES) else None
        above = Path(os.path.realpath(place)).parents
        return folder if _only_mine(place) and all(map(_guarded, above)) else None
    except OSError:
        return None


def cache_folder() -> Path | None:
    """The folder of this version's compiled kernels, whether or not it exists yet; None if no place can be trusted."""
    for place in _places():
        folder = _trusted(place)
        if folder is not None:
            return folder
    return None


@cache
def prepared_folder() -> Path | None:
    """`cache_folder`, made with access for the user only; None if there is none or it cannot be made."""
    for place in _places():
        if _trusted(place) is None:
            continue
        folder = place / _name()
        try:
            for part in (*reversed(place.parents), place, folder):
                if not part.is_dir():
                    part.mkdir(mode=0o777 if part.parent == _SOURCES else 0o700, exist_ok=True)
            if _trusted(place) is None or not os.access(folder, os.W_OK):
                continue
            if os.name == "posix":
                folder.chmod(0o700)  # others could read a folder from a copied installation, not write to it
            os.utime(folder)
        except OSError:
            continue
        _forget_unused(place)
        return folder
    return None


def _forget_unused(place: Path) -> None:
    """Remove the kernels of other versions that were not used for long."""
    limit = time.time() - _UNUSED_DAYS * 86400
    for folder in place.glob("kernels-*"):
        try:
            if folder.name != _name() and _only_mine(folder) and os.lstat(folder).st_mtime < limit:
                shutil.rmtree(folder, ignore_errors=True)
        except OSError:
            continue


@cache
def _cached_names() -> frozenset[str]:
    """`module.kernel-line` of the kernels that lie in the cache for this version of Python."""
    folder = cache_folder()
    indices = folder.glob("*/*.nbi") if folder is not None else ()
    version = f".py{sys.version_info.major}{sys.version_info.minor}"
    return frozenset(path.name.removesuffix(".nbi").removesuffix(version) for path in indices)


def is_cached(kernel: Callable[..., Any]) -> bool:
    """Whether a compiled form of a kernel lies in the cache, for some types of its arguments."""
    module = kernel.__module__.rpartition(".")[2]
    return f"{module}.{kernel.__qualname__}-{kernel.__code__.co_firstlineno}" in _cached_names()
