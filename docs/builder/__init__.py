"""What this site needs of Sphinx: blocks that run, generated reference pages, typeset formulas.

`blocks` has the directives `command`, `picture` and `file`, which run in a `session`; `pages` fills in the places
marked `<!-- insert: NAME -->`; `formulas` sets formulas; `translations` asks for
German.
"""

from typing import Any


def setup(app: Any) -> dict[str, Any]:
    """Called by Sphinx."""
    from builder import blocks, formulas, names, pages, translations

    blocks.setup(app)
    pages.setup(app)
    formulas.setup(app)
    names.setup(app)
    translations.setup(app)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
