"""Graphs in the DOT language: nodes, undirected edges and attributes; no subgraphs."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING

from gruebler.base.errors import GrueblerError
from gruebler.structure.chain import Chain

if TYPE_CHECKING:
    import networkx as nx

_COMMENT = re.compile(r'("(?:[^"\\]|\\.)*")|//[^\n]*|^#[^\n]*|/\*.*?\*/', re.DOTALL | re.MULTILINE)
_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|--|->|-?(?:\.\d+|\d+(?:\.\d*)?)|\w+|[{}\[\];,=]|\S')
_MOST = 300_000  # words and signs; a chain of thousands of joints has fewer
_WORD = re.compile(r"[A-Za-z_]\w*|\d+")


def graph_from_dot(text: str) -> nx.MultiGraph:
    """The graph of a DOT text, attributes as texts.

    >>> graph_from_dot('graph { a -- b -- c; c -- a [pair="prismatic"] }').edges["c", "a", 0]
    {'pair': 'prismatic'}
    """
    return _Reader(text).graph


def dot_from_chain(chain: Chain) -> str:
    """A chain in DOT: an edge with ``pair`` and ``joint`` for every two links of a joint."""
    lines = [f"    {_quoted(link)};" for link in chain.links]
    for a, b, data in chain.link_graph().edges(data=True):
        lines.append(f'    {_quoted(a)} -- {_quoted(b)} [pair="{data["pair"]}", joint={data["joint"]}];')
    return "\n".join(["graph {", f'    space="{chain.space}";', *lines, "}"]) + "\n"


def _quoted(name: str) -> str:
    return name if _WORD.fullmatch(name) else '"' + re.sub(r'(["\\])', r"\\\1", name) + '"'


class _Reader:
    """The tokens of a text, and the graph that they make."""

    def __init__(self, text: str) -> None:
        import networkx

        self._tokens = _TOKEN.findall(_COMMENT.sub(lambda match: match[1] or " ", text))
        if len(self._tokens) > _MOST:
            raise GrueblerError("has more than {most:,} words and signs", most=_MOST)
        self._place = 0
        self.graph = networkx.MultiGraph()
        self._passed("strict")
        if self._next() not in ("graph", "Graph", "GRAPH"):
            raise GrueblerError("expected 'graph': edges of a chain have no direction")
        if self._peek() != "{":
            self._next()
        self._take("{")
        while not self._passed("}"):
            if not self._passed(";"):
                self._statement()
        if self._peek():
            raise GrueblerError("expected the end, but found {found!r}", found=self._peek())

    def _peek(self) -> str:
        return self._tokens[self._place] if self._place < len(self._tokens) else ""

    def _next(self) -> str:
        token = self._peek()
        if not token:
            raise GrueblerError("is cut off")
        self._place += 1
        return re.sub(r"\\(.)", r"\1", token[1:-1]) if token.startswith('"') and len(token) > 1 else token

    def _passed(self, token: str) -> bool:
        there = self._peek() == token
        self._place += there
        return there

    def _take(self, token: str) -> None:
        if not self._passed(token):
            raise GrueblerError("expected {wanted!r}, but found {found!r}", wanted=token, found=self._peek())

    def _statement(self) -> None:
        if self._peek() in ("subgraph", "{"):
            raise GrueblerError("subgraphs are not read")
        default = self._peek() in ("graph", "node", "edge")
        nodes = [self._name()]
        if self._passed("="):
            self.graph.graph[nodes[0]] = self._name()
            return
        while self._passed("--"):
            nodes.append(self._name())
        data = self._attributes()
        if not default:
            self.graph.add_nodes_from(nodes)
            self.graph.add_edges_from((a, b, data) for a, b in pairwise(nodes))

    def _name(self) -> str:
        if self._peek() and not re.match(r'["\w.-]', self._peek()):
            raise GrueblerError("expected a name, but found {found!r}", found=self._peek())
        return self._next()

    def _attributes(self) -> dict[str, str]:
        attributes: dict[str, str] = {}
        while self._passed("["):
            while not self._passed("]"):
                key = self._name()
                self._take("=")
                attributes[key] = self._name()
                if not self._passed(","):
                    self._passed(";")
        return attributes
