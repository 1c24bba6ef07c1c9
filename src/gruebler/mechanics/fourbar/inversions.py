"""The mechanisms that one chain of given lengths makes with each link as frame and each drive there."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin

from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.mechanics.fourbar.four_bar import FourBar
from gruebler.mechanics.fourbar.inverted_slider_crank import InvertedSliderCrank
from gruebler.mechanics.fourbar.length_texts import ClosedForm
from gruebler.mechanics.fourbar.slider_crank import SliderCrank
from gruebler.mechanics.linkages.model import Linkage
from gruebler.structure.mechanism import Mechanism

_BLOCK_AS_FRAME = message("slider-crank with the block as frame")
_RING = "abcd"


@dataclass(frozen=True, slots=True)
class SizedInversion:
    """One mechanism of a chain of given lengths."""

    frame: str
    """The link that is held, by its letter."""
    drive: str
    """The link at the frame that is driven, by its letter."""
    type: Message
    linkage: Linkage


def sized_inversions(size: ClosedForm) -> tuple[SizedInversion, ...]:
    """Every frame with each of its two drives, in the order of the letters.

    The links of a four-bar are a, b, c, d around; those of a slider-crank chain the crank a, the coupler b, the block c
    and the guide d. Raises `LinkageError` for lengths that cannot be assembled. Source: section 2.4 of the teaching
    documents.

    >>> for made in sized_inversions(FourBar(2, 5, 4, 5))[::2]:
    ...     print(made.frame, made.drive, made.type)
    a b double crank
    b a crank-rocker
    c b Grashof double rocker (the coupler turns fully)
    d a crank-rocker
    """
    if isinstance(size, FourBar):
        sized = [_four_bar(size, frame, drive) for frame in _RING for drive in _neighbours(frame)]
    else:
        sized = [_slider_crank(size, frame, drive) for frame in _RING for drive in _neighbours(frame)]
    return tuple(sized)


def _neighbours(letter: str) -> list[str]:
    k = _RING.index(letter)
    return sorted((_RING[k - 1], _RING[(k + 1) % 4]))


def _four_bar(size: FourBar, frame: str, drive: str) -> SizedInversion:
    lengths = {"a": size.a, "b": size.b, "c": size.c, "d": size.d}
    opposite = _RING[(_RING.index(frame) + 2) % 4]
    (other,) = {*_neighbours(frame)} - {drive}
    turned = FourBar(lengths[drive], lengths[opposite], lengths[other], lengths[frame])
    if not turned.limits:
        raise LinkageError("the lengths a = {a:g}, b = {b:g}, c = {c:g}, d = {d:g} cannot be assembled", **lengths)
    names = {"crank": drive, "coupler": opposite, "rocker": other, "frame": frame}
    return SizedInversion(frame, drive, turned.type.title, turned.linkage().renamed(names))


def _slider_crank(size: SliderCrank | InvertedSliderCrank, frame: str, drive: str) -> SizedInversion:
    a, b = size.a, size.b if isinstance(size, SliderCrank) else size.d
    crank = SliderCrank(a, b, size.e)
    if not crank.limits:
        raise LinkageError("the lengths a = {a:g}, b = {b:g}, e = {e:g} cannot be assembled", a=a, b=b, e=size.e)
    type_ = {
        "a": InvertedSliderCrank(b, a, size.e).type.title,
        "b": InvertedSliderCrank(a, b, size.e).type.title,
        "c": _BLOCK_AS_FRAME,
        "d": crank.type.title,
    }[frame]
    names = {"crank": "a", "coupler": "b", "slider": "c", "frame": "d"}
    whole = crank.linkage().renamed(names)
    return SizedInversion(frame, drive, type_, whole.with_frame(frame, drive))


def double_slide_inversions(a: float) -> tuple[SizedInversion, ...]:
    """The three mechanisms of the chain with two slides at right angles and the distance a of its pins.

    >>> [(made.frame, str(made.type)) for made in double_slide_inversions(40)]
    [('a', 'Oldham coupling (double slotted lever)'), ('b', 'Scotch yoke'), ('d', 'elliptic trammel (double slider)')]
    """
    if not a > 0:
        raise LinkageError("a must be positive, not {a!r}", a=a)
    x, y = a * cos(pi / 3), a * sin(pi / 3)
    chain = Mechanism.parse("R(a-b) R(a-c) P(c-d) P(b-d); frame=d; drive=P(b-d)")
    places: dict[str | int, object] = {"R(a-b)": (x, 0.0), "R(a-c)": (0.0, y), "P(c-d)": (0.0, y, pi / 2)}
    places["P(b-d)"] = (x, 0.0, 0.0)
    whole = Linkage.from_drawing(chain, places)
    rows = (
        ("a", "b", message("Oldham coupling (double slotted lever)")),
        ("b", "a", message("Scotch yoke")),
        ("d", "b", message("elliptic trammel (double slider)")),
    )
    return tuple(SizedInversion(frame, drive, type_, whole.with_frame(frame, drive)) for frame, drive, type_ in rows)
