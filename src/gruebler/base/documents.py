"""Files of plain data, read with care: TOML and JSON, then into records that know their keys."""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from itertools import zip_longest
from pathlib import Path
from typing import Any, NoReturn, TypeVar

import msgspec

from gruebler.base.errors import near_words, visible
from gruebler.base.text import Message, joined_by_or, message, reason_of

Failing = Callable[[Message], Exception]
"""Makes the exception of a message; the errors of the library are such makers themselves."""

Record = TypeVar("Record", bound=msgspec.Struct)

LARGEST = 1_000_000
"""Bytes of a file; a chain of thousands of links fits."""
_DOTS = 100  # in one line of TOML: the parts of a dotted key cost the square of their number


def load_document(path: Path, fail: Failing) -> Any:
    """The content of a ``.json`` file, or of any other as TOML; ``fail`` makes the exception for one that cannot be."""
    form = "JSON" if path.suffix.lower() == ".json" else "TOML"
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except OSError as error:
        raise fail(message("cannot be read ({reason})", reason=reason_of(error))) from None
    if len(content) > LARGEST:
        raise fail(message("larger than {limit:,} bytes", limit=LARGEST))
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise fail(message("is not UTF-8 text")) from None
    if not text.strip():
        raise fail(message("is empty"))
    if form == "TOML" and any(line.count(".") > _DOTS for line in text.splitlines()):
        raise fail(message("is nested too deeply: a line has more than {limit} dots", limit=_DOTS))
    try:
        if form == "TOML":
            document = tomllib.loads(text.replace("\r\n", "\n"))
        else:
            document = json.loads(text, parse_constant=_no_number, object_pairs_hook=_once)
    except RecursionError:
        raise fail(message("is nested too deeply")) from None
    except ValueError as error:  # also a number of thousands of digits
        raise fail(message("is not {form}: {reason}", form=form, reason=error)) from None
    strange = next((each for each in _texts(document) if visible(each, "\n\t") != each), None)
    if strange is not None:
        raise fail(message("the text {text!r} has control characters", text=strange))
    return document


def _texts(data: Any) -> Iterator[str]:
    """All texts of plain data, its keys included."""
    waiting = [data]
    while waiting:
        each = waiting.pop()
        if isinstance(each, str):
            yield each
        elif isinstance(each, dict):
            waiting += [*each, *each.values()]
        elif isinstance(each, list):
            waiting += each


def _no_number(word: str) -> NoReturn:
    raise ValueError(f"{word} is not a number")


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) < len(pairs):
        # The dictionary has each key where it stands first: the two part where one comes again.
        twice = next(pair[0] for pair, key in zip_longest(pairs, table) if pair[0] != key)
        raise ValueError(f"the key {twice!r} stands twice in one object")
    return table


