"""Chains as graphs of networkx and back: links as nodes, or links and joints.

The attributes carry everything, so that a graph may change its nodes (files turn tuples into texts) as long as it
keeps them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from gruebler.base.errors import ChainError
from gruebler.base.text import Message, message
from gruebler.structure.chain.joint import Joint
from gruebler.structure.chain.spaces import Space

if TYPE_CHECKING:
    import networkx as nx

Joints = list[tuple[str, list[str]]]


def link_graph(links: Iterable[str], joints: Iterable[Joint], marks: Mapping[str, str]) -> nx.MultiGraph:
    """Links as nodes, an edge for every two links of a joint; ``first`` is the one that the joint names first."""
    import networkx as nx

    graph = nx.MultiGraph(**marks)
    graph.add_nodes_from(links)
    for number, j in enumerate(joints):
        for i, a in enumerate(j.links):
            marked = {"joint": number, "pair": j.pair.name, "first": a}
            graph.add_edges_from((a, b, dict(marked)) for b in j.links[i + 1 :])
    return graph


def incidence_graph(links: Iterable[str], joints: Iterable[Joint], marks: Mapping[str, str]) -> nx.Graph:
    """Links and joints as nodes, an edge for every link of a joint with its ``place`` among them."""
    import networkx as nx

    graph = nx.Graph(**marks)
    graph.add_nodes_from((("link", link), {"kind": "link", "link": link}) for link in links)
    for number, j in enumerate(joints):
        graph.add_node(("joint", number), kind="joint", joint=number, pair=j.pair.name)
        graph.add_edges_from((("link", link), ("joint", number), {"place": k}) for k, link in enumerate(j.links))
    return graph


def read_graph(graph: nx.Graph) -> tuple[Joints, list[str], str]:
    """Joints, links and space of a graph that one of the two functions above made.

    Raises `ChainError` for anything else; texts stand for numbers.
    """
    _check_graph(graph)
    incidence = any(kind == "joint" for _, kind in graph.nodes(data="kind"))
    joints, links = _of_incidence(graph) if incidence else _of_links(graph)
    return joints, links, str(graph.graph.get("space", Space.PLANAR))


def _check_graph(graph: object) -> None:
    """`ChainError` for what is not an undirected graph of networkx."""
    import networkx as nx

    if not isinstance(graph, nx.Graph) or graph.is_directed():
        raise ChainError(
            "expected an undirected graph of networkx, as link_graph() and incidence_graph() give it, not {found}",
            found=type(graph).__name__,
        )


def _of_links(graph: nx.Graph) -> tuple[Joints, list[str]]:
    names = {node: str(node) for node in graph}
    pairs: dict[int, str] = {}
    firsts: dict[int, dict[frozenset[str], str]] = {}
    for a, b, marks in graph.edges(data=True):
        edge = f"{a}-{b}"
        if not {"joint", "pair"} <= marks.keys():
            raise ChainError(
                "the edge {edge} names no joint and pair, as those of link_graph() do; Chain.from_edges(graph.edges) "
                "takes every edge for a joint",
                edge=edge,
            )
        number = _number(marks["joint"], message("edge {edge}: joint", edge=edge))
        if pairs.setdefault(number, str(marks["pair"])) != str(marks["pair"]):
            raise ChainError("joint {joint}: its edges have different pairs", joint=number)
        own = firsts.setdefault(number, {})
        between = frozenset((names[a], names[b]))
        if between in own:
            raise ChainError("joint {joint} has two edges {edge}", joint=number, edge=edge)
        own[between] = str(marks.get("first", names[a]))
    return [(pairs[k], _in_order(k, firsts[k])) for k in sorted(pairs)], list(names.values())


def _in_order(number: int, firsts: Mapping[frozenset[str], str]) -> list[str]:
    """The links of a joint: of k links the first is the first one of k - 1 edges, the next of k - 2, ..."""
    links = {link: 0 for between in firsts for link in sorted(between)}
    if len(firsts) != len(links) * (len(links) - 1) // 2:
        raise ChainError(
            "joint {joint} joins {links}, but has no edge between every two of them",
            joint=number,
            links=", ".join(links),
        )
    for first in firsts.values():
        links[first] = links.get(first, 0) + 1
    return sorted(links, key=lambda link: -links[link])


def _of_incidence(graph: nx.Graph) -> tuple[Joints, list[str]]:
    links: dict[Any, str] = {}
    numbers: dict[int, Any] = {}
    for node, marks in graph.nodes(data=True):
        match marks:
            case {"kind": "link", "link": link}:
                links[node] = str(link)
            case {"kind": "joint", "joint": joint, "pair": _}:
                number = _number(joint, message("node {node}: joint", node=repr(node)))
                if number in numbers:
                    raise ChainError("two nodes are joint {joint}", joint=number)
                numbers[number] = node
            case _:
                raise ChainError(
                    "the node {node} is neither a link with its name nor a joint with number and pair, as those of "
                    "incidence_graph() are",
                    node=repr(node),
                )
    for a, b in graph.edges():
        if (a in links) == (b in links):
            raise ChainError("the edge {edge} does not join a link with a joint", edge=f"{a!r} to {b!r}")
    joints: Joints = []
    for _, node in sorted(numbers.items()):
        where = message("node {node}: place of a link", node=repr(node))
        places = {link: _number(graph.edges[node, link].get("place", 0), where) for link in graph[node]}
        joints.append(
            (str(graph.nodes[node]["pair"]), [links[link] for link in sorted(places, key=lambda k: places[k])])
        )
    return joints, list(links.values())


def _number(value: object, where: Message) -> int:
    """A whole number, or the text of one, as some files give it."""
    if isinstance(value, int | str) and not isinstance(value, bool) and str(value).isdecimal() and len(str(value)) < 10:
        return int(value)
    raise ChainError("{where}: expected a whole number, not {value!r}", where=where, value=value)
