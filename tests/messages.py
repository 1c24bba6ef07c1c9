"""The messages in the code, and the gettext catalogs that translate them.

`python -m tests.messages` (make messages) brings every catalog up to date with the code, compiles it and says what
is still to translate. The tests in test_text.py use the same functions.
"""

from __future__ import annotations

import ast
import builtins
import io
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from string import Formatter
from typing import NamedTuple

from babel.messages.catalog import Catalog, Message
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

from gruebler.cli.arguments import rows_of

SOURCES = Path(__file__).parents[1] / "src" / "gruebler"
LOCALE = SOURCES / "base" / "locale"
TEXTS = {"translate": 1, "message": 1, "plural": 2}
"""Functions whose first argument (first two) is a message."""
STEPS = frozenset({"step", "draw", "say", "check"})
"""Methods of constructions and solutions that take a message and the values of its gaps."""
HELP = frozenset({"help", "description", "epilog", "title"})
"""Keywords of argparse whose values are messages."""
TABLES = frozenset({"take", "rows_of"})
"""Functions that take a table of arguments with their helps."""


ARGPARSE = (
    "usage: ",
    "positional arguments",
    "options",
    "show this help message and exit",
    "%(prog)s: error: %(message)s\n",
    "argument %(argument_name)s: %(message)s",
    "the following arguments are required: %s",
    "one of the arguments %s is required",
    "not allowed with argument %s",
    "expected one argument",
    "expected at least one argument",
    "expected at most one argument",
    "invalid choice: %(value)r (choose from %(choices)s)",
    "invalid %(type)s value: %(value)r",
    "ignored explicit argument %r",
    "ambiguous option: %(option)s could match %(matches)s",
)
"""What argparse itself says, found by gettext in our catalog; it comes with Python, not from our sources."""


class Found(NamedTuple):
    """A message in the code."""

    file: str
    line: int
    text: str
    many: str = ""
    context: str = ""


class Unreadable(NamedTuple):
    """A place where a message must stand as a plain string, but something else does."""

    file: str
    line: int
    source: str


def _has_words(text: str) -> bool:
    """Whether there is anything to translate beside the gaps."""
    return any(letter.isalpha() for literal, *_ in Formatter().parse(text) for letter in literal)


def _name(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def _strings(node: ast.expr) -> list[str] | None:
    """The strings that an expression can be: a literal, or a choice of literals."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value]
    if isinstance(node, ast.IfExp):
        one, other = _strings(node.body), _strings(node.orelse)
        return None if one is None or other is None else one + other
    return None


def in_file(path: Path) -> Iterator[Found | Unreadable]:
    """All messages of one source file."""
    file = path.relative_to(SOURCES).as_posix()
    errors = file in {"base/errors.py", "base/text.py"}
    texts = {*TEXTS, *(STEPS if file.startswith(("teaching/constructions/", "teaching/exercises/")) else ())}
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.Call):
            continue
        name = _name(node.func)
        if name == "translate_in_context" and not errors:
            context, text = (_strings(argument) or [""] for argument in node.args[:2])
            yield Found(file, node.lineno, text[0], context=context[0])
        elif name == "plural" and not errors:
            one, many = (_strings(argument) for argument in node.args[:2])
            yield Found(file, node.lineno, (one or [""])[0], (many or [""])[0])
        elif node.args and (name in texts or (name.endswith("Error") and not hasattr(builtins, name) and not errors)):
            strings = _strings(node.args[0])
            if strings is not None:
                yield from (Found(file, node.lineno, text) for text in strings if _has_words(text))
            elif isinstance(node.args[0], ast.JoinedStr | ast.BinOp):
                yield Unreadable(file, node.lineno, ast.unparse(node.args[0]))
        if file.startswith("cli/"):
            yield from _of_arguments(file, node, name)


def _of_arguments(file: str, node: ast.Call, name: str) -> Iterator[Found | Unreadable]:
    """The helps of arguments: in the rows of a table, or among the keywords of argparse."""
    tables = [text for argument in node.args for text in _strings(argument) or ()] if name in TABLES else []
    yield from (Found(file, node.lineno, row.help) for table in tables for row in rows_of(table) if row.help)
    for keyword in node.keywords:
        if keyword.arg in HELP:
            strings = _strings(keyword.value)
            if strings is not None:
                yield from (Found(file, node.lineno, text) for text in strings if _has_words(text))
            elif isinstance(keyword.value, ast.JoinedStr | ast.BinOp):
                yield Unreadable(file, node.lineno, ast.unparse(keyword.value))


@cache
def messages() -> tuple[Found | Unreadable, ...]:
    """All messages of the library, file by file."""
    ours = [entry for path in sorted(SOURCES.rglob("*.py")) for entry in in_file(path)]
    return (
        *ours,
        *(Found("argparse", 0, text) for text in ARGPARSE),
        Found("argparse", 0, "expected %s argument", "expected %s arguments"),
    )


def catalog_path(lang: str) -> Path:
    """Where the catalog of a language stands."""
    return LOCALE / lang / "LC_MESSAGES" / "gruebler.po"


def read(lang: str) -> Catalog:
    """The catalog of a language."""
    with catalog_path(lang).open("rb") as file:
        return read_po(file, locale=lang)


def compiled(catalog: Catalog) -> bytes:
    """The catalog as gettext reads it."""
    out = io.BytesIO()
    write_mo(out, catalog)
    return out.getvalue()


def updated(old: Catalog, lang: str) -> Catalog:
    """A catalog with all messages of the code and no other, with the translations there are."""
    new = Catalog(locale=lang, project="gruebler", header_comment=old.header_comment, fuzzy=False)
    new.mime_headers = old.mime_headers
    new.last_translator, new.language_team, new.msgid_bugs_address = "The gruebler maintainers", "German", ""
    new.creation_date = new.revision_date = old.creation_date  # the same texts make the same file at any time
    for entry in messages():
        if isinstance(entry, Found):
            key = (entry.text, entry.many) if entry.many else entry.text
            known = old.get(entry.text, entry.context or None)
            string = known.string if known else ""
            new.add(key, string, locations=[(entry.file, 0)], context=entry.context or None)
    return new


def is_translated(entry: Message) -> bool:
    """Whether all forms of a message have a translation: a missing plural is a pair of empty texts."""
    return all([entry.string] if isinstance(entry.string, str) else entry.string or [""])


def main() -> None:
    """Update and compile all catalogs."""
    for path in sorted(LOCALE.glob("*/LC_MESSAGES/gruebler.po")):
        lang = path.parts[-3]
        catalog = updated(read(lang), lang)
        with path.open("wb") as file:
            write_po(file, catalog, width=120, include_lineno=False)
        path.with_suffix(".mo").write_bytes(compiled(catalog))
        missing = [entry.id for entry in catalog if entry.id and not is_translated(entry)]
        print(f"{lang}: {len(catalog)} messages, {len(missing)} to translate")
        for text in missing[:20]:
            print("   ", text if isinstance(text, str) else text[0])


if __name__ == "__main__":
    main()
