"""Where compiled kernels are kept: numba's `njit`, with a cache that knows all kernel sources.

numba reuses a compiled function while the file that defines it is unchanged. Our kernels call kernels of other files,
whose code is compiled into them; an upgrade that changes only the callee would silently keep the old code. Here the
folder of the cache is named after a digest of all kernel sources, so that any change compiles everything anew.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any, TypeVar

import numba

__all__ = ["cache_folder", "njit"]

_config: Any = numba.config  # its attributes are made at run time
Kernel = TypeVar("Kernel", bound=Callable[..., Any])


@cache
def cache_folder() -> Path:
    """The folder of this version's compiled kernels: beside the sources, or the user's cache if that is read-only."""
    here = Path(__file__).parent
    digest = sha256()
    for path in sorted(here.glob("*.py")):
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    name = f"kernels-{digest.hexdigest()[:16]}"
    beside = here / "__pycache__"
    if os.access(beside if beside.is_dir() else here, os.W_OK):
        return beside / name
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    home = Path(base) if base else Path.home() / ".cache"
    return (home if home.parent.is_dir() else Path(tempfile.gettempdir())) / "gruebler" / name


def njit(*arguments: Any, **options: Any) -> Callable[[Kernel], Kernel]:
    """`numba.njit`, its cache put into `cache_folder`; a NUMBA_CACHE_DIR of the user's own is left alone."""
    decorate = numba.njit(*arguments, **options)

    def decorated(function: Kernel) -> Kernel:
        before = _config.CACHE_DIR
        if not before:
            _config.CACHE_DIR = str(cache_folder())
        try:
            compiled: Kernel = decorate(function)
        finally:
            _config.CACHE_DIR = before
        return compiled

    return decorated
