"""One front for everything that is enumerated: what is asked, and the chains or their numbers as the answer."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from typing import Any

from gruebler.chain import Chain
from gruebler.enumeration.condition import CLASSES
from gruebler.enumeration.counting import ChainCount
from gruebler.errors import GrueblerError

__all__ = ["Request", "RequestCount", "RequestError", "chains", "count"]


class RequestError(GrueblerError):
    """A request that no enumeration can answer."""


@dataclass(frozen=True, slots=True)
class Request:
    """What is to be enumerated: planar chains of revolute joints without any rigid part.

    Raises:
        RequestError: a value that makes no sense, said in one sentence.

    >>> Request(8, multiple_joints="0-2").joints_range
    (0, 2)
    """

    links: int
    mobility: int = 1
    fractionated: str = "none"
    """``none``, ``link``, ``joint`` (see `condition.fractionation`) or ``all``."""
    assortment: tuple[int, ...] | None = None
    """Numbers of binary, ternary, ... links."""
    multiple_joints: int | str = 0
    """How many joints of more than two links: exactly so many, a range such as ``0-2``, or ``any``."""

    def __post_init__(self) -> None:
        for name in ("links", "mobility"):
            if not isinstance(getattr(self, name), int) or isinstance(getattr(self, name), bool):
                raise RequestError(f"{name} is a whole number, not {getattr(self, name)!r}")
        if self.links < 3:
            raise RequestError(f"a chain has at least three links, not {self.links}")
        if self.mobility < 0:
            raise RequestError(f"chains without a rigid part have mobility 0 or more, not {self.mobility}")
        if self.fractionated not in (*CLASSES, "all"):
            raise RequestError(f"fractionated is none, link, joint or all, not {self.fractionated!r}")
        if self.assortment is not None:
            object.__setattr__(self, "assortment", _assortment(self.assortment, self.links))
        fewest, most = self.joints_range
        if most is not None and fewest > most:
            raise RequestError(f"the range of multiple joints {self.multiple_joints!r} ends before it begins")

    @property
    def joints_range(self) -> tuple[int, int | None]:
        """The smallest and largest number of multiple joints; None: no limit."""
        wanted = self.multiple_joints
        if isinstance(wanted, int) and not isinstance(wanted, bool) and wanted >= 0:
            return wanted, wanted
        if wanted == "any":
            return 0, None
        if isinstance(wanted, str) and (match := re.fullmatch(r"(\d+)(?:-(\d+))?", wanted)):
            return int(match[1]), int(match[2] or match[1])
        raise RequestError(f"multiple joints are a number, a range such as 0-2 or 'any', not {wanted!r}")

    @property
    def only_simple(self) -> bool:
        """Whether every joint is to join two links."""
        return self.joints_range == (0, 0)

    @property
    def classes(self) -> tuple[str, ...]:
        """The classes asked for, in their order; chains with F < 2 are never fractionated."""
        asked = CLASSES if self.fractionated == "all" else (self.fractionated,)
        return tuple(c for c in asked if self.mobility >= {"none": 0, "link": 2, "joint": 3}[c])

    def to_json(self) -> dict[str, Any]:
        """Plain data, equal for requests that ask the same."""
        fewest, most = self.joints_range
        return {
            "links": self.links,
            "mobility": self.mobility,
            "fractionated": self.fractionated,
            "assortment": None if self.assortment is None else list(self.assortment),
            "multiple_joints": [fewest, most],
        }


def _assortment(numbers: Sequence[int], links: int) -> tuple[int, ...]:
    kept = list(numbers)
    if any(not isinstance(k, int) or isinstance(k, bool) or k < 0 for k in kept):
        raise RequestError(f"an assortment gives the numbers of binary, ternary, ... links, not {tuple(numbers)}")
    if sum(kept) != links:
        raise RequestError(f"the assortment {','.join(map(str, kept))} has {sum(kept)} links in all, not {links}")
    while kept[-1] == 0:
        kept.pop()
    return tuple(kept)


@dataclass(frozen=True)
class RequestCount(ChainCount):
    """What there is of the chains asked for. A drive of a multiple joint is the joint and the link it drives."""

    by_fractionation: dict[str, int] = field(default_factory=dict)
    """Chains of each class asked for: ``none``, ``link``, ``joint``."""

    def to_json(self) -> dict[str, Any]:
        """Plain data; by_fractionation only if more than one class was asked for."""
        document = ChainCount.to_json(self)
        if len(self.by_fractionation) > 1:
            document["by_fractionation"] = dict(self.by_fractionation)
        return document


def chains(
    links: int,
    mobility: int = 1,
    *,
    fractionated: str = "none",
    assortment: Sequence[int] | None = None,
    multiple_joints: int | str = 0,
) -> Iterator[Chain]:
    """Planar chains of revolute joints without any rigid part, each once, lazily and always in the same order.

    Args:
        links: number of links, n >= 3.
        mobility: F >= 0; with F = 0 the chains are the Baranov trusses.
        fractionated: ``none``: chains that do not fall apart; ``link``, ``joint``: those that fall apart at a link
            only, at some joint; ``all``: the three classes in this order.
        assortment: only chains with these numbers of binary, ternary, ... links.
        multiple_joints: exactly so many joints of more than two links, a range such as ``0-2``, or ``any``.

    Raises `RequestError` for a request that makes no sense, and `GrueblerError` for more loops than can be worked on.
    Cost: about 50 us for a chain that is not fractionated and has simple joints, 1 ms for others.

    >>> len(list(chains(8))), len(list(chains(9, 2, fractionated="all"))), len(list(chains(6, multiple_joints="any")))
    (16, 40, 4)
    """
    from gruebler.enumeration.work import chains_of_request

    wanted = None if assortment is None else tuple(assortment)
    return chains_of_request(Request(links, mobility, fractionated, wanted, multiple_joints))


def count(
    links: int,
    mobility: int = 1,
    *,
    fractionated: str = "none",
    assortment: Sequence[int] | None = None,
    multiple_joints: int | str = 0,
    orbits: bool = False,
    executor: Executor | None = None,
) -> RequestCount:
    """How many chains `chains` gives, by assortment and by class, and how many mechanisms they give.

    Args:
        links: number of links, n >= 3.
        mobility: F >= 0.
        fractionated: as for `chains`.
        assortment: as for `chains`.
        multiple_joints: as for `chains`.
        orbits: whether to count inversions, driven mechanisms and joint orbits too.
        executor: where to do the pieces of the work; here if there is none.

    Chains that are not fractionated and have simple joints are counted without being built.

    >>> count(9, 2, fractionated="all").to_json()["by_fractionation"]
    {'none': 35, 'link': 5, 'joint': 0}
    """
    from gruebler.enumeration.runs import perform
    from gruebler.enumeration.work import Counter, add_tallies, work_of

    wanted = None if assortment is None else tuple(assortment)
    request = Request(links, mobility, fractionated, wanted, multiple_joints)
    return add_tallies(request, orbits, perform(Counter(request, orbits), work_of(request), executor))
