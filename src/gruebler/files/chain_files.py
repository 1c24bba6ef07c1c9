"""Chains as graphs in files: GraphML, GML, DOT, edge lists, adjacency matrices; graph6 and sparse6, one a line.

GraphML, GML and DOT have the links as nodes and an edge with ``pair`` and ``joint`` for every two links of a joint, so
that they carry everything; an edge without ``pair`` is a revolute joint. The others have simple joints only: edge
lists name the pair of those that do not turn, matrices and codes have revolute joints.
"""

from __future__ import annotations

import gzip
import re
import warnings
from collections.abc import Callable, Iterable, Iterator
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO
from zlib import error as ZlibError

from gruebler.base.atomic_files import atomic_file
from gruebler.base.errors import GrueblerError, naming
from gruebler.base.text import Message, message, reason_of
from gruebler.files.dot import dot_from_chain, graph_from_dot
from gruebler.files.structures import chain_of_text
from gruebler.files.text_files import parse_xml
from gruebler.structure.chain import Chain
from gruebler.structure.chain.documents import check_size, links_of_code

if TYPE_CHECKING:
    import networkx as nx

_LONGEST_LINE = 1_000_000
_REVOLUTE = "revolute"
_PACKED = 100  # times its size a packed file may be: lists of chains come to 30, bombs to 1000


# --- one graph a file --------------------------------------------------------------------------------


def chain_from_graph_text(text: str, form: str) -> Chain:
    """The chain of a graph in one of the `GRAPHS` forms; `GrueblerError` for anything else.

    >>> print(chain_from_graph_text('graph { a -- b -- c; c -- a [pair="prismatic"] }', "dot"))
    R(a-b) P(a-c) R(b-c)
    """
    try:
        graph = GRAPHS[form][0](text)
    except GrueblerError:
        raise
    except RecursionError:
        raise GrueblerError("is nested too deeply") from None
    except _unreadable() as error:
        raise GrueblerError("is not a {form} file: {reason}", form=form, reason=error or type(error).__name__) from None
    check_size(graph.number_of_nodes(), graph.number_of_edges())
    return _chain(graph)


def _unreadable() -> tuple[type[Exception], ...]:
    """What the parsers of networkx raise for a damaged text: few kinds of their own, mostly those of the builtins."""
    import networkx

    return networkx.NetworkXException, ValueError, LookupError, TypeError, AttributeError, ArithmeticError, SyntaxError


def graph_text(chain: Chain, form: str, left_out: list[Message]) -> str:
    """The text of a chain in one of the `GRAPHS` forms; `GrueblerError` if it has joints that the form cannot hold."""
    return GRAPHS[form][1](chain, left_out)


def _chain(graph: nx.Graph) -> Chain:
    """The chain of a graph that may come from elsewhere.

    An edge without ``pair`` is a revolute joint, one without ``joint`` a joint of its own; a frame is passed over.
    """
    labels = dict.fromkeys(str(marks["joint"]) for *_, marks in graph.edges(data=True) if "joint" in marks)
    counted = all(label.isdecimal() and len(label) < 10 for label in labels)
    numbers = {label: int(label) if counted else k for k, label in enumerate(labels)}
    following = count(max(numbers.values(), default=-1) + 1)
    for *_, marks in graph.edges(data=True):
        marks["joint"] = numbers[str(marks["joint"])] if "joint" in marks else next(following)
        marks.setdefault("pair", _REVOLUTE)
    graph.graph.pop("frame", None)
    return Chain.from_networkx(graph)


def _from_graphml(text: str) -> nx.Graph:
    import networkx

    parse_xml(text)  # refuses entities
    with warnings.catch_warnings(action="ignore"):  # of keys without a type, which are read as strings
        return networkx.parse_graphml(text, force_multigraph=True)


def _to_graphml(chain: Chain, left_out: list[Message]) -> str:
    import networkx

    del left_out
    return "\n".join(networkx.generate_graphml(chain.link_graph())) + "\n"


def _from_gml(text: str) -> nx.Graph:
    import networkx

    return networkx.parse_gml(text)


def _to_gml(chain: Chain, left_out: list[Message]) -> str:
    import networkx

    del left_out
    return "\n".join(networkx.generate_gml(chain.link_graph())) + "\n"


