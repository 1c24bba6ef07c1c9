"""Estimates of the number of chains, the time and the bytes of a request, before it runs.

A known number of chains is used as it is; beyond, the known numbers are extrapolated by their growth, which itself
grows slowly, so that an estimate is good to a factor of two or three for the next size. The numbers were counted with
this library; those for F = 1 are also OEIS A233288, and the smaller ones have independent sources
(tests/structure/enumeration).
"""

from __future__ import annotations

from dataclasses import dataclass

from gruebler.structure.enumeration.assortment import joint_count, loop_count
from gruebler.structure.enumeration.pieces import refuse_too_large
from gruebler.structure.enumeration.request import Request

_Table = dict[int, tuple[int, ...]]

# Chains with 1, 2, 3, ... loops, that is with F + 3, F + 5, ... links, by F.
_NOT_FRACTIONATED: _Table = {
    0: (1, 1, 3, 28, 562, 20437, 1036775, 66298821),
    1: (1, 2, 16, 230, 6856, 318162, 19819281, 1535380884, 141954670341),
    2: (1, 3, 35, 753, 27496, 1432730, 96314652, 7915091825),
    3: (1, 5, 74, 1962, 83547, 4805764, 346295563),
    4: (1, 6, 126, 4356, 216291, 13743920, 1062241406),
}
_LINK: _Table = {2: (0, 1, 5, 86, 2189, 87123, 4781709), 3: (0, 1, 19, 374, 11458), 4: (0, 2, 39, 1078, 39149)}
_JOINT: _Table = {3: (0, 1, 5, 86, 2189), 4: (0, 2, 24, 481, 14185)}
_ANY_JOINTS: _Table = {0: (1, 1, 6, 149), 1: (1, 4, 60, 2645, 248203), 2: (1, 9, 219, 13450)}
"""All classes and any number of multiple joints."""

# Seconds for a chain on one core: counted, it takes 9 ns of 16 links, 3.6 of 18 and 2.4 of 20 (core/README.md).
_COUNTED = 3e-9
_WRITTEN = {"graph6": 4e-7, "text": 3e-5, "json": 6e-5}
_BUILT = {"simple": 1e-3, "multiple": 1e-4}


@dataclass(frozen=True, slots=True)
class Estimate:
    """The estimated cost of a request, to about a factor of three."""

    chains: int
    exact: bool
    """Whether the number of chains is known."""
    seconds: float
    """On one core, once the kernels are loaded."""
    bytes: int
    """Of the output; 0 for a count."""


def expected_chains(request: Request) -> tuple[int, bool]:
    """The number of chains, and whether it is known; an assortment or a number of multiple joints only bounds it.

    >>> expected_chains(Request(16)), expected_chains(Request(20))[0] > 10**11
    ((19819281, True), True)
    """
    loops = loop_count(request.links, request.mobility)
    if loops is None:
        return 0, True
    f = request.mobility
    if not request.only_simple:
        number, exact = _continued(_ANY_JOINTS, f, loops)
        return number, exact and request.joints_range == (0, None) and request.fractionated == "all"
    tables = {"none": _NOT_FRACTIONATED, "link": _LINK, "joint": _JOINT}
    class_estimates = [_continued(tables[kind], f, loops) for kind in request.classes]
    return sum(n for n, _ in class_estimates), all(exact for _, exact in class_estimates) and request.assortment is None


def _continued(table: _Table, mobility: int, loops: int) -> tuple[int, bool]:
    """An entry of the table, or its extrapolation; for a mobility without entries the nearest one is used."""
    row = table[min(max(mobility, min(table)), max(table))]
    known = mobility in table
    if loops <= len(row):
        return row[loops - 1], known
    numbers = list(row)
    while len(numbers) < loops:
        last = numbers[-1] / numbers[-2]
        before = numbers[-2] / numbers[-3] if numbers[-3] else last
        numbers.append(int(numbers[-1] * (last + max(last - before, 0.0))))
    return numbers[-1], False


def estimate(request: Request, form: str | None) -> Estimate:
    """Chains, time and bytes of a request.

    Args:
        request: the request.
        form: ``text``, ``graph6`` or ``json``; None for a count.

    >>> estimate(Request(18), "graph6").bytes // 10**9
    42
    """
    refuse_too_large(request.links, request.mobility)
    chains, exact = expected_chains(request)
    links, joints = request.links, joint_count(request.links, request.mobility) or 0
    width = 2 if links <= 10 else 3
    line = {
        None: 0,
        "graph6": 2 + (links * (links - 1) // 2 + 5) // 6,
        "text": joints * (3 + 2 * width - 1),
        "json": 60 + 6 * links + joints * 45,
    }[form]
    plain = request.only_simple and request.fractionated == "none"
    each = 0.0 if form is None else _WRITTEN[form]
    if not request.only_simple:
        each += _BUILT["multiple"]
    elif plain:
        each += _COUNTED
    if request.only_simple and not plain:
        composed = chains - (_continued(_NOT_FRACTIONATED, request.mobility, _loops(request))[0] if chains else 0)
        composed = composed if request.fractionated == "all" else chains
        return Estimate(chains, exact, chains * (each + _COUNTED) + composed * _BUILT["simple"], chains * line)
    return Estimate(chains, exact, chains * each, chains * line)


def _loops(request: Request) -> int:
    return loop_count(request.links, request.mobility) or 1
