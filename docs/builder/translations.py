"""A page that is German is German throughout: a text without translation is a warning, which stops `make docs`.

Pages of which only the title is translated, and those that are made in the reader's language, are left out.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.util import logging

_LOG = logging.getLogger(__name__)
_ALIKE = {"gruebler", "Notebooks", "pylinkage", "Pyslvs", "DXF", "Python", "10"}  # the same in both languages
_MADE = {"reference/commands", "reference/formats", "reference/front-door"}


def _is_complete(app: Any, page: str) -> bool:
    """Whether the catalog of a page has more than its title."""
    catalog = Path(app.srcdir) / "locale" / app.config.language / "LC_MESSAGES" / f"{page}.po"
    return catalog.exists() and catalog.read_text(encoding="utf-8").count("\nmsgid ") > 2


def _check(app: Any, tree: nodes.document) -> None:
    page = app.env.docname
    if app.config.language == "en" or page in _MADE or not _is_complete(app, page):
        return
    for node in tree.findall(lambda each: isinstance(each, nodes.Element) and each.get("translated") is False):
        words = "".join(
            part.astext() for part in node.findall(nodes.Text) if not isinstance(part.parent, nodes.literal)
        )
        if re.search(r"[A-Za-z]{2}", words) and node.astext() not in _ALIKE:
            _LOG.warning("%s: no translation of %r", page, node.astext(), location=node)


def setup(app: Any) -> None:
    """The event."""
    app.connect("doctree-read", _check)
