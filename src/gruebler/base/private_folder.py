"""The folder of this user for what gruebler keeps from run to run, such as the token of open pages."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def private_folder() -> Path | None:
    """The folder `gruebler` in the user's cache, which nobody else can read or write; None where there is none.

    It is made if it is missing. A folder that is a link, belongs to another user or that others may write to is not
    taken.
    """
    for variable in ("XDG_CACHE_HOME", "LOCALAPPDATA"):
        if Path(os.environ.get(variable, "")).is_absolute():
            folder = Path(os.environ[variable]) / "gruebler"
            break
    else:
        try:
            folder = Path.home() / ".cache" / "gruebler"
        except RuntimeError:  # no home
            return None
        if not folder.parents[1].is_absolute() or not folder.parents[1].is_dir():
            return None
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        return folder if _only_mine(folder) and os.access(folder, os.W_OK) else None
    except OSError:
        return None


@contextmanager
def goes_on_from(file: Path | None) -> Iterator[None]:
    """An interrupt within has the file as its argument if what was done so far is kept there."""
    try:
        yield
    except KeyboardInterrupt:
        if file is not None and file.exists():
            raise KeyboardInterrupt(file) from None
        raise


def _only_mine(folder: Path) -> bool:
    """Whether a folder belongs to the user and nobody else may write to it."""
    if os.name != "posix":  # it lies in the user's profile, whose access lists Python does not show
        return not folder.is_symlink()
    status = os.lstat(folder)
    return stat.S_ISDIR(status.st_mode) and status.st_uid == os.geteuid() and not status.st_mode & 0o022
