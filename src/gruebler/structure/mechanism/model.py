"""The mechanism itself: chain, frame and drives, read and written."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import ChainError, NotationError
from gruebler.base.immutable import Immutable, settle
from gruebler.base.notebook import Drawn
from gruebler.base.text import joined_by_and
from gruebler.structure.chain import Chain, graphs, notation
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.chain.spaces import Freedom
from gruebler.structure.isomorphism import DriveMark, code, decode

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True, slots=True)
class Drive:
    """One driven freedom: the number of the joint, the motion direction, and the two links it acts between."""

    joint: int
    direction: str
    between: tuple[str, str]

    @property
    def turning(self) -> bool:
        """Whether it turns the links against each other: its values are angles, else lengths."""
        return Freedom(self.direction).turns


@dataclass(frozen=True, init=False, eq=False, repr=False)
class Mechanism(Immutable, Drawn):
    """A chain, its frame and its drives: an immutable value, checked when it is constructed.

    Args:
        chain: any chain.
        frame: the fixed link.
        drives: each a joint number, a joint written as in the chain's text (``R(frame-crank)``), or a `Drive`. A joint
            with several freedoms needs the direction, a multiple joint the two links: ``C(a-b):Tz``,
            ``R(a-b-c):a-b``. Their order is that of the values with which they are moved.

    Raises:
        ChainError: a frame or joint that the chain does not have, a direction that is no freedom of the joint, or
            the same freedom driven twice. `check_drives` tests whether the number of drives is right.

    >>> print(Mechanism(Chain.parse("R(frame-crank) R(crank-rod) R(rod-piston) P(frame-piston)"), "frame", [0]))
    R(frame-crank) R(crank-rod) R(rod-piston) P(frame-piston); frame=frame; drive=R(frame-crank)

    See Also:
        `Chain`, `Linkage`, `inversions`, `driven_mechanisms`, `decompose`

    Theory:
        docs/theory/mobility.md
    """

    chain: Chain
    frame: str
    drives: tuple[Drive, ...]

    @door_that_raises(ChainError)
    def __init__(self, chain: Chain, frame: str, drives: Iterable[int | str | Drive | DriveMark] = ()) -> None:
        chain.index(frame)
        checked = tuple(_drive(chain, d) for d in drives)
        keys = [(d.joint, d.direction, frozenset(d.between)) for d in checked]
        for k, key in enumerate(keys):
            if key in keys[:k]:
                raise ChainError("the drive {drive} is named twice", drive=_drive_text(chain, checked[k]))
        settle(self, chain=chain, frame=frame, drives=checked)

    @classmethod
    @door_that_raises(ChainError)
    def parse(cls, text: str) -> Mechanism:
        """The mechanism of a text or of a code with a marked frame.

        Without ``frame=`` the first link named is the frame. An ``output=`` is checked and left out. A mark ends at a
        semicolon or with its line.

        >>> Mechanism.parse("D(0-1) D(1-2) D(2-3) D(3-0); drive=D(0-1)").frame
        '0'
        """
        return cls.parse_with_output(text)[0]

    @classmethod
    @door_that_raises(ChainError)
    def parse_with_output(cls, text: str) -> tuple[Mechanism, str | None]:
        """The mechanism of a text, and the link of its mark ``output=``, None without one.

        >>> Mechanism.parse_with_output("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1); output=3")[1]
        '3'
        """
        if text.lstrip().startswith("gr"):
            marked = decode(text.strip())
            if marked.frame is None:
                raise NotationError("the code marks no frame; a mechanism needs one: ...;frame=0")
            return cls(marked.chain, marked.frame, marked.drives), None
        body, *marks = _split_marks(text)
        chain = Chain.parse(body)
        frame, output, drives = chain.links[0], None, []
        for mark in "\n".join(marks).splitlines():
            key, _, value = mark.partition("=")
            match key.strip():
                case "frame":
                    frame = notation.link_name(value.strip())
                case "drive":
                    drives.append(value.strip())
                case "output":
                    output = notation.link_name(value.strip())
                    chain.index(output)
                case _:
                    raise NotationError(
                        "{mark!r} is not a mark of a mechanism: expected frame=LINK, drive=JOINT or output=LINK",
                        mark=mark.strip(),
                    )
        if output == frame:
            raise ChainError("the output {output!r} is the frame", output=output)
        return cls(chain, frame, drives), output

    @classmethod
    @door_that_raises(ChainError)
    def from_json(cls, document: Mapping[str, Any]) -> Mechanism:
        """The mechanism of an object made by `to_json`."""
        chain_document = dict(document)
        frame, drives = chain_document.pop("frame", None), chain_document.pop("drives", [])
        if not isinstance(frame, str) or not isinstance(drives, list) or not all(isinstance(d, str) for d in drives):
            raise NotationError('a mechanism needs a text "frame" and a list of texts "drives"')
        return cls(Chain.from_json(chain_document), frame, drives)

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`: the chain's object with frame and drives."""
        return self.chain.to_json() | {
            "frame": self.frame,
            "drives": list(self.drive_names()),
        }

    @classmethod
    def from_networkx(cls, graph: nx.Graph) -> Mechanism:
        """The mechanism of a graph that `link_graph` or `incidence_graph` gave; see `Chain.from_networkx`.

        Raises `ChainError` for any other graph, one without frame too.
        """
        joints, links, space = graphs.read_graph(graph)
        if "frame" not in graph.graph:
            raise ChainError("the graph has no frame: Chain.from_networkx(graph) takes it")
        drives = _split_marks(str(graph.graph.get("drives", "")))
        chain = Chain(joints, links=links, space=space)
        return cls(chain, str(graph.graph["frame"]), [drive.strip() for drive in drives if drive.strip()])

    def to_networkx(self) -> nx.MultiGraph:
        """The graph of networkx that `from_networkx` takes back: `link_graph`."""
        return self.link_graph()

    def link_graph(self) -> nx.MultiGraph:
        """The graph of the chain (`Chain.link_graph`) with the attributes ``frame`` and ``drives``, as in the text.

        >>> quad = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)")
        >>> quad.link_graph().graph
        {'space': 'planar', 'frame': '0', 'drives': 'R(0-1)'}
        >>> Mechanism.from_networkx(quad.link_graph()) == quad
        True
        """
        return graphs.link_graph(self.chain.links, self.chain.joints, self._marks())

    def incidence_graph(self) -> nx.Graph:
        """The graph of the chain (`Chain.incidence_graph`) with the attributes ``frame`` and ``drives``."""
        return graphs.incidence_graph(self.chain.links, self.chain.joints, self._marks())

    def _marks(self) -> dict[str, str]:
        return {"space": str(self.chain.space), "frame": self.frame, "drives": "; ".join(self.drive_names())}

    def text(self, alphabet: str | Alphabet = Alphabet.INTERNATIONAL) -> str:
        """The text form; `parse` takes it back."""
        marks = [f"frame={notation.link_text(self.frame)}"]
        marks += [f"drive={name}" for name in self.drive_names(alphabet)]
        return "; ".join([self.chain.text(alphabet), *marks])

    __str__ = text

    def __repr__(self) -> str:
        return f"Mechanism.parse({self.text()!r})"

    def drive_names(self, alphabet: str | Alphabet = Alphabet.INTERNATIONAL) -> tuple[str, ...]:
        """Each drive as a text: its joint, with direction and links where the joint alone is ambiguous.

        >>> Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)").drive_names("german")
        ('D(0-1)',)
        """
        return tuple(_drive_text(self.chain, drive, alphabet) for drive in self.drives)

    def renamed(self, names: Mapping[str, str]) -> Mechanism:
        """The same mechanism with other link names; names that the mapping leaves out stay.

        >>> print(Mechanism.parse("R(0-1) R(1-2) R(2-0); drive=R(0-1)").renamed({"0": "base"}))
        R(base-1) R(1-2) R(2-base); frame=base; drive=R(base-1)
        """
        new = {link: names.get(link, link) for link in self.chain.links}
        drives = [replace(d, between=(new[d.between[0]], new[d.between[1]])) for d in self.drives]
        return Mechanism(self.chain.renamed(names), new[self.frame], drives)

    def code(self) -> str:
        """The canonical code: equal exactly for mechanisms of one structure.

        >>> Mechanism.parse("spatial: C(a-b) R(b-c) R(c-a); drive=C(a-b):Tz").code()
        'gr1:spatial:C(0-1)R(0-2)R(1-2);frame=0;drives=0:Tz'
        """
        return code(self.chain, frame=self.frame, drives=[_mark(self.chain, drive) for drive in self.drives])

    @property
    def written_form(self) -> tuple[object, ...]:
        """What it is as it was written: space, links, joints, frame, drives, in this order.

        Equality leaves out the order in which links and joints are written; numbers of joints, columns of arrays and
        the sense of a drive between moving links depend on it. What is kept by them is kept by this.

        >>> one, other = (Mechanism.parse(f"R(0-1) {j} R(2-0); drive={j}") for j in ("R(1-2)", "R(2-1)"))
        >>> one == other, one.written_form == other.written_form
        (True, False)
        """
        return self.chain.space, self.chain.links, self.chain.joints, self.frame, self.drives

    def _identity(self) -> tuple[object, ...]:
        at_joint: dict[int, set[tuple[str, frozenset[str]]]] = {}
        for d in self.drives:
            at_joint.setdefault(d.joint, set()).add((d.direction, frozenset(d.between)))
        # Counted for each joint: of equal joints between the same links one or several may be driven.
        driven = Counter(
            (self.chain.joints[k].pair, frozenset(self.chain.joints[k].links), frozenset(drives))
            for k, drives in at_joint.items()
        )
        return self.chain, self.frame, frozenset(driven.items())


