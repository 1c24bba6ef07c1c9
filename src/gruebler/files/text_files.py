"""Text files of other programs, read with care: never more than a limit, in a known encoding, no XML entities."""

from __future__ import annotations

from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from gruebler.base.errors import GrueblerError, naming
from gruebler.base.text import reason_of

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

LARGEST = 2_000_000
"""Bytes of a file; drawings of a thousand links fit."""
_DEEPEST = 100  # elements within elements


def read_text(path: Path, largest: int = LARGEST, kind: type[GrueblerError] = GrueblerError) -> str:
    """The text of a file, UTF-8 or UTF-16 with a byte order mark.

    Raises an error of the kind given, which names the file, if it cannot be read, is too large, empty or not such text.
    """
    with naming(path, kind):
        try:
            with path.open("rb") as file:
                content = file.read(largest + 1)
        except OSError as error:
            raise GrueblerError("cannot be read ({reason})", reason=reason_of(error)) from None
        if len(content) > largest:
            raise GrueblerError("larger than {limit:,} bytes", limit=largest)
        encoding = "utf-16" if content[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            raise GrueblerError("is not UTF-8 text") from None
        if not text.strip():
            raise GrueblerError("is empty")
    return text


def parse_xml(text: str) -> Element:
    """The root of an XML document without document type: no entity is expanded, nothing is fetched.

    Raises `GrueblerError` for what is not XML, has a document type, or is nested too deeply.

    >>> parse_xml("<a><b c='1'/></a>")[0].attrib
    {'c': '1'}
    >>> parse_xml("<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>")
    Traceback (most recent call last):
    gruebler.base.errors.GrueblerError: a document type (DOCTYPE) is not allowed here
    """
    from xml.etree.ElementTree import TreeBuilder
    from xml.parsers import expat

    builder = TreeBuilder()
    parser = expat.ParserCreate()
    depth = 0

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > _DEEPEST:
            raise GrueblerError("is nested too deeply")
        builder.start(tag, attributes)

    def end(tag: str) -> None:
        nonlocal depth
        depth -= 1
        builder.end(tag)

    def refuse(*_: object) -> None:
        raise GrueblerError("a document type (DOCTYPE) is not allowed here")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = builder.data
    parser.StartDoctypeDeclHandler = refuse
    parser.EntityDeclHandler = refuse
    try:
        parser.Parse(text, True)  # a text, so that no declared encoding counts
    except expat.ExpatError as error:
        raise GrueblerError("is not XML: {reason}", reason=error) from None
    return builder.close()


def read_number(text: str, what: object) -> float:
    """A finite number; `GrueblerError` that says what it is otherwise.

    >>> read_number("1e400", "x")
    Traceback (most recent call last):
    gruebler.base.errors.GrueblerError: x: expected a number, but found '1e400'
    """
    try:
        value = float(text) if len(text) <= _LONGEST else float("nan")
    except ValueError:
        value = float("nan")
    if not isfinite(value):
        raise GrueblerError("{what}: expected a number, but found {text!r}", what=what, text=text)
    return value


_LONGEST = 100  # characters of a number
