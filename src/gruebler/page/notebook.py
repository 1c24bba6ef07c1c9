"""The door to the widget, which needs anywidget only when it is opened."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gruebler.base.errors import GrueblerError
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage

if TYPE_CHECKING:
    from gruebler.page.widget import Explorer


def explore(linkage: LinkageLike, *, height: int = 640, lang: str = "") -> Explorer:
    """A linkage in a notebook cell that moves, and whose joints and lengths can be dragged.

    Args:
        linkage: a planar linkage whose drives fix its motion, or the lengths of a four-bar or slider-crank.
        height: of the cell, in pixels.
        lang: ``en`` or ``de``; the browser's language if empty.

    Returns:
        `Explorer`: a widget whose ``linkage`` is the linkage as the reader left it.

    Raises:
        GrueblerError: anywidget is not installed.
        LinkageError: a linkage that cannot be moved or assembled.

    Cost:
        That of its drive cycle, 10 to 500 ms.

    Example:
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> widget = explore(FourBar(25, 70, 40, 70), height=500)  # doctest: +SKIP
        >>> widget.linkage.length("coupler", 1, 2)  # doctest: +SKIP
        70.0

    See Also:
        `draw`, `animate`, `move`

    Theory:
        docs/theory/explorer.md
    """
    linkage = as_linkage(linkage)
    try:
        from gruebler.page.widget import Explorer
    except ImportError:
        raise GrueblerError("this needs anywidget: pip install 'gruebler[notebook]'") from None
    return Explorer(linkage, lang=lang, height=height)
