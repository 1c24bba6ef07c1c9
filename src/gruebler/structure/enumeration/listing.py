"""Chains that answer a request, listed and counted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor

from gruebler.base.doors import door
from gruebler.base.errors import GrueblerError, check_method
from gruebler.structure.chain import Chain
from gruebler.structure.enumeration.counting import ChainCount
from gruebler.structure.enumeration.request import Request


@door
def chains(
    links: int,
    mobility: int = 1,
    *,
    fractionated: str = "none",
    assortment: Sequence[int] | None = None,
    multiple_joints: int | str = 0,
) -> Iterator[Chain]:
    """Planar chains of revolute joints without any rigid part, each once, lazily and in a fixed order.

    Args:
        links: number of links, n >= 3.
        mobility: F >= 0; with F = 0 the chains are the Baranov trusses.
        fractionated: ``none``: chains that do not fall apart; ``link``, ``joint``: those that fall apart at a link
            only, at some joint; ``all``: the three classes in this order.
        assortment: only chains with these numbers of binary, ternary, ... links.
        multiple_joints: the number of joints of more than two links, a range such as ``0-2``, or ``any``.

    Returns:
        An iterator of `Chain`: planar, revolute, links named 0, 1, 2, ...

    Raises:
        RequestError: a request that no chain can meet by its form.
        GrueblerError: more loops than the kernels can process.

    Cost:
        About 50 us for a chain that is not fractionated and has simple joints, 1 ms for others.

    Example:
        >>> len(list(chains(8))), len(list(chains(9, 2, fractionated="all")))
        (16, 40)
        >>> len(list(chains(6, multiple_joints="any")))
        4

    See Also:
        `count_chains`, `variants`, `is_isomorphic`

    Theory:
        docs/theory/enumeration.md
    """
    from gruebler.structure.enumeration.work_units import chains_of_request

    numbers = None if assortment is None else tuple(assortment)
    return chains_of_request(
        Request(
            links, mobility=mobility, fractionated=fractionated, assortment=numbers, multiple_joints=multiple_joints
        )
    )


_METHODS = ("count", "list", "both")


@door
def count_chains(
    links: int,
    mobility: int = 1,
    *,
    fractionated: str = "none",
    assortment: Sequence[int] | None = None,
    multiple_joints: int | str = 0,
    orbits: bool = False,
    method: str = "count",
    executor: Executor | None = None,
) -> ChainCount:
    """The number of chains that `chains` gives, by assortment and by class, and of their mechanisms.

    Args:
        links: number of links, n >= 3.
        mobility: F >= 0.
        fractionated: as for `chains`.
        assortment: as for `chains`.
        multiple_joints: as for `chains`.
        orbits: whether to count inversions, driven mechanisms and joint orbits too.
        method: ``count``: chains that are not fractionated and have simple joints by Burnside's lemma, without building
            them; ``list``: every chain built, as `chains` does; ``both``, which must agree.
        executor: runs the pieces of the work; by default this process.

    Returns:
        `ChainCount`: ``chains``, numbers by assortment and class, with ``orbits`` those of mechanisms.

    Raises:
        RequestError: a request that no chain can meet by its form.
        GrueblerError: more loops than the kernels can process; methods that differ.

    Cost:
        12 links some 0.3 s, listed about 1 ms a chain.

    Example:
        >>> count_chains(9, 2, fractionated="all").to_json()["by_fractionation"]
        {'none': 35, 'link': 5, 'joint': 0}

    See Also:
        `chains`, `inversions`

    Theory:
        docs/theory/enumeration.md
    """
    from gruebler.structure.enumeration.run_request import run_count

    numbers = None if assortment is None else tuple(assortment)
    request = Request(
        links, mobility=mobility, fractionated=fractionated, assortment=numbers, multiple_joints=multiple_joints
    )
    check_method(method, _METHODS, GrueblerError)
    asked = [listed for listed in (False, True) if method in (_METHODS[listed], "both")]
    count, *others = [run_count(request, orbits=orbits, listed=listed, executor=executor) for listed in asked]
    if others and others != [count]:
        raise GrueblerError(
            "the methods differ: {count} chains counted, {listed} listed", count=count.chains, listed=others[0].chains
        )
    return count
