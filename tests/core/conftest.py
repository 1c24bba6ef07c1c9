"""The module of `core/`, built on demand as `make core` builds it; without its tools the tests are skipped."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]
BUILD = ROOT / "build" / f"core-tests-{sys.version_info.major}.{sys.version_info.minor}"
COMPILERS = ("c++", "g++", "clang++", "cl")


def missing() -> str | None:
    """What is missing to build the module."""
    places = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    absent = [name for name in ("cmake", "ninja") if not shutil.which(name, path=places)]
    absent += [] if find_spec("nanobind") else ["nanobind"]
    if absent:
        return f"{', '.join(absent)} not installed: pip install 'gruebler[core]'"
    if not os.environ.get("CXX") and not any(map(shutil.which, COMPILERS)):
        return "no C++ compiler"
    return None


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """One process builds, others wait."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "lock").open("w") as file:
        try:
            from fcntl import LOCK_EX, flock
        except ImportError:  # Windows
            yield
            return
        flock(file, LOCK_EX)
        yield


@pytest.fixture(scope="session")
def build_folder() -> Path:
    """Where the module and its object files are."""
    if reason := missing():
        pytest.skip(reason)
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    cmake = shutil.which("cmake", path=path)
    assert cmake
    options = ["-G", "Ninja", f"-DPython_EXECUTABLE={sys.executable}"]
    with alone(BUILD):
        for command in ([cmake, "-S", str(ROOT / "core"), "-B", str(BUILD), *options], [cmake, "--build", str(BUILD)]):
            done = subprocess.run(
                command, capture_output=True, text=True, check=False, env={**os.environ, "PATH": path}
            )
            assert done.returncode == 0, done.stdout + done.stderr
    return BUILD


@pytest.fixture(scope="session")
def core(build_folder: Path) -> ModuleType:
    """The module."""
    (file,) = [*build_folder.glob("_core*.so"), *build_folder.glob("_core*.pyd")]
    spec = spec_from_file_location("_core", file)
    assert spec
    assert spec.loader
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
