"""What pip calls to build the package: scikit-build-core, with two additions.

An editable installation puts the module `gruebler._core` beside the Python files in `src/gruebler` and `src` on the
path, so that a checkout is one tree for Python, mypy and a debugger. And where no C++ compiler is found, the one of the
package `ziglang` is taken; `CORE_COMPILER=zig` takes it in any case.
"""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from scikit_build_core import build as _build

Settings = dict[str, list[str] | str]

_ROOT = Path(__file__).resolve().parents[2]
_BUILD = _ROOT / "build" / "core"  # build-dir in pyproject.toml
_COMPILERS = ("c++", "g++", "clang++", "cl")

build_sdist = _build.build_sdist
get_requires_for_build_sdist = _build.get_requires_for_build_sdist
prepare_metadata_for_build_wheel = _build.prepare_metadata_for_build_wheel


def get_requires_for_build_wheel(config_settings: Settings | None = None) -> list[str]:
    """What scikit-build-core needs (cmake and ninja where they are missing), and a compiler where there is none."""
    return [*_build.get_requires_for_build_wheel(config_settings), *(["ziglang>=0.15"] if _needs_zig() else [])]


def build_wheel(
    wheel_directory: str, config_settings: Settings | None = None, metadata_directory: str | None = None
) -> str:
    """The wheel, and its name."""
    with _compiler() as settings:
        return _build.build_wheel(wheel_directory, {**settings, **(config_settings or {})}, metadata_directory)


get_requires_for_build_editable = get_requires_for_build_wheel
prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def build_editable(
    wheel_directory: str,
    config_settings: Settings | None = None,
    metadata_directory: str | None = None,  # noqa: ARG001 - the wheel makes its own
) -> str:
    """A wheel that puts `src` on the path; the module is installed in `src/gruebler`.

    scikit-build-core's own ways are import hooks, which go before PYTHONPATH.
    """
    source = _ROOT / "src"
    with tempfile.TemporaryDirectory() as folder, _compiler() as settings:
        path = Path(folder, "gruebler.pth")
        path.write_text(f"{source}\n", encoding="utf-8")
        own = {
            "wheel.packages": [],
            "wheel.exclude": "gruebler/",
            "wheel.force-include." + path.as_posix(): path.name,
            "wheel.py-api": "",  # a module for this Python alone: those of several lie side by side
            "cmake.define.CORE_FOLDER": (source / "gruebler").as_posix(),
        }
        return _build.build_wheel(wheel_directory, {**settings, **(config_settings or {}), **own})


def _needs_zig() -> bool:
    asked = os.environ.get("CORE_COMPILER")
    if asked:
        return asked == "zig"
    return not (os.environ.get("CXX") or any(map(shutil.which, _COMPILERS)))


@contextmanager
def _compiler() -> Iterator[Settings]:
    """The settings to build with; the compiler is in the environment while it lasts, if it is zig."""
    for name in (".skbuild-info.json", "CMakeCache.txt"):  # by the note it would know that pip has unpacked it
        (_BUILD / name).unlink(missing_ok=True)  # elsewhere this time, and throw away what is compiled
    if not _needs_zig():
        yield {}
        return
    before = dict(os.environ)
    os.environ.update(CC=_zig("cc"), CXX=_zig("c++"))
    try:
        yield {
            "cmake.define.CMAKE_AR": _zig("ar"),
            "cmake.define.CMAKE_RANLIB": _zig("ranlib"),
            "cmake.define.CORE_ZIG": "ON",
            # Trials are compiled, not linked: zig makes its C++ library when it links, once for each set of options.
            "cmake.define.CMAKE_TRY_COMPILE_TARGET_TYPE": "STATIC_LIBRARY",
        }
    finally:
        os.environ.clear()
        os.environ.update(before)


def _zig(name: str) -> str:
    """CMake wants a program, not a program with arguments, and the same one each time."""
    windows = os.name == "nt"
    file = _ROOT / "build" / "zig" / (f"zig-{name}.bat" if windows else f"zig-{name}")
    file.parent.mkdir(parents=True, exist_ok=True)
    run = f'"{sys.executable}" -m ziglang {name}'
    script = f"""#!/bin/sh
case "$*" in *CompilerId.c*) set -- -c "$@" ;; esac # CMake's first trial is not linked either
exec {run} "$@"
"""
    file.write_text(f"@{run} %*\n" if windows else script, encoding="utf-8")
    file.chmod(0o755)
    return file.as_posix()
