"""What this site needs of Sphinx: blocks that run, generated reference pages, typeset formulas.

`blocks` has the directives `command`, `picture` and `file`; `pages` fills in the places marked `<!-- insert: NAME -->`;
`formulas` sets the formulas of the theory pages.
"""

from typing import Any

from builder import blocks, formulas, pages


def setup(app: Any) -> dict[str, Any]:
    """Called by Sphinx."""
    blocks.setup(app)
    pages.setup(app)
    formulas.setup(app)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
