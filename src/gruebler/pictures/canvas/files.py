"""Pictures as bytes of a file, by the suffix of its name."""

from __future__ import annotations

import io
from pathlib import Path

from gruebler.base.errors import GrueblerError
from gruebler.base.text import joined_by_or
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.tikz import tikz_file

SUFFIXES = ("svg", "png", "pdf", "tex")


def suffix_of(path: Path, known: tuple[str, ...] = SUFFIXES) -> str:
    """The file format of a name; `GrueblerError` if it is not a known one."""
    suffix = path.suffix.lower().removeprefix(".")
    if suffix in ("gltf", "glb"):
        raise GrueblerError("{path!r}: a model is no picture; gruebler convert writes it, as .glb", path=str(path))
    if suffix not in known:
        raise GrueblerError(
            "{path!r} names no kind of picture: end it with {endings}",
            path=str(path),
            endings=joined_by_or([f".{ending}" for ending in known]),
        )
    return suffix


def picture_bytes(figure: Figure, suffix: str, *, dark: bool = False) -> bytes:
    """The content of a file (``tex`` is TikZ); `GrueblerError` if matplotlib is needed and missing.

    PNG and PDF are on light or dark ground; SVG is on that of the reader.
    """
    if suffix == "svg":
        return figure.svg().encode("utf-8")
    if suffix == "tex":
        return tikz_file(figure).encode("utf-8")
    from gruebler.pictures.canvas.matplotlib_files import save_figure

    memory = io.BytesIO()
    save_figure(figure, memory, suffix, dark=dark)
    return memory.getvalue()
