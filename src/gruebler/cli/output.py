"""What the commands write: JSON and pictures on standard output, files; in characters that the output can carry."""

from __future__ import annotations

import argparse
import codecs
import json
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from gruebler.base.atomic_files import write_whole
from gruebler.base.columns import Column, Table, as_csv
from gruebler.base.errors import visible
from gruebler.base.text import translate

Item = TypeVar("Item")


def print_json(document: Any, indent: int | None = 2) -> None:
    """Print plain data as JSON, valid on any output: null for what is not finite, escapes where it is not UTF-8.

    >>> print_json({"ratio": float("inf"), "name": "Kürbel"}, indent=None)
    {"ratio": null, "name": "Kürbel"}
    """
    ascii_only = not _is_utf8()
    try:
        text = json.dumps(document, ensure_ascii=ascii_only, indent=indent, allow_nan=False)
    except ValueError:
        text = json.dumps(_finite(document), ensure_ascii=ascii_only, indent=indent, allow_nan=False)
    print(text)


def print_items(
    arguments: argparse.Namespace,
    items: Sequence[Item],
    as_data: Callable[[Item], Mapping[str, object]],
    show: Callable[[], object],
    about: Mapping[str, object] | None = None,
) -> None:
    """Print a list as its command was asked to: with --json as plain data, with --count its length, else by ``show``.

    Args:
        arguments: of the command, with ``json`` and ``count``.
        items: what is listed.
        as_data: an item as it stands in JSON.
        show: prints the list for a reader.
        about: what the JSON says before the list.
    """
    if arguments.json:
        listed = {} if arguments.count else {"items": [as_data(item) for item in items]}
        print_json({**(about or {}), "count": len(items), **listed})
    elif arguments.count:
        print(len(items))
    else:
        show()


def print_count(arguments: argparse.Namespace, count: int) -> None:
    """Print a number, with --json as ``{"count": number}``."""
    print(json.dumps({"count": count}) if arguments.json else count)


def _finite(document: Any) -> Any:
    if isinstance(document, dict):
        return {key: _finite(value) for key, value in document.items()}
    if isinstance(document, list | tuple):
        return [_finite(value) for value in document]
    return None if isinstance(document, float) and not math.isfinite(document) else document


def print_svg(text: str) -> None:
    """Print an SVG; where the output is not UTF-8, letters beyond ASCII as character references."""
    sys.stdout.write(text if _is_utf8() else text.encode("ascii", "xmlcharrefreplace").decode("ascii"))


def _is_utf8() -> bool:
    return codecs.lookup(getattr(sys.stdout, "encoding", None) or "utf-8").name == "utf-8"


def write_file(path: Path, content: bytes, lang: str) -> None:
    """Write a file, complete or not at all, and say so on standard error; `RunError` if it cannot be written."""
    write_whole(path, content)
    say_written(path, lang)


def write_table(path: Path, columns: Sequence[Column], lang: str, *, decimal_comma: bool = False) -> None:
    """Write a table by the ending of a name, .csv or .parquet; ``decimal_comma`` as `as_csv`."""
    if path.suffix.lower() == ".parquet":
        content = Table(tuple(columns)).parquet()
    else:
        content = as_csv(columns, decimal_comma=decimal_comma).encode("utf-8-sig" if decimal_comma else "utf-8")
    write_file(path, content, lang)


def say_written(path: Path, lang: str, more: str = "") -> None:
    """Say on standard error that a file was written."""
    print(visible(translate("Written: {path}{more}", lang, path=path, more=more)), file=sys.stderr)
