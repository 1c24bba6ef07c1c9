"""The text of a chain: ``R(frame-crank) R(crank-rod) P(frame-piston)``, read and written.

    text   = [ space ":" ] joint { [","] joint }
    joint  = symbol "(" link "-" link { "-" link } ")"
    link   = bare name | "quoted name"

A joint of more than two links is a multiple joint. A bare name has no blank, hyphen, bracket, comma, colon,
semicolon or quote; any other name is written in double quotes with JSON's escapes. The space is ``planar``
unless a prefix says otherwise.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping, Sequence

from gruebler.base.errors import NotationError, PairError
from gruebler.base.text import LANGUAGES, Message, message
from gruebler.structure.chain.pairs import PAIRS, Alphabet, Pair
from gruebler.structure.chain.spaces import Space
from gruebler.structure.chain.symbols import read_symbols

_BARE = r"""[^\s()\-",:;]+"""
_NAME = rf'(?:"(?:[^"\\]|\\.)*"|{_BARE})'
_SYMBOL = re.compile(r"\s*[,;]?\s*([^\W\d]\w*)\s*\(\s*")
_LINK = re.compile(rf"({_NAME})\s*")
_BLANKS = re.compile(r"\s*")
_IN_JOINT = re.compile(rf"(?<=[(-])\s*({_NAME})\s*(?=[-)])")
_PREFIX = re.compile(r"\s*([a-z]\w*)\s*:", re.IGNORECASE)


def space_of(name: str | Space) -> Space:
    """The space of this name; `NotationError` for any other name.

    >>> space_of("planar").b
    3
    """
    try:
        return Space(name)
    except ValueError:
        raise NotationError("unknown space {word!r}: expected planar, spherical or spatial", word=name) from None


def read_joints(text: str, space: str | Space | None = None) -> tuple[Space, list[tuple[Pair, tuple[str, ...]]]]:
    """The space and the joints (pair, link names) that a text describes, in its order.

    >>> read_joints("R(0-1) R(1-2) R(2-0)")[1][0]
    (<pair revolute>, ('0', '1'))

    Raises `NotationError` with the position of the first error, `PairError` for an unsuitable symbol.
    """
    where, position = _read_space(text, space)
    joints: list[tuple[str, tuple[str, ...]]] = []
    end = len(text.rstrip())
    while position < end:
        symbol, links, position = _read_joint(text, position)
        joints.append((symbol, links))
    if not joints:
        raise NotationError(
            "the text names no joint; write for example R(frame-crank) R(crank-rod) R(rod-rocker) R(rocker-frame)"
        )
    pairs = read_symbols((symbol for symbol, _ in joints), where)
    return where, [(pairs[symbol], links) for symbol, links in joints]


def _read_space(text: str, space: str | Space | None) -> tuple[Space, int]:
    prefix = _PREFIX.match(text)
    requested = None if space is None else space_of(space)
    if prefix is None:
        return requested or Space.PLANAR, 0
    written = _space_in_any_language(prefix[1].lower())
    if requested is not None and requested is not written:
        raise NotationError(
            "the text says {written}, but {wanted} was asked for", written=written.adjective, wanted=requested.adjective
        )
    return written, prefix.end()


def _space_in_any_language(word: str) -> Space:
    named = (space for space in Space for lang in LANGUAGES if space.adjective.in_language(lang) == word)
    return next(named, None) or space_of(word)


def _read_joint(text: str, position: int) -> tuple[str, tuple[str, ...], int]:
    head = _SYMBOL.match(text, position)
    if head is None:
        raise _unreadable(text, position, message("a joint such as R(frame-crank)"))
    position = head.end()
    links = []
    while True:
        name = _LINK.match(text, position)
        if name is None:
            raise _unreadable(text, position, message("the name of a link"))
        links.append(_unquoted(name[1]))
        position = name.end()
        separator = text[position : position + 1]
        if separator == ")":
            return head[1], tuple(links), position + 1
        if separator != "-":
            raise _unreadable(text, position, message("'-' and another link, or ')'"))
        position = _BLANKS.match(text, position + 1).end()  # type: ignore[union-attr]  # it matches anywhere


def link_name(text: str) -> str:
    """The link that a bare or quoted name denotes.

    >>> link_name('"lower wishbone"')
    'lower wishbone'
    """
    if not re.fullmatch(_NAME, text):
        raise NotationError(
            "expected the name of a link, bare or in double quotes, but found {name!r}", name=_shortened(text)
        )
    return _unquoted(text)


def split_links(text: str) -> list[str]:
    """The links of ``a-b-"c d"``; an empty list if the text is not of that form.

    >>> split_links('a-b-"c-d"')
    ['a', 'b', 'c-d']
    """
    if not re.fullmatch(rf"\s*{_NAME}\s*(?:-\s*{_NAME}\s*)*", text):
        return []
    return [_unquoted(name) for name in re.findall(_NAME, text)]


def _unquoted(name: str) -> str:
    if not name.startswith('"'):
        return name
    try:
        return str(json.loads(name))
    except json.JSONDecodeError as error:
        raise NotationError("the quoted name {name} is not valid: {reason}", name=name, reason=error.msg) from None


def _unreadable(text: str, position: int, expected: Message) -> NotationError:
    remainder = text[position:].strip()
    position = len(text) - len(text[position:].lstrip())
    return NotationError(
        "expected {expected} at character {position}, but found {found!r}"
        if remainder
        else "expected {expected} at character {position}, but the text ends",
        expected=expected,
        position=position + 1,
        found=_shortened(remainder),
    )


def _shortened(text: str) -> str:
    return text if len(text) <= 30 else text[:30] + "..."


def link_text(name: str) -> str:
    """A link's name as a text writes it: bare where possible, else quoted.

    >>> link_text("crank"), link_text("lower wishbone")
    ('crank', '"lower wishbone"')
    """
    return name if re.fullmatch(_BARE, name) else json.dumps(name, ensure_ascii=False)


def renamed_links(text: str, names: Mapping[str, str]) -> str:
    """A link, the joints of a chain, a driven freedom, or a point ``LINK:X,Y``, with other names for the links.

    >>> renamed_links("R(a-b) R(b-c)", {"a": "base plate", "b": "arm"}), renamed_links("b:5,-2", {"b": "arm"})
    ('R("base plate"-arm) R(arm-c)', 'arm:5,-2')
    """
    if text in names:
        return names[text]
    start, colon, end = text.rpartition(":")
    if colon and start in names:
        return f"{names[start]}:{end}"
    if colon and start.endswith(")") and (links := split_links(end)) and not set(links) - set(names):
        text = f"{start}:{'-'.join(link_text(names[link]) for link in links)}"  # the driven part of a multiple joint

    def name(match: re.Match[str]) -> str:
        link = _unquoted(match[1])
        return link_text(names[link]) if link in names else match[0]

    return _IN_JOINT.sub(name, text)


def symbols_for(pairs: Iterable[Pair], space: Space, alphabet: Alphabet = Alphabet.INTERNATIONAL) -> dict[Pair, str]:
    """How to write each of these pairs in one text so that `read` takes it back.

    Symbols of the alphabet where the text as a whole is unambiguous; otherwise the full name for each pair whose
    symbol has another meaning.

    >>> from gruebler.structure.chain.pairs import pair
    >>> symbols_for([pair("spherical"), pair("revolute")], Space.SPATIAL)
    {<pair spherical>: 'S', <pair revolute>: 'R'}
    >>> symbols_for([pair("spherical")], Space.SPATIAL)
    {<pair spherical>: 'spherical'}
    """
    letters = {p: p.symbol(alphabet) for p in pairs}
    try:
        meanings = read_symbols(letters.values(), space)
    except PairError:
        meanings = {}
    if all(meanings.get(letter) == p for p, letter in letters.items()):
        return letters
    return {p: letter if _only_meaning(letter, p, space) else p.name for p, letter in letters.items()}


def _only_meaning(letter: str, pair: Pair, space: Space) -> bool:
    return all(p == pair for p in PAIRS if space in p.freedoms and letter in p.symbols.values())


def joint_text(symbol: str, links: Sequence[str]) -> str:
    """One joint as a text writes it.

    >>> joint_text("R", ["frame", "lower arm"])
    'R(frame-"lower arm")'
    """
    return f"{symbol}({'-'.join(map(link_text, links))})"


def write_joints(
    space: Space,
    joints: Sequence[tuple[Pair, Sequence[str]]],
    alphabet: Alphabet = Alphabet.INTERNATIONAL,
) -> str:
    """The text of these joints, such that `read` gives them back.

    >>> write_joints(*read_joints("D(0-1) D(1-2) S(2-0)"))
    'R(0-1) R(1-2) P(2-0)'
    """
    symbols = symbols_for((pair for pair, _ in joints), space, alphabet)
    prefix = "" if space is Space.PLANAR else f"{space.adjective.in_language(alphabet.language)}: "
    return prefix + " ".join(joint_text(symbols[pair], links) for pair, links in joints)
