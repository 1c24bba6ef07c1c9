"""The door to the widget, which needs anywidget only when it is opened."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gruebler.base.errors import GrueblerError
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage

if TYPE_CHECKING:
    from gruebler.page.widget import Explorer


def explore(linkage: LinkageLike, *, lang: str = "", height: int = 640) -> Explorer:
    """A linkage in a notebook cell that moves, and whose joints and lengths can be dragged.

    Args:
        linkage: a planar linkage whose drives fix its motion, or the lengths of a four-bar or slider-crank.
        lang: ``en`` or ``de``; the browser's language if empty.
        height: of the cell, in pixels.

    The widget's ``linkage`` is the linkage as the reader left it. Raises `GrueblerError` without anywidget, and
    `LinkageError` for a linkage that cannot be moved or assembled. Cost: that of its drive cycle, 10 to 500 ms.
    """
    linkage = as_linkage(linkage)
    try:
        from gruebler.page.widget import Explorer
    except ImportError:
        raise GrueblerError("this needs anywidget: pip install 'gruebler[notebook]'") from None
    return Explorer(linkage, lang=lang, height=height)
