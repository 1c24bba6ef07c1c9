"""The name of a group's form, and its class.

Definitions and sources: docs/theory/assur.md, "Form, class, order".
"""

from __future__ import annotations

import re
from collections import Counter, deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from gruebler.structure.chain.pairs import PAIRS, Alphabet, Pair, SymbolText, in_alphabets
from gruebler.structure.chain.spaces import Space

DYADS = ("RRR", "RRP", "RPR", "PRP", "RPP")
"""The five dyads: outer, inner, outer joint. RRP and PRR are one form, RPP and PPR another; PPP is not rigid."""


_Vertex = tuple[str, int]  # a link or a joint, with its number


@dataclass(frozen=True, slots=True)
class GroupJoint:
    """A joint of a group: its pair, the links of the group that carry it, whether links outside carry it too."""

    pair: Pair
    links: tuple[int, ...]
    outer: bool


# In the order in which they are named; a letter of the German alphabet where the international one has none.
_PAIRS = {
    p.symbols.get(Alphabet.INTERNATIONAL, p.symbols[Alphabet.GERMAN]): p for p in PAIRS if Space.PLANAR in p.freedoms
}
_LETTERS = {p.name: letter for letter, p in _PAIRS.items()}
_GERMAN = str.maketrans({letter: p.symbol(Alphabet.GERMAN) for letter, p in _PAIRS.items() if len(letter) == 1})
_RANK = {letter: k for k, letter in enumerate(_PAIRS)}


def form_name(links: int, joints: Sequence[GroupJoint], alphabet: Alphabet = Alphabet.INTERNATIONAL) -> str | None:
    """The name of the form, or None where a form has only a code.

    One link: its joints. Two links: the outer joints of one, the joints between, the outer joints of the other. A link
    that carries the inner ends of binary legs: the legs, each from outside inward, with the link's own outer joints.
    """
    if any(len(j.links) + j.outer != 2 for j in joints):
        return None
    outer: list[list[str]] = [[] for _ in range(links)]
    inner: dict[tuple[int, int], list[str]] = {}
    for joint in joints:
        letter = _LETTERS[joint.pair.name]
        if joint.outer:
            outer[joint.links[0]].append(letter)
        else:
            a, b = sorted(joint.links)
            inner.setdefault((a, b), []).append(letter)
    if links <= 2:
        between = _sorted(inner.get((0, 1), []))
        ends = [_sorted(outer_letters) for outer_letters in outer]
        groups = [ends[0], between, ends[1]] if links == 2 else ends
        groups = min(groups, groups[::-1], key=lambda some: [[_RANK[x] for x in group] for group in some])
        return _joined(groups, alphabet)
    return _star(outer, inner, alphabet)


def _joined(groups: Sequence[Sequence[str]], alphabet: Alphabet) -> str:
    simple = all(len(group) == 1 for group in groups)
    return ("" if simple else "-").join("".join(_PAIRS[x].symbols.get(alphabet, x) for x in group) for group in groups)


def _sorted(letters: Iterable[str]) -> list[str]:
    return sorted(letters, key=_RANK.__getitem__)


def _star(outer: list[list[str]], inner: dict[tuple[int, int], list[str]], alphabet: Alphabet) -> str | None:
    hubs = set.intersection(*map(set, inner)) if inner else set()
    if len(hubs) != 1:
        return None
    hub = hubs.pop()
    legs: Counter[tuple[str, str]] = Counter()
    for (a, b), letters in inner.items():
        outer_letters = outer[a + b - hub]
        if len(letters) != 1 or len(outer_letters) != 1:
            return None
        legs[outer_letters[0], letters[0]] += 1
    if legs.total() != len(outer) - 1:
        return None
    parts = [
        (f"{number}-" if number > 1 else "") + "".join(_PAIRS[x].symbols.get(alphabet, x) for x in leg)
        for leg, number in sorted(legs.items(), key=lambda item: [_RANK[x] for x in item[0]])
    ]
    return "+".join(parts + [_PAIRS[x].symbols.get(alphabet, x) for x in _sorted(outer[hub])])