def _split_marks(text: str) -> list[str]:
    """Split at semicolons outside quotes."""
    return re.findall(r'(?:"(?:[^"\\]|\\.)*"|[^;"])+', text) or [text]


def _mark(chain: Chain, drive: Drive) -> int | DriveMark:
    """The mark in a code: the joint, or its driven part where it has several."""
    joint = chain.joints[drive.joint]
    several, multiple = joint.pair.f(chain.space) > 1, joint.count > 1
    if not several and not multiple:
        return drive.joint
    return DriveMark(drive.joint, drive.direction if several else "", drive.between if multiple else ())


def _drive(chain: Chain, raw: int | str | Drive | DriveMark) -> Drive:
    links: tuple[str, ...] = ()
    if isinstance(raw, Drive | DriveMark):
        number, direction, links = raw.joint, raw.direction, raw.between
    elif isinstance(raw, int):
        number, direction = raw, ""
    else:
        number, direction, links = _read_drive(chain, raw)
    joint = chain.joints[chain.joint_number(number)]
    freedoms = joint.pair.freedoms[chain.space]
    if not direction:
        if len(freedoms) > 1:
            raise ChainError(
                "{joint} has the freedoms {freedoms}; say which is driven: {joint}:{first}",
                joint=joint,
                freedoms=", ".join(freedoms),
                first=freedoms[0],
            )
        direction = freedoms[0]
    if direction not in freedoms:
        raise ChainError(
            "{direction!r} is not a freedom of {joint}; it has {freedoms}",
            direction=direction,
            joint=joint,
            freedoms=", ".join(freedoms),
        )
    if not links:
        if len(joint.links) > 2:
            a, b = joint.links[:2]
            raise ChainError(
                "{joint} joins {count} links; say which two the drive moves: {joint}:{a}-{b}",
                joint=joint,
                count=len(joint.links),
                a=a,
                b=b,
            )
        links = joint.links
    if len(links) != 2 or links[0] == links[1] or not set(links) <= set(joint.links):
        raise ChainError(
            "a drive of {joint} acts between two of its links, not between {links}",
            joint=joint,
            links=joined_by_and(links),
        )
    first, other = sorted(links, key=joint.links.index)
    return Drive(number, direction, (first, other))


def _read_drive(chain: Chain, text: str) -> tuple[int, str, tuple[str, ...]]:
    joint_text, *options = re.split(r":(?![^(]*\))", text)
    number = chain.joint_number(joint_text)
    direction = ""
    links: tuple[str, ...] = ()
    for option in options:
        if re.fullmatch(r"[RTH][xyz]", option):
            direction = option
        else:
            links = tuple(notation.split_links(option))
    return number, direction, links


def _drive_text(chain: Chain, drive: Drive, alphabet: str | Alphabet = Alphabet.INTERNATIONAL) -> str:
    joint = chain.joints[drive.joint]
    text = chain.joint_names(alphabet)[drive.joint]
    if joint.pair.f(chain.space) > 1:
        text += f":{drive.direction}"
    if joint.count > 1:
        text += ":" + "-".join(map(notation.link_text, drive.between))
    return text
