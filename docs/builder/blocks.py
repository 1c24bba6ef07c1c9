"""Blocks of a page that run while it is built: commands with what they print, pictures, files."""

from __future__ import annotations

import hashlib
import re
import textwrap
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.addnodes import download_reference
from sphinx.util.docutils import SphinxDirective

from builder.session import Session

_SESSIONS: dict[str, Session] = {}
_WIDTH = 88  # characters of a line that fit beside the navigation
_LANGUAGE = re.compile(r", lang=lang\b")


class _Running(SphinxDirective):
    has_content = True

    @property
    def session(self) -> Session:
        """The session of this page."""
        page = self.env.docname
        if page not in _SESSIONS:
            _SESSIONS[page] = Session(lang=self.config.language)
        return _SESSIONS[page]


class Command(_Running):
    """A command line and what it prints; the page is not built if its exit status is another than the given one."""

    option_spec = {  # noqa: RUF012  the interface of docutils
        "lines": directives.nonnegative_int,
        "status": directives.nonnegative_int,
        "quiet": directives.flag,
    }

    def run(self) -> list[nodes.Node]:
        """The command in one block, its output in the next."""
        shown = "\n".join(["$ " + self.content[0], *self.content[1:]])
        status, printed = self.session.command("\n".join(self.content))
        if status != self.options.get("status", 0):
            raise self.error(f"`{shown}` ended with exit status {status}:\n{printed}")
        whole = nodes.container(classes=["command-and-output"])
        whole += nodes.literal_block(shown, shown, language="console", classes=["command-line"])
        rows = [row for long in printed.rstrip().splitlines() for row in _wrapped(long)]
        most = self.options.get("lines", len(rows))
        if rows and "quiet" not in self.options:
            text = "\n".join([*rows[:most], *(["..."] if len(rows) > most else [])])
            whole += nodes.literal_block(text, text, language="text", classes=["output-of-command"])
        return [whole]


def _wrapped(row: str) -> list[str]:
    """A long row of running text in several lines; rows of tables, which have wider gaps, stay whole."""
    indent = len(row) - len(row.lstrip())
    if len(row) <= _WIDTH or "  " in row.strip() or set(row) == {"-"}:
        return [row[:_WIDTH]] if set(row) == {"-"} else [row]
    return textwrap.wrap(row, _WIDTH, subsequent_indent=" " * (indent + 2), break_on_hyphens=False)


class File(_Running):
    """A small file that the commands after it read; its name is the argument."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """The file as a block with its name as title."""
        name, text = self.arguments[0], "\n".join(self.content)
        self.session.file(name, text)
        kind = {".toml": "toml", ".json": "json"}.get(Path(name).suffix, "text")
        block = nodes.literal_block(text, text, language=kind)
        whole = nodes.container(classes=["literal-block-wrapper"], literal_block=True)
        whole += nodes.caption("", name)
        whole += block
        return [whole]


class PictureBlock(_Running):
    """A picture made by Python code, whose last line is the picture; the argument is its caption."""

    required_arguments = 1
    final_argument_whitespace = True
    option_spec = {"hide-code": directives.flag}  # noqa: RUF012

    def run(self) -> list[nodes.Node]:
        """A figure, with the code to unfold."""
        code = "\n".join(self.content)
        try:
            picture = self.session.picture(code)
        except Exception as problem:
            raise self.error(f"this code does not run: {problem!r}\n{code}") from problem
        target = Path(self.env.srcdir) / "_pictures"
        target.mkdir(exist_ok=True)
        svg = picture.svg()
        name = hashlib.sha256(svg.encode()).hexdigest()[:16] + ".svg"
        (target / name).write_text(svg, encoding="utf-8")
        figure = nodes.figure(classes=["picture"])
        image = nodes.image(uri=f"/_pictures/{name}", alt=_plain(self.arguments[0]))
        image["uri"], _ = self.env.relfn2path(image["uri"])
        image["uri"] = "/" + image["uri"]
        figure += image
        words, problems = self.state.inline_text(self.arguments[0], self.lineno)
        caption = nodes.caption(self.arguments[0], "", *words)
        caption.source, caption.line = self.env.doc2path(self.env.docname), self.lineno
        figure += caption
        whole = nodes.container(classes=["shown-picture"])
        whole += [figure, *problems]
        if "hide-code" not in self.options:
            shown = _LANGUAGE.sub("", code)
            whole += nodes.raw("", '<details class="code-of-picture"><summary>Python</summary>', format="html")
            whole += nodes.literal_block(shown, shown, language="python")
            whole += nodes.raw("", "</details>", format="html")
            saved = download_reference("", "SVG", refdoc=self.env.docname, reftarget=image["uri"])
            whole += nodes.paragraph("", "", saved, classes=["picture-file"])
        return [whole]


def _plain(text: str) -> str:
    return re.sub(r"[`*]|\]\([^)]*\)|\[", "", text)


def _forget(_app: Any, _env: Any, page: str) -> None:
    _SESSIONS.pop(page, None)


def setup(app: Any) -> None:
    """The directives."""
    app.add_directive("command", Command)
    app.add_directive("file", File)
    app.add_directive("picture", PictureBlock)
    app.connect("env-purge-doc", _forget)
