"""Compiles what the page needs of the kernels into `motion.wasm.gz` beside this file, by the clang of `ziglang`.

    python core/page/build.py      # needs `ziglang`, `zopfli` and npx; some minutes the first time, then half a minute

The module tells which sources it was made of, so that a test can say whether it belongs to those that are here.
"""

from __future__ import annotations

import hashlib
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
CORE = HERE.parent
TARGET = HERE / "motion.wasm.gz"
SECTION = b"gruebler sources"
"""A custom section of the module: engines pass over it."""

UNITS = (
    "page/door.cpp",
    *(
        f"src/motion/{name}.cpp"
        for name in ("closure", "closure_rates", "dyads", "newton", "placing", "plan", "sweep", "swept", "walk")
    ),
)
EXPORTS = ("reserve", "run", "unwound")
HOT = "src/motion/sweep.cpp"
"""Rows of dyads abreast, nearly all of the time of a motion; the other units are compiled for their size."""
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
    "-mllvm",
    "-unroll-runtime=false",
    "-Werror=pass-failed",  # a hot loop that is not vectorised
)
SMALL = ("-Os",)
LINKING = (
    "-mexec-model=reactor",
    "-Wl,--strip-all",
    "-Wl,--gc-sections",
    *(f"-Wl,--export={name}" for name in EXPORTS),
)


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


def sources() -> list[Path]:
    """The units and all that they include of the core, and this file, which holds the options."""
    found: dict[Path, None] = {}
    waiting = [CORE / unit for unit in UNITS]
    while waiting:
        file = waiting.pop()
        if file in found:
            continue
        found[file] = None
        waiting += [CORE / "src" / name for name in re.findall(r'#include "(.+)"', file.read_text(encoding="utf-8"))]
    return [*sorted(found), Path(__file__)]


def digest() -> bytes:
    """Of the names and the texts of all sources."""
    made = hashlib.sha256()
    for file in sources():
        made.update(file.relative_to(CORE).as_posix().encode() + b"\0" + file.read_bytes() + b"\0")
    return made.hexdigest().encode()


def with_digest(module: bytes) -> bytes:
    """A module with one more section; lengths below 128 are one byte."""
    content = bytes([len(SECTION)]) + SECTION + digest()
    return module + bytes([0, len(content)]) + content


def compiled() -> bytes:
    """The module of the linker, made smaller."""
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "motion.wasm"
        command = [sys.executable, "-m", "ziglang", "c++", *OPTIONS, f"-I{CORE / 'src'}"]
        parts = [str(Path(folder) / f"{Path(unit).stem}.o") for unit in UNITS]
        for unit, part in zip(UNITS, parts, strict=True):
            speed = QUICK if unit == HOT else SMALL
            subprocess.run([*command, *speed, "-c", str(CORE / unit), "-o", part], check=True)
        subprocess.run([*command, *SMALL, *LINKING, *parts, "-o", str(made)], check=True)
        subprocess.run([*OPTIMISER, str(made), "-o", str(made)], check=True)
        return made.read_bytes()


if __name__ == "__main__":
    from zopfli import gzip  # 5 % smaller than zlib makes it; the page carries it as text

    TARGET.write_bytes(gzip.compress(with_digest(compiled())))
