"""What stands for a linkage wherever one is asked for: the linkage, or lengths such as those of a four-bar."""

from __future__ import annotations

from collections.abc import Callable
from inspect import signature
from typing import Any, Protocol, TypeGuard, runtime_checkable

from gruebler.base.errors import LinkageError, to_be_read
from gruebler.base.text import message
from gruebler.mechanics.linkages.model import Linkage


@runtime_checkable
class HasLinkage(Protocol):
    """Lengths that make a linkage: `FourBar`, `SliderCrank`, `InvertedSliderCrank`."""

    def linkage(self) -> Linkage:
        """The linkage of these lengths."""
        ...


LinkageLike = Linkage | HasLinkage


def makes_linkage(value: object) -> TypeGuard[HasLinkage]:
    """Whether a value is lengths that make a linkage; a motion has one, which is another thing."""
    return isinstance(value, HasLinkage) and not isinstance(value, type) and callable(value.linkage)


def linkage_made(value: Any, *, unit: str | None = None) -> Any:
    """The linkage that lengths make, in the plane or in space; any other value as it is.

    Lengths are numbers without a unit: their linkage is in ``unit`` if one is given, else in mm, as files need one.
    """
    if not makes_linkage(value):
        return value
    make: Callable[..., Any] = value.linkage
    return make() if unit is None or "unit" not in signature(make).parameters else make(unit=unit)


def as_linkage(value: object, *, unit: str | None = None) -> Linkage:
    """The linkage that a value is or makes; `LinkageError` says what else it is, and where that is answered.

    ``unit`` is for lengths, as for `linkage_made`.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> as_linkage(FourBar(25, 70, 40, 70)).mechanism.frame
    'frame'
    """
    value = linkage_made(value, unit=unit)
    if isinstance(value, Linkage):
        return value
    kind = type(value).__name__
    if kind == "SpatialLinkage":
        raise LinkageError(
            "expected a planar linkage, but found a SpatialLinkage: gr.move moves it, gr.freedoms judges it"
        )
    if kind in ("Chain", "Mechanism"):
        raise LinkageError("a {kind} has no dimensions: realise(mechanism) finds some", kind=kind)
    said = message(
        "expected a linkage, a FourBar, SliderCrank or InvertedSliderCrank, but found {found}", found=_in_short(value)
    )
    if isinstance(value, str):
        raise LinkageError(message("{said}; {call} reads what it stands for", said=said, call=to_be_read(value)))
    raise LinkageError(said)


def _in_short(value: object) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) < 80 else f"{text[:77]}..."
