"""The door to the widget, which needs anywidget only when it is opened."""

from __future__ import annotations

from typing import TYPE_CHECKING, overload

from gruebler.base.errors import GrueblerError
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage, linkage_made
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.mechanics.screws.conversion import SpatialLike

if TYPE_CHECKING:
    from gruebler.page.space_page import SpacePage
    from gruebler.page.widget import Explorer


@overload
def explore(linkage: SpatialLike, *, height: int = 640, lang: str = "") -> SpacePage: ...


@overload
def explore(linkage: LinkageLike, *, height: int = 640, lang: str = "") -> Explorer: ...


def explore(linkage: LinkageLike | SpatialLike, *, height: int = 640, lang: str = "") -> Explorer | SpacePage:
    """A linkage in a notebook cell that moves, and whose joints and lengths can be dragged.

    Args:
        linkage: a linkage whose drives fix its motion, in the plane or in space, or lengths that make one.
        height: of the cell, in pixels.
        lang: ``en`` or ``de``; the browser's language if empty.

    Returns:
        `Explorer`: a widget whose ``linkage`` is the linkage as the reader left it. In space `SpacePage`: the bodies,
        seen from all sides, moved by sliders and by hand; its ``save`` writes the page.

    Raises:
        GrueblerError: anywidget is not installed, which space does not need.
        LinkageError: a linkage that cannot be moved or assembled.

    Cost:
        That of its drive cycle, 10 to 500 ms; in space a second.

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
    placed = linkage_made(linkage)
    if isinstance(placed, SpatialLinkage):
        from gruebler.page.space_page import SpacePage, space_file, space_model

        return SpacePage(space_file(space_model(placed), lang or "en"), height)
    planar = as_linkage(placed)
    try:
        from gruebler.page.widget import Explorer
    except ImportError:
        raise GrueblerError("this needs anywidget: pip install 'gruebler[notebook]'") from None
    return Explorer(planar, lang=lang, height=height)
