"""Requests for an enumeration, and the numbers that answer them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from numbers import Integral
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.immutable import settle
from gruebler.base.plain_data import plain
from gruebler.structure.enumeration.fractionation_class import CLASSES

_TOO_MANY = 1_000_000  # multiple joints: no chain that can be listed has as many


class RequestError(GrueblerError):
    """A request that no enumeration can answer."""


@dataclass(frozen=True, slots=True)
class Request:
    """The parameters of an enumeration of planar chains of revolute joints without any rigid part.

    Raises:
        RequestError: an invalid value.

    >>> Request(8, multiple_joints="0-2").joints_range
    (0, 2)
    """

    links: int
    _: KW_ONLY
    mobility: int = 1
    fractionated: str = "none"
    """``none``, ``link``, ``joint`` (see `condition.fractionation`) or ``all``."""
    assortment: tuple[int, ...] | None = None
    """Numbers of binary, ternary, ... links."""
    multiple_joints: int | str = 0
    """The number of joints of more than two links, a range such as ``0-2``, or ``any``."""

    def __post_init__(self) -> None:
        for name in ("links", "mobility"):
            value = getattr(self, name)
            if not isinstance(value, Integral) or isinstance(value, bool):
                raise RequestError("{name} is a whole number, not {found!r}", name=name, found=value)
            settle(self, **{name: int(value)})
        if self.links < 3:
            raise RequestError("a chain has at least three links, not {links}", links=self.links)
        if self.mobility < 0:
            raise RequestError(
                "chains without a rigid part have mobility 0 or more, not {mobility}", mobility=self.mobility
            )
        if self.fractionated not in (*CLASSES, "all"):
            raise RequestError(
                "fractionated is none, link, joint or all, not {fractionated!r}", fractionated=self.fractionated
            )
        if self.assortment is not None:
            settle(self, assortment=_assortment(self.assortment, self.links))
        fewest, most = self.joints_range
        if most is not None and fewest > most:
            raise RequestError(
                "the range of multiple joints {multiple_joints!r} ends before it begins",
                multiple_joints=self.multiple_joints,
            )

    @property
    def joints_range(self) -> tuple[int, int | None]:
        """The smallest and largest number of multiple joints; None: no limit."""
        number = self.multiple_joints
        if isinstance(number, Integral) and not isinstance(number, bool) and 0 <= number < _TOO_MANY:
            return int(number), int(number)
        if number == "any":
            return 0, None
        if isinstance(number, str) and (match := re.fullmatch(r"([0-9]{1,6})(?:-([0-9]{1,6}))?", number)):
            return int(match[1]), int(match[2] or match[1])
        raise RequestError("multiple joints are a number, a range such as 0-2 or 'any', not {wanted!r}", wanted=number)

    @property
    def only_simple(self) -> bool:
        """Whether every joint is to join two links."""
        return self.joints_range == (0, 0)

    @property
    def classes(self) -> tuple[str, ...]:
        """The requested classes, in their order; chains with F < 2 are never fractionated."""
        classes = CLASSES if self.fractionated == "all" else (self.fractionated,)
        return tuple(c for c in classes if self.mobility >= {"none": 0, "link": 2, "joint": 3}[c])

    def to_json(self) -> dict[str, Any]:
        """Plain data, equal for equivalent requests."""
        fewest, most = self.joints_range
        return {
            **plain(self, "links mobility fractionated assortment"),
            "multiple_joints": [fewest, most],
        }


def _assortment(numbers: Sequence[int], links: int) -> tuple[int, ...]:
    counts = list(numbers)
    if any(not isinstance(k, int) or isinstance(k, bool) or k < 0 for k in counts):
        raise RequestError(
            "an assortment gives the numbers of binary, ternary, ... links, not {numbers}", numbers=tuple(numbers)
        )
    if sum(counts) != links:
        raise RequestError(
            "the assortment {assortment} has {count} links in all, not {links}",
            assortment=",".join(map(str, counts)),
            count=sum(counts),
            links=links,
        )
    while counts[-1] == 0:
        counts.pop()
    return tuple(counts)
