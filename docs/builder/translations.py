"""A page that is German is German throughout: a text without translation is a warning, which stops `make docs`.

Pages of which only the title is translated say that they are English; those that are made in the reader's language are
left out.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.util import logging

_LOG = logging.getLogger(__name__)
_ALIKE = {"gruebler", "Notebooks", "pylinkage", "Pyslvs", "DXF", "Python", "10"}  # the same in both languages
_ALIKE |= {"Bennett", "Bricard", "Sarrus", "Schatz", "Pinocchio", "lead", "radii", "pressure"}
_ENGLISH_ONLY = {"de": "Diese Seite gibt es nur auf Englisch; die Begriffe stehen auf Deutsch im Glossar."}
_MADE = {"reference/commands", "reference/formats", "reference/front-door"}


def _is_complete(app: Any, page: str) -> bool:
    """Whether the catalog of a page has more than its title."""
    catalog = Path(app.srcdir) / "locale" / app.config.language / "LC_MESSAGES" / f"{page}.po"
    return catalog.exists() and catalog.read_text(encoding="utf-8").count("\nmsgid ") > 2


def _check(app: Any, tree: nodes.document) -> None:
    page = app.env.docname
    if app.config.language == "en" or page in _MADE:
        return
    if not _is_complete(app, page):
        title = next(iter(tree.findall(nodes.title)), None)
        if title is not None:
            notice = nodes.note("", nodes.paragraph(text=_ENGLISH_ONLY[app.config.language]), classes=["english-only"])
            title.parent.insert(title.parent.index(title) + 1, notice)
        return
    for node in tree.findall(lambda each: isinstance(each, nodes.Element) and each.get("translated") is False):
        words = "".join(
            part.astext() for part in node.findall(nodes.Text) if not isinstance(part.parent, nodes.literal)
        )
        # A cell of a table may be a symbol, such as Q_G or VDI 2127.
        word = r"[a-z]{3}" if isinstance(node.parent, nodes.entry) else r"[A-Za-z]{2}"
        if re.search(word, words) and node.astext() not in _ALIKE:
            _LOG.warning("%s: no translation of %r", page, node.astext(), location=node)


def setup(app: Any) -> None:
    """The event."""
    app.connect("doctree-read", _check)