def form_message(form: str) -> SymbolText:
    """The name of a form for a message, in the alphabet of the reader; a code or a joint's name is kept.

    >>> form_message("2-RR+P").in_language("de"), form_message("c1:0").in_language("de")
    ('2-DD+S', 'c1:0')
    """
    named = re.fullmatch(rf"(?:{'|'.join(_PAIRS)}|[0-9+-])+", form) is not None
    german = form.translate(_GERMAN) if named else form
    return in_alphabets(lambda alphabet: german if alphabet is Alphabet.GERMAN else form)


def class_number(links: int, joints: Sequence[GroupJoint]) -> int:
    """The class: the most joints of a contour, at least 2.

    A contour is a link with its inner joints, or a closed loop of inner joints that is not composed of shorter ones.
    Roll-slide joints and double slides count as the binary links that replace them.
    """
    inner = _inner_joints(links, joints)
    carried = Counter(link for joint in inner for link in joint)
    return max(2, *carried.values(), _longest_contour(inner)) if inner else 2


def _inner_joints(links: int, joints: Sequence[GroupJoint]) -> list[tuple[int, ...]]:
    """The links of each inner joint, with every joint of two freedoms replaced by a link with two joints."""
    joint_links: list[tuple[int, ...]] = []
    next_link = links
    for joint in joints:
        if joint.pair.u(Space.PLANAR) == 2:
            if not joint.outer:
                joint_links.append(joint.links)
            continue
        hub, *others = joint.links
        for other in [*others, None] if joint.outer else others:
            joint_links.append((hub, next_link))
            if other is not None:
                joint_links.append((next_link, other))
            next_link += 1
    return joint_links


def _longest_contour(inner: Sequence[tuple[int, ...]]) -> int:
    """The longest loop of a minimum cycle basis, in joints: all such bases have the same lengths.

    Loops are sets of (link, joint) incidences, one bit each, in the graph of links and joints. Candidates (Horton
    1987): for each vertex, the loops that edges close with a tree of shortest paths from it. Any loop through the
    vertex is a sum of such candidates that are no longer than itself, so the shortest independent ones are a basis.
    """
    near: dict[_Vertex, list[tuple[_Vertex, int]]] = {}
    ends: list[tuple[_Vertex, _Vertex, int]] = []
    for number, links in enumerate(inner):
        for link in links:
            bit = 1 << len(ends)
            link_vertex, joint_vertex = ("link", link), ("joint", number)
            near.setdefault(link_vertex, []).append((joint_vertex, bit))
            near.setdefault(joint_vertex, []).append((link_vertex, bit))
            ends.append((link_vertex, joint_vertex, bit))
    parts, candidates = 0, set()
    visited: set[_Vertex] = set()
    for start in near:
        path = _paths(near, start)
        if start not in visited:
            parts += 1
            visited |= set(path)
        for link_vertex, joint_vertex, bit in ends:
            if link_vertex in path:
                candidates.add(path[link_vertex] ^ path[joint_vertex] ^ bit)
    dimension = len(ends) - len(near) + parts
    basis: list[int] = []
    longest = 0
    for loop in sorted(candidates, key=lambda loop: (loop.bit_count(), loop)):
        if len(basis) == dimension:
            break
        remainder = loop
        for member in basis:
            remainder = min(remainder, remainder ^ member)
        if remainder:  # an edge of the tree closes no loop
            basis = sorted([*(min(member, member ^ remainder) for member in basis), remainder], reverse=True)
            longest = loop.bit_count() // 2
    return longest


def _paths(near: dict[_Vertex, list[tuple[_Vertex, int]]], start: _Vertex) -> dict[_Vertex, int]:
    """A shortest path to every vertex that can be reached, as the set of its incidences."""
    path = {start: 0}
    queue = deque([start])
    while queue:
        vertex = queue.popleft()
        for neighbour, bit in near[vertex]:
            if neighbour not in path:
                path[neighbour] = path[vertex] | bit
                queue.append(neighbour)
    return path


def roman(number: int) -> str:
    """The number in Roman figures, as classes are written.

    >>> [roman(k) for k in (2, 3, 4, 9)]
    ['II', 'III', 'IV', 'IX']
    """
    figures = ""
    for value, figure in ((10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I")):
        figures += figure * (number // value)
        number %= value
    return figures
