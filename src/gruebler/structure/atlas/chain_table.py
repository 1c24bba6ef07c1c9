"""The rows of the table of chains, from arrays of edges: no object is made for a chain with simple joints."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.errors import GrueblerError
from gruebler.structure.atlas.crossings import Bundle, least_crossings
from gruebler.structure.atlas.schema import arrow_library, arrow_schema
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import PAIRS, Alphabet
from gruebler.structure.enumeration.contracted import ContractedGraph, contracted_graphs

if TYPE_CHECKING:
    import pyarrow as pa

Int32 = NDArray[np.int32]
Int64 = NDArray[np.int64]

_PLACE = {pair.name: k for k, pair in enumerate(PAIRS)}
_TURNS = np.array([pair.is_turning for pair in PAIRS])
_SLIDES = np.array([pair.is_sliding for pair in PAIRS])
_MOST_LINKS = 40
_MOST_MEMBERS = 9
# The columns of numbers that the kernel gives.
_NUMBERS = (
    "group_order",
    "inversions",
    "joint_orbits",
    "drives",
    "smallest_circuit",
    "largest_circuit",
    "diameter",
    "dyadic",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ChainArrays:
    """Chains of one number of links as graphs, see docs/theory/atlas.md.

    Links are the vertices 0 to n - 1, multiple joints the vertices from n on; a joint of two links is an edge, a
    multiple joint has an edge to each of its links.
    """

    links: int
    mobility: int
    hubs: Int64
    """int64[k]: multiple joints, the vertices from n on."""
    sizes: Int64
    """int64[k]: edges."""
    edges: Int32
    """int32[k, e, 2]: a link and, behind it, a link or a multiple joint."""
    pairs: Int32
    """int32[k, e]: place of the pair in `chain.pairs.PAIRS`."""

    @classmethod
    def of_edges(cls, links: int, mobility: int, edges: NDArray[np.uint8]) -> ChainArrays:
        """Chains of simple turning joints, uint8[k, joints, 2]."""
        k, joints, _ = edges.shape
        turning = np.full((k, joints), int(np.argmax(_TURNS)), np.int32)
        return cls(
            links=links,
            mobility=mobility,
            hubs=np.zeros(k, np.int64),
            sizes=np.full(k, joints),
            edges=edges.astype(np.int32),
            pairs=turning,
        )


def arrays_of_chains(links: int, mobility: int, chains: Sequence[Chain]) -> ChainArrays:
    """The arrays of chains, in their order."""
    rows: list[list[tuple[int, int, int]]] = []
    hubs = []
    for chain in chains:
        row: list[tuple[int, int, int]] = []
        vertex = links
        for joint in chain.joints:
            members = [chain.index(link) for link in joint.links]
            place = _PLACE[joint.pair.name]
            if len(members) == 2:
                row.append((members[0], members[1], place))
            else:
                row += [(member, vertex, place) for member in members]
                vertex += 1
        rows.append(row)
        hubs.append(vertex - links)
    widest = max(map(len, rows), default=0)
    table = np.zeros((len(rows), widest, 3), np.int32)
    for k, row in enumerate(rows):
        table[k, : len(row)] = row
    return ChainArrays(
        links=links,
        mobility=mobility,
        hubs=np.array(hubs, np.int64),
        sizes=np.array([len(row) for row in rows], np.int64),
        edges=np.ascontiguousarray(table[:, :, :2]),
        pairs=np.ascontiguousarray(table[:, :, 2]),
    )


def chain_table(chains: ChainArrays, kinds: Sequence[str] | str, contracted: Contracted | None = None) -> pa.Table:
    """The rows of chains.

    Args:
        chains: the chains.
        kinds: how each of them, or all of them, are fractionated.
        contracted: their contracted graphs, where they have some.

    Cost: about 30 us for a chain of 14 links, and the crossings of each contracted graph.
    """
    pa = arrow_library()
    n, count = chains.links, len(chains.sizes)
    loops = (n - 1 - chains.mobility) // 2
    simple = chains.hubs == 0
    members, degrees = _members(chains)
    joints = chains.sizes - members.sum(axis=1) + chains.hubs
    if n > _MOST_LINKS or members.max(initial=0) > _MOST_MEMBERS:
        raise GrueblerError(
            "the atlas describes chains of at most {links} links with at most {members} links in a joint",
            links=_MOST_LINKS,
            members=_MOST_MEMBERS,
        )
    letters = np.array([ord(p.symbols.get(Alphabet.INTERNATIONAL, "?")[0]) for p in PAIRS], np.uint8)
    numbers, ends, text, graph6, certificates = _core.describe_chains(
        n, chains.mobility, loops, chains.hubs, chains.sizes, chains.edges, chains.pairs, letters
    )
    if len(numbers) < count:
        raise GrueblerError("a chain of {links} links has too many circuits for the atlas", links=n)
    column = {name: numbers[:, k] for k, name in enumerate(_NUMBERS)}
    turning = ((_TURNS[chains.pairs]) | ~_present(chains)).all(axis=1)
    if contracted is None:
        graphs, graph_codes = _contracted(chains, kinds)
        crossings = _crossings(chains)
    else:
        graphs, graph_codes = contracted.numbers, contracted.codes()
        crossings = contracted.crossings()
    values: dict[str, Any] = {
        **column,
        "links": np.full(count, n),
        "mobility": np.full(count, chains.mobility),
        "loops": np.full(count, loops),
        "joints": joints,
        "multiple_joints": chains.hubs,
        "prismatic": ((_SLIDES[chains.pairs]) & _present(chains)).sum(axis=1),
        "fractionated": pa.repeat(kinds, count) if isinstance(kinds, str) else pa.array(kinds, pa.string()),
        "assortment": _assortments(degrees),
        "graph6": _texts(graph6, np.full(count, graph6.shape[1]), simple & turning),
        "code": _flat_texts(text, ends),
        "contracted_graph": graphs,
        "contracted_code": graph_codes,
        "planar": crossings == 0,
        "crossings": pa.array(crossings, pa.int16(), mask=crossings < 0),
        "dyadic": column["dyadic"] == 1,
        "certificate": _texts(certificates, chains.sizes, simple & turning),
    }
    schema = arrow_schema("chains")
    return pa.Table.from_arrays([_cast(values[field.name], field.type) for field in schema], schema=schema)


def _cast(values: Any, kind: pa.DataType) -> pa.Array:
    pa = arrow_library()
    array = values if isinstance(values, pa.Array) else pa.array(np.ascontiguousarray(values))
    return array if array.type == kind else array.cast(kind)


def _present(chains: ChainArrays) -> NDArray[np.bool_]:
    """bool[k, e]: whether there is such an edge."""
    present: NDArray[np.bool_] = np.arange(chains.edges.shape[1]) < chains.sizes[:, None]
    return present


def _members(chains: ChainArrays) -> tuple[Int64, Int64]:
    """int64[k, hubs]: links of each multiple joint; int64[k, links]: joints of each link."""
    count, most = len(chains.sizes), int(chains.hubs.max(initial=0))
    ends = np.zeros((count, chains.links + most + 1), np.int64)
    present = _present(chains)
    last = chains.links + most
    for e in range(chains.edges.shape[1]):
        for side in range(2):
            vertex = np.where(present[:, e], chains.edges[:, e, side], last)
            ends[np.arange(count), vertex] += 1
    return ends[:, chains.links : last], ends[:, : chains.links]


def _assortments(degrees: Int64) -> pa.Array:
    """The numbers of links of 2, 3, ... joints, as text."""
    pa = arrow_library()
    largest = int(degrees.max(initial=2))
    numbers = np.stack([(degrees == k).sum(axis=1) for k in range(2, largest + 1)], axis=1)
    unique, place = np.unique(numbers, axis=0, return_inverse=True)
    texts = [",".join(map(str, np.trim_zeros(row, "b").tolist())) for row in unique]
    places = place.reshape(-1).astype(np.int32)
    return pa.DictionaryArray.from_arrays(places, pa.array(texts, pa.string())).cast(pa.string())


def _texts(lines: NDArray[np.uint8], lengths: Int64, present: NDArray[np.bool_]) -> pa.Array:
    """Texts of the first letters of each line, empty where they are not present."""
    pa = arrow_library()
    lengths = np.where(present, lengths, 0)
    letters = lines[np.arange(lines.shape[1]) < lengths[:, None]]
    array = _flat_texts(letters, np.cumsum(lengths))
    return array if present.all() else pa.compute.if_else(pa.array(present), array, pa.scalar(None, pa.string()))


def _flat_texts(letters: NDArray[np.uint8], ends: Int64) -> pa.Array:
    """Texts one after another, by their ends."""
    pa = arrow_library()
    offsets = np.concatenate([[0], ends])
    if offsets[-1] < 2**31:
        buffers = [None, pa.py_buffer(offsets.astype(np.int32)), pa.py_buffer(np.ascontiguousarray(letters))]
        return pa.Array.from_buffers(pa.string(), len(ends), buffers)
    raise GrueblerError("a part of the atlas has more than 2 GB of text; make it from smaller pieces of work")


# --- contracted graphs -------------------------------------------------------------------------------


class Contracted(NamedTuple):
    """The contracted graphs of chains."""

    numbers: Int32
    """int32[k]: the number of the graph of each chain among all of its loops."""
    graphs: tuple[ContractedGraph, ...]
    first: int
    """The number of the first of these graphs."""

    def codes(self) -> pa.Array:
        """The code of the graph of each chain."""
        pa = arrow_library()
        texts = pa.array([_code(graph) for graph in self.graphs], pa.string())
        return pa.DictionaryArray.from_arrays(self.numbers - np.int32(self.first), texts).cast(pa.string())

    def crossings(self) -> NDArray[np.int16]:
        """The fewest crossings of each chain, those of its graph; -1 for more than one."""
        by_graph = np.full(len(self.graphs), -1, np.int16)
        for k in np.unique(self.numbers - self.first):
            least = least_crossings(self.graphs[k].bundles)
            by_graph[k] = -1 if least is None else least
        return by_graph[self.numbers - self.first]


def _contracted(chains: ChainArrays, kinds: Sequence[str] | str) -> tuple[pa.Array, pa.Array]:
    """Number and code of the contracted graph of each chain, found on the chain itself."""
    pa = arrow_library()
    count, n = len(chains.sizes), chains.links
    loops = (n - 1 - chains.mobility) // 2
    numbers: list[int | None] = [None] * count
    codes: list[str | None] = [None] * count
    for k in range(count if loops > 1 else 0):
        if chains.hubs[k] or (kinds if isinstance(kinds, str) else kinds[k]) != "none":
            continue
        graph = _contract(n, chains.edges[k, : chains.sizes[k]].tolist()).canonical()
        numbers[k] = _numbers(loops)[graph.bundles]
        codes[k] = _code(graph)
    return pa.array(numbers, pa.int32()), pa.array(codes, pa.string())


def _contract(links: int, edges: list[list[int]]) -> ContractedGraph:
    """The contracted graph of a chain of simple joints."""
    near: list[list[int]] = [[] for _ in range(links)]
    for u, v in edges:
        near[u].append(v)
        near[v].append(u)
    nodes = [v for v in range(links) if len(near[v]) > 2]
    strings: Counter[tuple[int, int]] = Counter()
    for k, start in enumerate(nodes):
        for step in near[start]:
            last, here = start, step
            while len(near[here]) == 2:
                last, here = here, near[here][0] if near[here][0] != last else near[here][1]
            strings[k, nodes.index(here)] += 1
    return ContractedGraph(tuple((u, v, number) for (u, v), number in strings.items() if u < v))


@cache
def _numbers(loops: int) -> dict[tuple[Bundle, ...], int]:
    """The numbers of the contracted graphs of so many loops."""
    return {graph.bundles: k for k, graph in enumerate(contracted_graphs(loops))}


def _code(graph: ContractedGraph) -> str:
    """The bundles of a contracted graph.

    >>> _code(ContractedGraph(((0, 1, 2), (1, 2, 2), (0, 2, 1))))
    '0-1x2 0-2 1-2x2'
    """
    return " ".join(f"{u}-{v}" + (f"x{k}" if k > 1 else "") for u, v, k in graph.bundles)


def _crossings(chains: ChainArrays) -> NDArray[np.int16]:
    """The fewest crossings of each chain, found on the chain itself; -1 for more than one."""
    least = (
        least_crossings([(u, v, 1) for u, v in row[:size]])
        for row, size in zip(chains.edges.tolist(), chains.sizes.tolist(), strict=True)
    )
    return np.array([-1 if number is None else number for number in least], np.int16)
