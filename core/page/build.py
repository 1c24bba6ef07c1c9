"""Compiles what the page needs of the kernels into modules, by the clang of `ziglang`.

    python core/page/build.py      # needs `ziglang`, `zopfli` and npx; some minutes the first time, then a minute

`motion.wasm.gz`, which every page carries as text, moves linkages; `solutions.wasm.gz` finds four-bars through points,
and is loaded when they are asked for. A module tells which sources it was made of, so that a test can say whether it
belongs to those that are here.
"""

from __future__ import annotations

import hashlib
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).parent
CORE = HERE.parent
SECTION = b"gruebler sources"
"""A custom section of a module: engines pass over it."""


class Module(NamedTuple):
    """What is compiled into one file."""

    target: Path
    units: tuple[str, ...]
    exports: tuple[str, ...]
    hot: str
    """The unit in which nearly all of the time is spent; the others are compiled for their size."""


MOTION = ("bars", "closure", "closure_rates", "dyads", "newton", "placing", "plan", "sweep", "swept", "walk")
MODULES = (
    Module(
        target=HERE / "motion.wasm.gz",
        units=(
            "page/door.cpp",
            *(f"src/motion/{name}.cpp" for name in MOTION),
        ),
        exports=("reserve", "run", "unwound"),
        hot="src/motion/sweep.cpp",  # rows of dyads abreast
    ),
    Module(
        target=HERE / "solutions.wasm.gz",
        units=("page/solutions_door.cpp", "src/algebra/tracking.cpp", "src/algebra/certificate.cpp"),
        exports=("reserve", "track", "refine", "certify"),
        hot="src/algebra/tracking.cpp",
    ),
)
OPTIONS = (
    "--target=wasm32-wasi",  # nothing of the system remains in it, see door.cpp
    "-std=c++20",
    "-msimd128",
    "-mbulk-memory",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-fno-trapping-math",
    "-fno-exceptions",
    "-fno-rtti",
    "-fno-threadsafe-statics",
    "-fvisibility=hidden",
    "-Wall",
    "-Wextra",
    "-Wno-inline-namespace-reopened-noninline",
    "-g0",
)
QUICK = (
    "-O3",
    "-DGRUEBLER_NO_JERK",  # the page asks for accelerations at most
    "-DGRUEBLER_NO_SIX_BARS",  # and follows solutions of four-bars alone
    "-mllvm",
    "-unroll-runtime=false",
    "-Werror=pass-failed",  # a hot loop that is not vectorised
)
SMALL = ("-Os", "-mllvm", "-inline-threshold=0")  # 2 % smaller than as clang weighs it
LINKING = ("-mexec-model=reactor", "-Wl,--strip-all", "-Wl,--gc-sections")


OPTIMISER = (
    "npx",
    "--yes",
    "--package=binaryen@132.0.0",  # 5 % smaller, as quick, the same operations on numbers
    "wasm-opt",
    "-O3",
    "--enable-simd",
    "--enable-bulk-memory",
    "--enable-sign-ext",
    "--enable-nontrapping-float-to-int",
    "--enable-mutable-globals",
)


def sources(module: Module) -> list[Path]:
    """The units and all that they include of the core, and this file, which holds the options."""
    found: dict[Path, None] = {}
    waiting = [CORE / unit for unit in module.units]
    while waiting:
        file = waiting.pop()
        if file in found:
            continue
        found[file] = None
        for name in re.findall(r'#include "(.+)"', file.read_text(encoding="utf-8")):
            beside = file.parent / name
            waiting.append(beside if beside.exists() else CORE / "src" / name)
    return [*sorted(found), Path(__file__)]


def digest(module: Module) -> bytes:
    """Of the names and the texts of all sources."""
    made = hashlib.sha256()
    for file in sources(module):
        made.update(file.relative_to(CORE).as_posix().encode() + b"\0" + file.read_bytes() + b"\0")
    return made.hexdigest().encode()


def with_digest(module: Module, compiled: bytes) -> bytes:
    """A module with one more section; lengths below 128 are one byte."""
    content = bytes([len(SECTION)]) + SECTION + digest(module)
    return compiled + bytes([0, len(content)]) + content


def compiled(module: Module) -> bytes:
    """The module of the linker, made smaller."""
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "module.wasm"
        command = [sys.executable, "-m", "ziglang", "c++", *OPTIONS, f"-I{CORE / 'src'}"]
        parts = [str(Path(folder) / f"{Path(unit).stem}.o") for unit in module.units]
        for unit, part in zip(module.units, parts, strict=True):
            speed = QUICK if unit == module.hot else SMALL
            subprocess.run([*command, *speed, "-c", str(CORE / unit), "-o", part], check=True)
        exports = [f"-Wl,--export={name}" for name in module.exports]
        subprocess.run([*command, *SMALL, *LINKING, *exports, *parts, "-o", str(made)], check=True)
        subprocess.run([*OPTIMISER, str(made), "-o", str(made)], check=True)
        return made.read_bytes()


if __name__ == "__main__":
    from zopfli import gzip  # 5 % smaller than zlib makes it; the page carries it as text

    for each in MODULES:
        each.target.write_bytes(gzip.compress(with_digest(each, compiled(each))))