def _from_edges(text: str) -> nx.Graph:
    import networkx

    graph = networkx.MultiGraph()
    for number, line in enumerate(text.splitlines(), 1):
        words = line.partition("#")[0].split()
        if not words:
            continue
        if len(words) not in (2, 3):
            raise GrueblerError("line {number}: expected two links and perhaps a pair", number=number)
        check_size(0, number)
        graph.add_edge(words[0], words[1], pair=words[2] if len(words) > 2 else _REVOLUTE)
    return graph


def _to_edges(chain: Chain, left_out: list[Message]) -> str:
    _check_simple(chain, "edge list")
    names = {link: link for link in chain.links}
    if any(re.search(r"[\s#]", link) for link in names):
        names = {link: str(number) for number, link in enumerate(chain.links)}
        left_out.append(message("names of links"))
    return "".join(
        " ".join([*(names[link] for link in joint.links), *[joint.pair.name] * (not joint.pair.is_turning)]) + "\n"
        for joint in chain.joints
    )


def _from_matrix(text: str) -> nx.Graph:
    import networkx

    rows = [re.split(r"[,;\s]+", line.strip(" \t[],;")) for line in text.splitlines() if line.strip(" \t[],;")]
    if any(len(row) != len(rows) for row in rows) or not all(
        cell.isdecimal() and len(cell) < 4 for r in rows for cell in r
    ):
        raise GrueblerError("expected a square matrix of whole numbers")
    check_size(len(rows), sum(int(cell) for row in rows for cell in row) // 2)
    graph = networkx.MultiGraph()
    graph.add_nodes_from(range(len(rows)))
    for i, row in enumerate(rows):
        for j, cell in enumerate(row):
            if rows[j][i] != cell:
                raise GrueblerError("row {i}, column {j}: the matrix is not symmetric", i=i + 1, j=j + 1)
            if i == j and int(cell):
                raise GrueblerError("row {i}: a link has no joint with itself", i=i + 1)
            graph.add_edges_from([(i, j)] * (int(cell) if i < j else 0))
    return graph


def _to_matrix(chain: Chain, left_out: list[Message]) -> str:
    _check_simple(chain, "matrix", revolute=True)
    if list(chain.links) != [str(k) for k in range(chain.n)]:
        left_out.append(message("names of links"))
    rows = [[0] * chain.n for _ in chain.links]
    for joint in chain.joints:
        i, j = map(chain.index, joint.links)
        rows[i][j] += 1
        rows[j][i] += 1
    return "".join(" ".join(map(str, row)) + "\n" for row in rows)


def _check_simple(chain: Chain, form: str, *, revolute: bool = False) -> None:
    if chain.multiple_joints or str(chain.space) != "planar":
        raise GrueblerError(
            "the {form} holds planar chains with simple joints only, not {chain}", form=form, chain=chain
        )
    if revolute and not all(joint.pair.is_turning for joint in chain.joints):
        raise GrueblerError("the {form} holds revolute joints only, not {chain}", form=form, chain=chain)


GRAPHS: dict[str, tuple[Callable[[str], Any], Callable[[Chain, list[Message]], str]]] = {
    "graphml": (_from_graphml, _to_graphml),
    "gml": (_from_gml, _to_gml),
    "dot": (graph_from_dot, lambda chain, _: dot_from_chain(chain)),
    "edge-list": (_from_edges, _to_edges),
    "matrix": (_from_matrix, _to_matrix),
}
"""The forms of one graph a file: reader of a text, writer of a chain."""


# --- one chain a line --------------------------------------------------------------------------------


def _from_graph6(line: str) -> Chain:
    return Chain.parse(line if line.startswith("g6:") else f"g6:{line.removeprefix('>>graph6<<')}")


def _from_sparse6(line: str) -> Chain:
    import networkx

    code = line.removeprefix(">>sparse6<<")
    check_size(links_of_code(code.removeprefix(":")), 0)  # networkx makes the nodes before it has seen an edge
    try:
        graph = networkx.from_sparse6_bytes(code.encode("ascii"))
    except _unreadable() as error:
        raise GrueblerError("is not a sparse6 code: {reason}", reason=error or type(error).__name__) from None
    check_size(0, graph.number_of_edges())
    return _chain(networkx.MultiGraph(graph))


def _to_graph6(chain: Chain) -> str:
    import networkx

    graph = _plain_graph(chain, "graph6")
    if graph.number_of_edges() != networkx.Graph(graph).number_of_edges():
        raise GrueblerError("graph6 holds one joint between two links, not {chain}", chain=chain.text())
    return str(networkx.to_graph6_bytes(networkx.Graph(graph), header=False).decode("ascii").strip())


def _to_sparse6(chain: Chain) -> str:
    import networkx

    graph = _plain_graph(chain, "sparse6")
    return str(networkx.to_sparse6_bytes(graph, header=False).decode("ascii").strip())


def _plain_graph(chain: Chain, form: str) -> nx.MultiGraph:
    import networkx

    if any(joint.count != 1 or not joint.pair.is_turning for joint in chain.joints):
        raise GrueblerError(
            "{form} holds chains with simple revolute joints only, not {chain}", form=form, chain=chain.text()
        )
    graph = networkx.MultiGraph()
    graph.add_nodes_from(range(chain.n))
    graph.add_edges_from(tuple(map(chain.index, joint.links)) for joint in chain.joints)
    return graph


LINES: dict[str, tuple[Callable[[str], Chain], Callable[[Chain], str]]] = {
    "text": (chain_of_text, Chain.text),
    "graph6": (_from_graph6, _to_graph6),
    "sparse6": (_from_sparse6, _to_sparse6),
}
"""The forms of one chain a line: reader of a line, writer of a chain."""


def read_lines(path: Path, form: str) -> Iterator[Chain]:
    """The chains of a file, one after the other, never all at once; a name with ``.gz`` is unpacked as it is read.

    Lines that are empty or begin with ``#`` are passed over (in sparse6 a code begins with a colon). Raises
    `GrueblerError` that names the file and the line.
    """
    try:
        with path.open("rb") as raw:
            packed = path.suffix.lower() == ".gz"
            if packed:
                _check_packing(path, raw)
            lines = gzip.GzipFile(fileobj=raw) if packed else raw
            yield from _chains(path, lines, LINES[form][0])
    except (OSError, EOFError, ZlibError) as error:
        reason = reason_of(error) if isinstance(error, OSError) and error.errno else error
        raise GrueblerError("{path}: cannot be read: {problem}", path=path, problem=reason) from None


def _check_packing(path: Path, raw: BinaryIO) -> None:
    """`GrueblerError` for a file that unpacks to far more than its size; takes a hundredth of the time of reading."""
    with gzip.GzipFile(fileobj=raw) as unpacked:
        while unpacked.read(_LONGEST_LINE // 10):
            if unpacked.tell() > _LONGEST_LINE + _PACKED * raw.tell():
                raise GrueblerError("{path}: unpacks to more than {times} times its size", path=path, times=_PACKED)
    raw.seek(0)


def _chains(path: Path, lines: BinaryIO | gzip.GzipFile, parse: Callable[[str], Chain]) -> Iterator[Chain]:
    number = 0
    while line := lines.readline(_LONGEST_LINE + 1):
        number += 1
        if len(line) > _LONGEST_LINE:
            raise GrueblerError(
                "{path}, line {number}: longer than {most:,} characters", path=path, number=number, most=_LONGEST_LINE
            )
        try:
            text = line.decode("utf-8-sig" if number == 1 else "utf-8").strip()
        except UnicodeDecodeError:
            raise GrueblerError("{path}, line {number}: is not UTF-8 text", path=path, number=number) from None
        if not text or text.startswith("#"):
            continue
        with naming(message("{path}, line {number}", path=path, number=number), GrueblerError):
            yield parse(text)


def write_lines(chains: Iterable[Chain], path: Path, form: str) -> int:
    """Write chains one a line as they come, packed if the name ends with ``.gz``; returns how many.

    The file appears complete or not at all.
    """
    count = 0
    write = LINES[form][1]
    with atomic_file(path, durable=False) as file:
        if path.suffix.lower() == ".gz":  # no time stamp: the same chains make the same file
            lines: Any = gzip.GzipFile(filename="", fileobj=file, mode="wb", mtime=0)
        else:
            lines = file
        for chain in chains:
            lines.write(f"{write(chain)}\n".encode())
            count += 1
        if lines is not file:
            lines.close()
    return count