def infinities_as_words(data: Any) -> Any:
    """Plain data as JSON can hold it: an infinite number is the text ``"inf"`` or ``"-inf"``; O(size).

    JSON has no infinity. Readers take the text back wherever a number may be infinite (the radius of a flat contour).

    >>> infinities_as_words({"radii": [0, float("inf")]})
    {'radii': [0, 'inf']}
    """
    if isinstance(data, Mapping):
        return {key: infinities_as_words(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [infinities_as_words(value) for value in data]
    return str(data) if isinstance(data, float) and math.isinf(data) else data


def convert_document(data: object, kind: type[Record], fail: Failing, where: str = "") -> Record:
    """The record of plain data; ``fail`` gets the first key that does not fit, with ``where`` in front.

    >>> class Size(msgspec.Struct, forbid_unknown_fields=True):
    ...     width: float
    >>> convert_document({"width": 3}, Size, ValueError)
    Size(width=3.0)
    >>> convert_document({"widht": 3}, Size, ValueError)
    Traceback (most recent call last):
        ...
    ValueError: unknown key 'widht'; did you mean 'width'?
    """
    if not isinstance(data, Mapping):
        problem = message("expected a table of keys")
        raise fail(message("{key}: {problem}", key=where, problem=problem) if where else problem)
    prefix = f"{where}." if where else ""
    _refuse_strange_keys(data, kind, fail, prefix)
    try:
        return msgspec.convert(data, kind)
    except msgspec.ValidationError as error:
        raise fail(_readable(str(error), data, kind, prefix)) from None


_KINDS = {
    "int": message("a whole number"),
    "float": message("a number"),
    "str": message("a text"),
    "bool": message("true or false"),
    "array": message("a list"),
    "object": message("a table of keys"),
}


_EXPECTED = message("expected {wanted}, but found {found}")
_MEASURED = message("expected {wanted} without a unit, but found {found}")


def _readable(error: str, data: object, kind: type[msgspec.Struct], prefix: str) -> Message:
    """Msgspec's message in the words of the file, with the key in front: ``claims.n: expected a whole number, ...``."""
    match = re.fullmatch(r"(.*?)(?: - at `\$\.?(.*)`)?", error, re.DOTALL)
    assert match is not None  # the second group is optional
    problem, path = match[1], match[2] or ""
    key, word = (prefix + path).rstrip("."), _word_at(data, path)
    if parts := re.fullmatch(r"Expected `([\w |]*)`, got `(\w+)`", problem):
        wanted = [_KINDS[name] for name in parts[1].split(" | ") if name in _KINDS]
        measured = _KINDS["str"] not in wanted and re.match(r"'[-+.]?\d", str(word))  # such as "20 mm"
        text = (_MEASURED if measured else _EXPECTED).filled(
            wanted=joined_by_or(wanted), found=word or _KINDS.get(parts[2], parts[2])
        )
    elif parts := re.fullmatch(r"Expected `array` of length (\d+), got (\d+)", problem):
        text = message("expected {count} values, but found {found}", count=parts[1], found=parts[2])
    elif parts := re.fullmatch(r"Object missing required field `([^`]*)`", problem):
        text = message("the key {key!r} is missing", key=parts[1])
    elif choices := _choices(kind, path):
        text = _EXPECTED.filled(wanted=joined_by_or(choices), found=word)
    else:
        text = message("{problem}", problem=problem[:1].lower() + problem[1:].replace("`", ""))
    return message("{key}: {problem}", key=key, problem=text) if key else text


def _word_at(value: Any, path: str) -> str:
    """The word at the path of an error, as it stands in a file; nothing where there is more than a word."""
    for name, number in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path):
        value = value[int(number)] if number else value.get(name) if isinstance(value, Mapping) else None
    if isinstance(value, bool):
        return str(value).lower()
    return repr(value) if isinstance(value, str | int | float) else ""


def _choices(kind: type[msgspec.Struct], path: str) -> list[str]:
    """The words between which a key has to choose."""
    records, hint = [kind], None
    for name in re.findall(r"[^.\[\]\d]+", path):
        hint = next((_fields(record)[name] for record in records if name in _fields(record)), None)
        records = _records_within(hint)
    return [repr(part) for part in _parts_of(hint) if isinstance(part, str)]


def _parts_of(hint: Any) -> Iterator[Any]:
    """A type, and all of which it is made."""
    yield hint
    for part in getattr(hint, "__args__", ()):
        yield from _parts_of(part)


@cache
def _fields(kind: type[msgspec.Struct]) -> dict[str, Any]:
    return {field.name: field.type for field in msgspec.structs.fields(kind)}


def _refuse_strange_keys(data: Mapping[str, Any], kind: type[msgspec.Struct], fail: Failing, prefix: str) -> None:
    fields = _fields(kind)
    for key, value in data.items():
        if key not in fields:
            close = near_words(key, fields)
            raise fail(
                message(
                    "unknown key {key!r}; did you mean {nearest!r}?"
                    if close
                    else "unknown key {key!r}; the keys here are {known}",
                    key=prefix + key[:50],
                    nearest="".join(close),
                    known=", ".join(fields),
                )
            )
        for inner in _records_within(fields[key]):
            values = value if isinstance(value, list) else [value]
            for record in values:
                if isinstance(record, Mapping):
                    _refuse_strange_keys(record, inner, fail, f"{prefix}{key}.")


def _records_within(annotation: Any) -> list[type[msgspec.Struct]]:
    return [part for part in _parts_of(annotation) if isinstance(part, type) and issubclass(part, msgspec.Struct)]
