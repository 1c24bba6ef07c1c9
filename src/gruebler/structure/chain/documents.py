"""Chains read from graph6 codes and from JSON."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

from gruebler.base.errors import NotationError
from gruebler.structure.chain import notation
from gruebler.structure.chain.spaces import Space

MOST_LINKS = 5000
"""Links of a chain in a code or a graph file: a few letters can announce any number of them."""
MOST_JOINTS = 50_000
"""Joints of such a chain."""

Joints = list[tuple[str, Sequence[str]]]


def check_size(links: int, joints: int) -> None:
    """`NotationError` for more links or joints than a code or a graph file may have."""
    if links > MOST_LINKS:
        raise NotationError("a chain here has at most {most:,} links, not {count:,}", count=links, most=MOST_LINKS)
    if joints > MOST_JOINTS:
        raise NotationError("a chain here has at most {most:,} joints, not {count:,}", count=joints, most=MOST_JOINTS)


def links_of_code(code: str) -> int:
    """The number of nodes that a graph6 or sparse6 code begins with: one letter, or three behind ~, or six behind ~~.

    Format: B. D. McKay, Description of graph6, sparse6 and digraph6 encodings. Six bits a letter; 0 where a code ends
    too early.

    >>> [links_of_code(code) for code in ("C", "~?@?", "~~?????@")]
    [4, 64, 1]
    """
    tildes = 2 if code.startswith("~~") else int(code.startswith("~"))
    letters = code[tildes : tildes + (1, 3, 6)[tildes]]
    return sum((ord(letter) - 63) << 6 * place for place, letter in enumerate(reversed(letters)))


def read_graph6(code: str) -> tuple[Joints, list[str]]:
    """Revolute joints and links of a graph6 code; `NotationError` for one that is none, or too large."""
    import networkx as nx  # imported only here: the import takes longer than most computations

    check_size(links_of_code(code), sum((ord(letter) - 63).bit_count() for letter in code[8:]))
    try:
        graph = nx.from_graph6_bytes(code.encode("ascii"))
    except UnicodeEncodeError:
        raise NotationError("{code!r} is not a graph6 code: it has letters beyond ASCII", code=code) from None
    except IndexError:
        raise NotationError("{code!r} is not a graph6 code: it ends too early", code=code) from None
    except (nx.NetworkXError, ValueError) as error:
        raise NotationError("{code!r} is not a graph6 code: {error}", code=code, error=error) from None
    order = [str(v) for v in range(graph.number_of_nodes())]
    return [("revolute", (str(a), str(b))) for a, b in sorted(graph.edges)], order


def read_document(document: str | Mapping[str, Any]) -> tuple[Joints, Sequence[str] | None, str | Space]:
    """Joints, links and space of a JSON document, the text or the object already read.

    Joints are objects, or texts such as ``"R(a-b)"``. Of a mobility report (recognised by its verdict) only the chain
    is read: everything else is derived from it.
    """
    if isinstance(document, str):
        try:
            document = json.loads(document)
        except json.JSONDecodeError as error:
            raise NotationError("not a JSON document: {error}", error=error) from None
    if not isinstance(document, Mapping):
        raise NotationError("a chain is a JSON object, not {name}", name=type(document).__name__)
    if "verdict" in document:
        document = {key: document[key] for key in ("space", "links", "joints") if key in document}
    unknown = sorted(set(document) - {"space", "links", "joints"})
    if unknown:
        raise NotationError("unknown key {unknown!r} in a chain: expected space, links, joints", unknown=unknown[0])
    joints = document.get("joints")
    if not isinstance(joints, Sequence) or isinstance(joints, str):
        raise NotationError('a chain needs a list under "joints"')
    links = document.get("links")
    if links is not None and (not isinstance(links, Sequence) or isinstance(links, str)):
        raise NotationError('"links" must be a list of names')
    space = document.get("space", Space.PLANAR)
    if joints and all(isinstance(joint, str) for joint in joints):
        return _joints_of_texts(joints, space), links, space
    checked = [_joint_of_json(number, j) for number, j in enumerate(joints, 1)]
    return checked, links, space


def _joints_of_texts(texts: Sequence[str], space: str | Space) -> Joints:
    """The joints of ``R(a-b)``, ``R(a-b)#2``, ..., as `Chain.joint_names` writes them."""
    bare = [re.sub(r"\)#\d+$", ")", text) for text in texts]
    return [(pair.name, names) for pair, names in notation.read_joints(" ".join(bare), space)[1]]


def _joint_of_json(number: int, document: object) -> tuple[str, Sequence[str]]:
    match document:
        case {"pair": str(kind), "links": [*links], **rest} if not rest and all(
            isinstance(link, str) for link in links
        ):
            return kind, [str(link) for link in links]
    raise NotationError(
        'joint {number} must be an object with a text "pair" and a list of names "links"', number=number
    )
