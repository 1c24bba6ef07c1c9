"""Reference pages made from the library: names with their docstrings, commands from their parsers, file formats.

A line `<!-- insert: KIND ARGUMENT -->` of a page is replaced before the page is parsed.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import msgspec

from builder.names import documented_rooms, front_door_table, room_page
from gruebler.base.text import translate
from gruebler.cli.commands import GROUPS, Command
from gruebler.files.catalog_records import Entry, Exercise
from gruebler.files.linkages import LinkageRecord
from gruebler.files.values import FORMATS

_RECORDS = {"linkage": LinkageRecord, "entry": Entry, "exercise": Exercise}
_PLACE = re.compile(r"^<!-- insert: ([a-z-]+) ?(.*) -->$", re.MULTILINE)


def command_reference(lang: str, _: str) -> str:
    """All commands by group: usage, arguments, options, examples."""
    return "\n".join(line for title, commands in GROUPS for line in _group(title.in_language(lang), commands, lang))


def _group(title: str, commands: tuple[Command, ...], lang: str) -> Iterator[str]:
    yield f"\n## {title}\n"
    for each in commands:
        parser = each.parser(lang)
        yield f"\n### {each.name}\n"
        yield from _parser(parser, lang)
        for action in parser._actions:
            if isinstance(action, argparse._SubParsersAction):
                for name, below in action.choices.items():
                    yield f"\n#### {each.name} {name}\n"
                    yield from _parser(below, lang)


def _parser(parser: Any, lang: str) -> Iterator[str]:
    parser.translate_placeholders()
    if parser.description:
        yield _text(translate(parser.description, lang)) + "\n"
    yield f"```text\n{parser.format_usage().split(': ', 1)[1].rstrip()}\n```\n"
    for action in parser._actions:
        if action.help in {argparse.SUPPRESS, None} or action.dest in {"help", "lang"}:
            continue
        formatter = parser._get_formatter()
        invocation = formatter._format_action_invocation(action)
        text = formatter._expand_help(action)
        yield f"`{invocation}`\n: {_text(' '.join(text.split()))}\n"
    if parser.epilog:
        yield from _epilog(translate(parser.epilog, lang), "Rückgabewert" if lang == "de" else "Exit status")


def _epilog(text: str, status: str) -> Iterator[str]:
    """The text after the options, its examples as a block."""
    examples, dot, rest = text.partition(f". {status}")
    _, colon, commands = examples.partition(": ")
    if not dot and status not in text and colon:
        commands, rest = commands.rstrip("."), ""
    if colon and commands.lstrip().startswith("gruebler "):
        lines = [each.strip() for each in re.split(r";\s+(?=gruebler )", commands)]
        yield "```console\n" + "\n".join(f"$ {each}" for each in lines) + "\n```\n"
        if rest:
            yield _text(status + rest) + "\n"
    else:
        yield _text(text) + "\n"


def _text(text: str) -> str:
    """Running text without marks that Markdown would take as its own."""
    return re.sub(r"([\\`*_{}\[\]<>#|~$])", r"\\\1", text)


def format_table(lang: str, _: str) -> str:
    """The table of file formats."""
    heads = {
        "en": ("format", "endings", "what it is", "carries", "lengths in", "read", "written", "yes", "no", "by name"),
        "de": (
            "Format",
            "Endungen",
            "was es ist",
            "enthält",
            "Längen in",
            "gelesen",
            "geschrieben",
            "ja",
            "nein",
            "mit Namen",
        ),
    }[lang]
    *columns, yes, no, by_name = heads
    lines = [f"| {' | '.join(columns)} |", "|" + "---|" * len(columns)]
    for each in FORMATS:
        endings = ", ".join(f"`{suffix}`" for suffix in each.suffixes) or by_name
        title, carries = (_text(each.title.in_language(lang)), _text(each.carries.in_language(lang)))
        lengths = _text(each.lengths.in_language(lang)) if each.lengths else ""
        cells = (
            f"`{each.name}`",
            endings,
            title,
            carries,
            lengths,
            yes if each.read else no,
            yes if each.write else no,
        )
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def bibtex(lang: str, _: str) -> str:
    """The entry for BibTeX, from CITATION.cff."""
    del lang
    text = (Path(__file__).parents[2] / "CITATION.cff").read_text(encoding="utf-8")
    found = dict(re.findall(r'^(title|version|date-released): "?([^"\n]*)"?$', text, re.MULTILINE))
    year = found["date-released"][:4]
    return f"""```bibtex
@software{{gruebler,
  title   = {{{found["title"]}}},
  author  = {{{{The gruebler maintainers}}}},
  version = {{{found["version"]}}},
  year    = {{{year}}},
}}
```"""


def schema(lang: str, kind: str) -> str:
    """The JSON schema of a kind of file, from the record that reads it."""
    del lang
    document = {"$schema": "https://json-schema.org/draft/2020-12/schema", **msgspec.json.schema(_RECORDS[kind])}
    return f"```json\n{json.dumps(document, indent=2, ensure_ascii=False)}\n```"


def further_theory(lang: str, _: str) -> str:
    """A list of the theory pages that no list of the index names."""
    folder = Path(__file__).parents[1] / "theory"
    listed = set((folder / "index.md").read_text(encoding="utf-8").split())
    further = sorted({path.stem for path in folder.glob("*.md")} - listed - {"index"})
    title = "Weitere" if lang == "de" else "Further"
    return "\n".join(["```{toctree}", ":maxdepth: 1", f":caption: {title}", "", *further, "```"]) if further else ""


def further_pages(lang: str, _: str) -> str:
    """A list of the pages of docs that neither the index nor that of the project names."""
    del lang
    docs = Path(__file__).parents[1]
    listed = set((docs / "index.md").read_text(encoding="utf-8").split())
    listed |= {word.removeprefix("../") for word in (docs / "project" / "index.md").read_text(encoding="utf-8").split()}
    pages = {
        path.relative_to(docs).with_suffix("").as_posix() for path in [*docs.glob("*.md"), *docs.glob("*/README.md")]
    }
    further = sorted(pages - listed - {"index"})
    return (
        "\n".join(["```{toctree}", ":maxdepth: 1", "", *(f"../{page}" for page in further), "```"]) if further else ""
    )


_INSERTS: dict[str, Callable[[str, str], str]] = {
    "bibtex": bibtex,
    "commands": command_reference,
    "formats": format_table,
    "front-door": front_door_table,
    "further-pages": further_pages,
    "further-theory": further_theory,
    "room": room_page,
    "schema": schema,
}


def _insert(app: Any, _page: str, source: list[str]) -> None:
    source[0] = _PLACE.sub(lambda found: _INSERTS[found[1]](app.config.language, found[2]), source[0])


def _write_rooms(app: Any) -> None:
    """A page for each room; only its place is written, the content is inserted."""
    folder = Path(app.srcdir) / "reference" / "api"
    folder.mkdir(parents=True, exist_ok=True)
    wanted = {folder / f"{room}.md": f"<!-- insert: room {room} -->\n" for room in documented_rooms()}
    for path in set(folder.glob("*.md")) - set(wanted):
        path.unlink()
    for path, text in wanted.items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def setup(app: Any) -> None:
    """The events."""
    app.connect("builder-inited", _write_rooms)
    app.connect("source-read", _insert)
