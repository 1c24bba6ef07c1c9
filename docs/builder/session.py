"""What the blocks of a page run: one session with a folder and Python names. It needs the library only, no Sphinx.

The blocks of one page run in order, so that a page is one session.
"""

from __future__ import annotations

import ast
import contextlib
import io
import os
import re
import shlex
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import gruebler
from gruebler.cli import main

__all__ = ["Block", "Session", "blocks_of"]

_BLOCK = re.compile(
    r"^(?P<fence>:{3,}|`{3,})(?P<kind>\{(?:command|picture|file)\}|pycon)(?P<argument>[^\n]*)\n(?P<body>.*?)^(?P=fence)$",
    re.MULTILINE | re.DOTALL,
)
_OPTION = re.compile(r"^:([a-z-]+):(.*)$")


class Block(NamedTuple):
    """A block of a page that runs."""

    kind: str
    """`command`, `picture`, `file` or `pycon`."""
    argument: str
    options: dict[str, str]
    body: str


def blocks_of(page: str) -> Iterator[Block]:
    """The blocks of a page in Markdown that run, in their order."""
    for found in _BLOCK.finditer(page):
        rows, options = found["body"].splitlines(), {}
        if found["kind"] == "{command}":
            rows.insert(0, found["argument"].strip())
        first = [k for k, row in enumerate(rows) if _OPTION.match(row)]
        for k in first:
            name, value = _OPTION.match(rows[k]).groups()  # type: ignore[union-attr]
            options[name] = value.strip()
        body = "\n".join(row for k, row in enumerate(rows) if k not in first)
        yield Block(found["kind"].strip("{}"), found["argument"].strip(), options, body)


class Session:
    """A folder and the Python names of a page."""

    def __init__(self, folder: Path | None = None, lang: str = "en") -> None:
        self.folder = folder or Path(tempfile.mkdtemp(prefix="gruebler-docs-"))
        self.lang = lang
        self.names: dict[str, Any] = {"gr": gruebler, "lang": lang}

    def command(self, text: str) -> tuple[int, str]:
        """The exit status of a command that begins with `gruebler`, and what it printed."""
        words = shlex.split(" ".join(row.strip().removesuffix("\\").strip() for row in text.splitlines()))
        if words[0] != "gruebler":
            raise ValueError(f"expected a command that begins with gruebler: {text}")
        printed = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
        before = os.environ.get("GRUEBLER_LANG")
        os.environ["GRUEBLER_LANG"] = self.lang
        try:
            with (
                contextlib.chdir(self.folder),
                contextlib.redirect_stdout(printed),
                contextlib.redirect_stderr(printed),
            ):
                status = main(words[1:])
        except SystemExit as stop:
            status = int(stop.code or 0)
        finally:
            if before is None:
                del os.environ["GRUEBLER_LANG"]
            else:
                os.environ["GRUEBLER_LANG"] = before
        printed.flush()
        return status, printed.buffer.getvalue().decode()  # type: ignore[attr-defined]

    def file(self, name: str, text: str) -> None:
        """Write a file into the folder."""
        (self.folder / name).write_text(text + "\n", encoding="utf-8")

    def picture(self, code: str) -> Any:
        """Run the code; returns the value of its last line, an expression."""
        tree = ast.parse(code)
        last = tree.body.pop()
        if not isinstance(last, ast.Expr):
            raise ValueError(f"expected an expression in the last line: {code}")
        with contextlib.chdir(self.folder):
            exec(compile(tree, "<picture>", "exec"), self.names)
            return eval(compile(ast.Expression(last.value), "<picture>", "eval"), self.names)
