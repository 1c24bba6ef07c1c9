"""The kinematic chain: links and the joints between them, without frame and without size.

A chain is an immutable value and is checked when it is constructed. Two chains are equal when they have the same
space, the same links and the same joints, in any order. `gruebler.structure.isomorphism` compares the *structure* of
two chains regardless of names.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import ChainError, GrueblerError, NotationError, expect, unknown
from gruebler.base.immutable import Immutable, settle
from gruebler.base.notebook import Drawn
from gruebler.base.text import message
from gruebler.structure.chain import graphs, notation
from gruebler.structure.chain.documents import read_document, read_graph6
from gruebler.structure.chain.joint import Joint
from gruebler.structure.chain.pairs import Alphabet, Pair, SymbolText, in_alphabets
from gruebler.structure.chain.soundness import check_connected, checked_edges, checked_joints, checked_links
from gruebler.structure.chain.spaces import Space

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True, init=False, eq=False, repr=False)
class Chain(Immutable, Drawn):
    """Links and joints in one space.

    Args:
        joints: each a `Joint` or (pair or its full name, link names). Joints between the same links may repeat.
        links: the names of the links, to fix their order or to detect a misspelt name in a joint; by default
            the links that the joints name, in that order. Numbers serve as names.
        space: ``planar`` (default), ``spherical`` or ``spatial``.

    Raises:
        ChainError: fewer than three links, a link without joint, a joint with fewer than two links or the same
            link twice, doubled or unusable names, a joint naming a link that was not declared, a pair
            with more than two links that cannot be shared, or a chain in several parts.
        PairError: an unknown pair, or one that the space does not allow.

    The constructor costs O(links + joint elements).

    >>> slider_crank = Chain([("revolute", ["frame", "crank"]), ("revolute", ["crank", "rod"]),
    ...                       ("revolute", ["rod", "piston"]), ("prismatic", ["frame", "piston"])])
    >>> print(slider_crank)
    R(frame-crank) R(crank-rod) R(rod-piston) P(frame-piston)
    >>> slider_crank == Chain.parse("P(piston-frame) R(frame-crank) R(crank-rod) R(rod-piston)")
    True

    See Also:
        `Joint`, `Mechanism`, `chains`, `mobility_report`

    Theory:
        docs/theory/freedoms.md
    """

    joints: tuple[Joint, ...]
    links: tuple[str, ...]
    space: Space

    def __init__(
        self,
        joints: Iterable[Joint | tuple[str | Pair, Sequence[str | int]]],
        *,
        links: Iterable[str | int] | None = None,
        space: str | Space = Space.PLANAR,
    ) -> None:
        checked_space = notation.space_of(space)
        checked = checked_joints(joints, checked_space)
        named = tuple(dict.fromkeys(link for j in checked for link in j.links))
        declared = named if links is None else checked_links(links, named, checked)
        check_connected(declared, checked)
        settle(self, joints=checked, links=declared, space=checked_space)

    # --- reading and writing -------------------------------------------------------------------------

    @classmethod
    @door_that_raises(NotationError)
    def parse(cls, text: str, *, space: str | Space | None = None) -> Chain:
        """The chain that a text describes; see `gruebler.structure.chain.notation` for the grammar.

        ``g6:`` followed by a graph6 code gives a planar chain of revolute joints, its links named 0, 1, 2, ...

        >>> Chain.parse("D(0-1) D(1-2) S(2-0)").joints[2].pair
        <pair prismatic>
        >>> len(Chain.parse("g6:Cr").joints)
        4
        """
        expect(text, str)
        if text.lstrip().lower().startswith("g6:"):
            return cls.from_graph6(text.strip()[3:].strip())
        read_space, joints = notation.read_joints(text, space)
        return cls(joints, space=read_space)

    @classmethod
    def from_edges(
        cls,
        edges: Iterable[tuple[str | int, str | int]],
        *,
        pair: str | Pair = "revolute",
        space: str | Space = "planar",
    ) -> Chain:
        """A chain of simple joints of one kind, one for each edge; links are named as the edges name them.

        Raises `ChainError` for edges that are not two names or whole numbers; `from_networkx` takes graphs with joints
        of several kinds.

        >>> print(Chain.from_edges([(0, 1), (1, 2), (2, 3), (3, 0)]))
        R(0-1) R(1-2) R(2-3) R(3-0)
        """
        return cls([(pair, links) for links in checked_edges(edges)], space=space)

    @classmethod
    @door_that_raises(NotationError)
    def from_graph6(cls, code: str) -> Chain:
        """The planar chain of revolute joints whose link graph this graph6 code describes."""
        joints, links = read_graph6(code)
        return cls(joints, links=links)

    @classmethod
    def from_json(cls, document: str | Mapping[str, Any]) -> Chain:
        """The chain of a JSON document made by `to_json` (the text, or the object already read)."""
        joints, links, space = read_document(document)
        return cls(joints, links=links, space=space)

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`: space, links and joints, all names in full.

        >>> Chain.parse("R(0-1) R(1-2) R(2-0)").to_json()["joints"][0]
        {'pair': 'revolute', 'links': ['0', '1']}
        """
        return {
            "space": str(self.space),
            "links": list(self.links),
            "joints": [{"pair": j.pair.name, "links": list(j.links)} for j in self.joints],
        }

    def text(self, alphabet: str | Alphabet = Alphabet.INTERNATIONAL) -> str:
        """The text form in one alphabet; `parse` takes it back.

        >>> Chain.parse("R(0-1) R(1-2) P(2-0)").text("german")
        'D(0-1) D(1-2) S(2-0)'
        """
        return notation.write_joints(self.space, [(j.pair, j.links) for j in self.joints], Alphabet(alphabet))

    __str__ = text

    def __repr__(self) -> str:
        return f"Chain.parse({self.text()!r})"

    # --- a value -----------------------------------------------------------------------------------

    def _identity(self) -> tuple[object, ...]:
        return self.space, tuple(sorted(self.links)), tuple(sorted(j.key for j in self.joints))

    # --- counts ------------------------------------------------------------------------------------

    @property
    def n(self) -> int:
        """The number of links, the later frame included."""
        return len(self.links)

    @property
    def g(self) -> int:
        """The number of joints, a joint of k links counted k - 1 times."""
        return sum(j.count for j in self.joints)

    @property
    def loops(self) -> int:
        """The number of independent loops, g - n + 1."""
        return self.g - self.n + 1

    @cached_property
    def joints_by_freedom(self) -> dict[int, int]:
        """g1, g2, ...: how many joints have f = 1, 2, ... freedoms (a joint of k links counted k - 1 times).

        >>> Chain.parse("R(0-1) R(1-2-3) R(3-0) R(2-0)").joints_by_freedom
        {1: 5}
        """
        counts: Counter[int] = Counter()
        for j in self.joints:
            counts[j.pair.f(self.space)] += j.count
        return dict(sorted(counts.items()))

    @cached_property
    def degrees(self) -> dict[str, int]:
        """For each link the number of joints it carries (a multiple joint is one joint of each of its links)."""
        counts = Counter(link for j in self.joints for link in j.links)
        return {link: counts[link] for link in self.links}

    @cached_property
    def link_kinds(self) -> dict[int, int]:
        """n1, n2, n3, ...: how many links are singular, binary, ternary, ...

        >>> Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)").link_kinds
        {2: 4, 3: 2}
        """
        return dict(sorted(Counter(self.degrees.values()).items()))

    @property
    def assortment(self) -> tuple[int, ...]:
        """The numbers (n2, n3, n4, ...) of binary, ternary, quaternary, ... links, up to the largest there is.

        >>> Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)").assortment
        (4, 2)
        """
        return tuple(self.link_kinds.get(k, 0) for k in range(2, max(self.link_kinds) + 1))

    @cached_property
    def multiple_joints(self) -> tuple[Joint, ...]:
        """The joints of more than two links."""
        return tuple(j for j in self.joints if len(j.links) > 2)

    def joints_of(self, link: str) -> tuple[Joint, ...]:
        """The joints that this link carries; `ChainError` for a name the chain does not have."""
        self.index(link)
        return tuple(j for j in self.joints if link in j.links)

    def index(self, link: str) -> int:
        """The place of this link among the links; `ChainError` for a name the chain does not have."""
        try:
            return self._places[link]
        except KeyError:
            raise ChainError("the chain has no link {word!r}{suggestion}", **unknown(link, self.links)) from None

    @cached_property
    def _places(self) -> dict[str, int]:
        return {link: i for i, link in enumerate(self.links)}

    def joint_names(self, alphabet: str | Alphabet = Alphabet.INTERNATIONAL) -> tuple[str, ...]:
        """A unique text for each joint: ``R(a-b)``, or ``R(a-b)#2`` where it repeats."""
        if (alphabet := Alphabet(alphabet)) not in self._names_by_alphabet:
            self._names_by_alphabet[alphabet] = self._joint_names(alphabet)
        return self._names_by_alphabet[alphabet]

    @cached_property
    def _names_by_alphabet(self) -> dict[Alphabet, tuple[str, ...]]:
        return {}

    def _joint_names(self, alphabet: Alphabet) -> tuple[str, ...]:
        seen: Counter[tuple[str, tuple[str, ...]]] = Counter()
        symbols = notation.symbols_for((j.pair for j in self.joints), self.space, alphabet)
        names = []
        for j in self.joints:
            seen[j.key] += 1
            again = f"#{seen[j.key]}" if seen[j.key] > 1 else ""
            names.append(notation.joint_text(symbols[j.pair], j.links) + again)
        return tuple(names)

    def joint_title(self, number: int) -> SymbolText:
        """The text of a joint, for messages: in the letters that the reader expects.

        >>> Chain.parse("R(0-1) R(1-2) P(2-0)").joint_title(2).in_language("de")
        'S(2-0)'
        """
        return in_alphabets(lambda alphabet: self.joint_names(alphabet)[number])

    def find_joint(self, text: str) -> int | None:
        """The number of the joint that a text names, or None.

        Its links may have any order and its symbol any alphabet; a joint that repeats needs its ``#2``.

        >>> Chain.parse("R(0-1) R(1-2) P(2-0)").find_joint("S(0-2)")
        2
        """
        joint_text, _, again = text.partition("#")
        match = re.fullmatch(r"\s*([^\s()]+)\s*\((.*)\)\s*", joint_text)
        if match is None or not (again or "1").strip().isdecimal():
            return None
        links = sorted(name.strip() for name in notation.split_links(match[2]))
        numbers = [
            number
            for number, j in enumerate(self.joints)
            if sorted(j.links) == links and match[1] in {j.pair.name, j.pair.german, *j.pair.symbols.values()}
        ]
        place = int(again or 1) - 1
        return numbers[place] if 0 <= place < len(numbers) else None

    def joint_number(self, joint: int | str, *, error: type[GrueblerError] = ChainError) -> int:
        """The number of the joint that a number or a text names; an error of this kind if the chain has none.

        >>> Chain.parse("R(0-1) R(1-2) P(2-0)").joint_number("R(0-2)")
        Traceback (most recent call last):
            ...
        gruebler.base.errors.ChainError: 'R(0-2)' is not one of the joints (did you mean 'R(1-2)'?); they are R(0-1),
        R(1-2), P(2-0)
        """
        if isinstance(joint, int):
            if 0 <= joint < len(self.joints):
                return joint
            count = len(self.joints) - 1
            raise error(
                message("there is no joint number {joint}; the chain has joints 0 to {count}", joint=joint, count=count)
            )
        number = self.find_joint(joint)
        if number is None:
            names = [name for alphabet in Alphabet for name in self.joint_names(alphabet)]
            raise error(
                message(
                    "{word!r} is not one of the joints{suggestion}; they are {joints}",
                    joints=in_alphabets(lambda alphabet: ", ".join(self.joint_names(alphabet))),
                    **unknown(joint, names),
                )
            )
        return number

    # --- other chains ------------------------------------------------------------------------------

    def renamed(self, names: Mapping[str, str | int]) -> Chain:
        """The same chain with other link names; names that the mapping leaves out are kept.

        >>> print(Chain.parse("R(0-1) R(1-2) R(2-0)").renamed({"0": "frame"}))
        R(frame-1) R(1-2) R(2-frame)
        """
        for link in names:
            self.index(link)
        new = {link: str(names.get(link, link)) for link in self.links}
        return Chain(
            [Joint(j.pair, tuple(new[link] for link in j.links)) for j in self.joints],
            links=[new[link] for link in self.links],
            space=self.space,
        )

    def with_joint(self, kind: str | Pair, links: Sequence[str]) -> Chain:
        """The chain with one more joint; links it does not have yet are added at the end."""
        more = [link for link in links if link not in self._places]
        return Chain([*self.joints, (kind, links)], links=[*self.links, *dict.fromkeys(more)], space=self.space)

    def without_joint(self, number: int) -> Chain:
        """The chain without its joint of this number; `ChainError` if the remainder is not a chain."""
        number = self.joint_number(number)
        remaining = self.joints[:number] + self.joints[number + 1 :]
        return Chain(remaining, links=self.links, space=self.space)

    # --- networkx ----------------------------------------------------------------------------------

    @classmethod
    def from_networkx(cls, graph: nx.Graph) -> Chain:
        """The chain of a graph that `link_graph` or `incidence_graph` gave, with the order of links and joints.

        Nodes may have become texts or other numbers on the way through a file, as long as their attributes are there.

        Raises `ChainError` for any other graph; `from_edges` takes edges without attributes.

        >>> chain = Chain.parse("spatial: R(0-1) C(1-2) S(2-3) R(3-0-4)")
        >>> print(Chain.from_networkx(chain.link_graph()))
        spatial: R(0-1) C(1-2) S(2-3) R(3-0-4)
        """
        joints, links, space = graphs.read_graph(graph)
        if "frame" in graph.graph:
            raise ChainError("the graph has a frame: Mechanism.from_networkx(graph) takes it, its chain is .chain")
        return cls(joints, links=links, space=space)

    def to_networkx(self) -> nx.MultiGraph:
        """The graph of networkx that `from_networkx` takes back: `link_graph`.

        >>> sorted(Chain.parse("R(0-1) R(1-2) R(2-0)").to_networkx().edges())
        [('0', '1'), ('0', '2'), ('1', '2')]
        """
        return self.link_graph()

    def link_graph(self) -> nx.MultiGraph:
        """Links as nodes; an edge for every two links of a joint, with its number as ``joint``, ``pair`` and ``first``.

        A joint of k links gives the k(k-1)/2 edges between them; of the two links of an edge ``first`` is the one that
        the joint names first. `from_networkx` takes the graph back.
        """
        return graphs.link_graph(self.links, self.joints, {"space": str(self.space)})

    def incidence_graph(self) -> nx.Graph:
        """Nodes ("link", name) and ("joint", number), an edge wherever a link carries a joint.

        Nodes have ``kind``, ``link`` or ``joint`` and ``pair``, edges the ``place`` of the link in the joint.
        `from_networkx` takes the graph back.
        """
        return graphs.incidence_graph(self.links, self.joints, {"space": str(self.space)})
