"""All epicyclic gear trains with a given number of links and mobility; docs/theory/epicyclic-trains.md."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import GrueblerError
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism.labelling import canonical_form, relabelled

Axes = tuple[tuple[int, ...], ...]
_Masks = NDArray[np.uint64]
_Ints = NDArray[np.int64]
MOST_LINKS = 10
"""Links: 9 take seconds, 10 a minute; of 12 the sets of gear pairs would no longer fit into the digits of a double."""
_IMAGES = 10**7  # how many images of sets are held at once


@dataclass(frozen=True, slots=True)
class EpicyclicTrain:
    """A train by its structure: links from 0, the axes about which they turn, and the gear pairs."""

    links: int
    axes: Axes
    """The links of each axis. All links of an axis are coaxial; they form a tree."""
    gears: tuple[tuple[int, int, int], ...]
    """Two links that mesh, and the carrier: the link that both their axes have in common."""

    def chain(self) -> Chain:
        """The chain: a revolute joint, mostly multiple, for each axis and a gear joint for each pair.

        >>> print(EpicyclicTrain(4, ((0, 1, 3), (2, 3)), ((0, 2, 3), (1, 2, 3))).chain())
        R(0-1-3) R(2-3) G(0-2) G(1-2)
        """
        joints = [("R", axis) for axis in self.axes] + [("G", pair[:2]) for pair in self.gears]
        return Chain.parse(" ".join(f"{pair}({'-'.join(map(str, links))})" for pair, links in joints))


class EpicyclicCount(NamedTuple):
    """How many trains there are."""

    displacement: int
    """Displacement graphs: axes and gear pairs up to the names of links."""
    rotation: int
    """Rotation graphs: gear pairs with their carriers only, which is what the speeds depend on."""


def hypertrees(links: int) -> tuple[Axes, ...]:
    """All ways to connect links by axes without a loop, up to the names of links. Cost: 0.1 s for nine links.

    >>> [len(hypertrees(n)) for n in range(1, 8)]
    [1, 1, 2, 4, 9, 22, 59]
    """
    smaller: list[Axes] = [()]
    for new in range(1, links):
        seen: dict[object, Axes] = {}
        for axes in smaller:
            # One link lies on a single axis that at most one further axis hangs on: what is left without it is smaller.
            grown: list[Axes] = [(*axes[:k], (*axis, new), *axes[k + 1 :]) for k, axis in enumerate(axes)]
            grown += [(*axes, (link, new)) for link in range(new)]
            for tree in grown:
                seen.setdefault(_tree_form(new + 1, tree), tree)
        smaller = list(seen.values())
    return tuple(smaller)


def epicyclic_trains(links: int, mobility: int = 1) -> Iterator[EpicyclicTrain]:
    """Every train once, up to the names of links: its displacement graphs.

    Axes form a hypertree; each of the n - 1 - F gear pairs joins links of different axes with a common carrier; every
    part of r pairs has at least r + 2 links, so that nothing is locked; every link is in a pair or carries one.
    Fractionated trains belong to it.

    Raises `GrueblerError` for fewer than three and more than ten links. Cost: 0.1 s for seven links, 1 s for eight,
    15 s for nine.

    >>> [sum(1 for _ in epicyclic_trains(n)) for n in (3, 4, 5, 6)]
    [1, 3, 13, 81]
    """
    if not 3 <= links <= MOST_LINKS:
        raise GrueblerError(
            "{links} links: epicyclic trains are listed for 3 to {most} links", links=links, most=MOST_LINKS
        )
    if mobility < 1:
        raise GrueblerError("mobility {mobility}: a train has at least 1", mobility=mobility)
    pairs = links - 1 - mobility
    if pairs < 1:
        return
    for axes in hypertrees(links):
        triples = _triples(links, axes)
        for mask in _free_sets(links, triples, _symmetries(links, axes, triples), pairs):
            gears = tuple(triple for k, triple in enumerate(triples) if mask >> k & 1)
            if len({link for triple in gears for link in triple}) == links:
                yield EpicyclicTrain(links, axes, gears)


def count_epicyclic_trains(links: int, mobility: int = 1) -> EpicyclicCount:
    """How many displacement graphs and rotation graphs there are. Cost: as of `epicyclic_trains`, and 0.1 ms a train.

    >>> count_epicyclic_trains(6)
    EpicyclicCount(displacement=81, rotation=27)
    """
    count, forms = 0, set()
    for train in epicyclic_trains(links, mobility):
        count += 1
        forms.add(_rotation_form(train))
    return EpicyclicCount(count, len(forms))


def _rotation_form(train: EpicyclicTrain) -> object:
    """The canonical form of the gear pairs with their carriers, without the axes."""
    edges, kinds = [], []
    for number, (a, b, carrier) in enumerate(train.gears, start=train.links):
        edges += [(number, a), (number, b), (number, carrier)]
        kinds += [0, 0, 1]
    size = train.links + len(train.gears)
    colours = np.repeat([0, 1], [train.links, len(train.gears)])
    return _form(size, colours, np.array(edges), np.array(kinds))


def _form(size: int, colours: _Ints, edges: _Ints, kinds: _Ints) -> object:
    return relabelled(canonical_form(size, colours, edges, kinds).labelling, colours, edges, kinds)


def _tree_graph(links: int, axes: Axes) -> tuple[int, _Ints, _Ints]:
    """Links and axes as vertices of two colours."""
    edges = [(links + k, link) for k, axis in enumerate(axes) for link in axis]
    return links + len(axes), np.repeat([0, 1], [links, len(axes)]), np.array(edges)


def _tree_form(links: int, axes: Axes) -> object:
    size, colours, edges = _tree_graph(links, axes)
    return _form(size, colours, edges, np.zeros(len(edges), np.int64))


def _triples(links: int, axes: Axes) -> list[tuple[int, int, int]]:
    """All possible gear pairs with their carriers."""
    triples = []
    for carrier in range(links):
        own = [axis for axis in axes if carrier in axis]
        for first, second in combinations(own, 2):
            triples += [(*sorted((a, b)), carrier) for a, b in product(first, second) if carrier not in (a, b)]
    return triples  # type: ignore[return-value]


def _symmetries(links: int, axes: Axes, triples: list[tuple[int, int, int]]) -> _Ints:
    """(symmetries, triples) where each symmetry of the axes takes each triple."""
    size, colours, edges = _tree_graph(links, axes)
    generators = [tuple(row[:links].tolist()) for row in canonical_form(size, colours, edges).generators]
    group = {tuple(range(links))}
    fresh = list(group)
    while fresh:
        images = dict.fromkeys(tuple(g[v] for v in old) for old in fresh for g in generators)
        fresh = [image for image in images if image not in group]
        group.update(fresh)
    maps = np.array(sorted(group))
    moved = maps[:, np.array(triples, np.int64).reshape(-1, 3)]
    keys = np.minimum(moved[..., 0], moved[..., 1]) * links + np.maximum(moved[..., 0], moved[..., 1])
    keys = keys * links + moved[..., 2]
    own = keys[0]  # the identity comes first
    order = np.argsort(own)
    return np.unique(order[np.searchsorted(own[order], keys)], axis=0)


def _free_sets(links: int, triples: list[tuple[int, int, int]], symmetries: _Ints, pairs: int) -> list[int]:
    """The sets of so many triples without a locked part, one of each orbit of the symmetries, as bits."""
    if pairs > len(triples):
        return []
    parts = np.arange(2**links)
    limit = np.bitwise_count(parts).astype(np.int16) - 2
    inside = np.array([parts & sum(1 << v for v in triple) == sum(1 << v for v in triple) for triple in triples])
    matters = limit >= 1
    inside, limit = inside[:, matters].astype(np.int16), limit[matters]
    powers = np.exp2(symmetries.astype(np.float64)).T  # sums of different powers of two below 2^53 are exact
    masks: _Masks = np.zeros(1, np.uint64)
    for _ in range(pairs):
        chosen = (masks[:, None] >> np.arange(len(triples), dtype=np.uint64) & np.uint64(1)).astype(np.int16)
        full = chosen @ inside >= limit  # (sets, parts): parts that bear no further triple
        bears = (full.astype(np.float32) @ inside.T.astype(np.float32) == 0) & (chosen == 0)
        row, triple = np.nonzero(bears)
        grown = np.unique(masks[row] | np.uint64(1) << triple.astype(np.uint64))
        masks = _smallest_images(grown, powers)
    return [int(mask) for mask in masks]


def _smallest_images(masks: _Masks, powers: NDArray[np.float64]) -> _Masks:
    """The smallest image of each set under the symmetries, each once."""
    step = max(1, _IMAGES // powers.shape[1])
    images = []
    for k in range(0, len(masks), step):
        part = masks[k : k + step]
        bits = (part[:, None] >> np.arange(len(powers), dtype=np.uint64) & np.uint64(1)).astype(np.float64)
        images.append(np.unique((bits @ powers).min(axis=1).astype(np.uint64)))
    return np.unique(np.concatenate(images)) if images else masks
