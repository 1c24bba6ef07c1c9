"""`gruebler catalog`: what comes with the library, listed and shown."""

from __future__ import annotations

import argparse
from typing import Any

import msgspec

from gruebler.catalog import entries, entry, exercises
from gruebler.cli import search
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.documents import infinities_as_words
from gruebler.formats import Entry, Exercise
from gruebler.mechanism import Mechanism
from gruebler.mobility import counted

__all__ = ["add", "run"]

_HEADERS = {"en": ("id", "name", "n", "F", "source"), "de": ("Kennung", "Name", "n", "F", "Quelle")}
_EXERCISE_HEADERS = {lang: (id, name, source) for lang, (id, name, _, _, source) in _HEADERS.items()}
_EXERCISES = {
    "en": "Exercises on these machines (gruebler check ID, gruebler exercise show ID):",
    "de": "Aufgaben zu diesen Maschinen (gruebler check KENNUNG, gruebler exercise show KENNUNG):",
}
_LABELS = {
    "source": ("Source", "Quelle"),
    "task": ("Task", "Aufgabe"),
    "case": ("Case", "Fall"),
    "chain": ("Chain", "Kette"),
    "links": ("Links", "Glieder"),
    "frame": ("Frame", "Gestell"),
    "drives": ("Drives", "Antriebe"),
    "outputs": ("Outputs", "Abtriebe"),
    "remark": ("Remark", "Bemerkung"),
    "lost": ("Figure lost: the structure is an assumption.", "Bild verloren: Die Struktur ist eine Annahme."),
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(description="The machines and exercises of the teaching documents.")
    listing = parser.add_command("list", help="all entries")
    show = parser.add_command("show", help="one or several entries in full")
    show.add_argument("ids", nargs="+", metavar="ID")
    show.add_argument(
        "--full",
        action="store_true",
        help="with all that is derived: mobility with its derivation, what really moves, features, measures, paths",
    )
    for action in (listing, show):
        action.add_argument("--json", action="store_true", help="as JSON")
    search.add(
        parser.add_command(
            "search",
            help="machines with given words and access features; or every structure that has them",
            description="Machines of the catalog with given words and access features: drives, output links, links and "
            "joints with their numbers. With --enumerate every planar mechanism with these features, each once.",
            epilog="Example: gruebler catalog search --links 4 --drives 1 --drives-at-frame 1 "
            "--output-links-at-frame 0 --pairs D:4 --binary 4; gruebler catalog search --enumerate --links 6 "
            "--pairs S:1 --drives 1 --limit 20. "
            "Exit status: 0, 2 wrong usage or features that contradict each other.",
        )
    )


def run(arguments: argparse.Namespace) -> int:
    """List or show."""
    match arguments.action:
        case "search":
            return search.run(arguments)
        case "list":
            _list(arguments)
        case "show":
            records = [exercises().get(id) or entry(id) for id in arguments.ids]
            if arguments.json:
                print_json([_plain(record, arguments.full) for record in records])
            else:
                print_text("\n\n".join(_told(record, arguments) for record in records))
    return 0


def _plain(record: Entry | Exercise, full: bool) -> Any:
    if full and isinstance(record, Entry):
        from gruebler.catalog.machine_report import machine_report

        return machine_report(record).to_json()
    return infinities_as_words(msgspec.to_builtins(record))


def _told(record: Entry | Exercise, arguments: argparse.Namespace) -> str:
    text = _shown(record, arguments.lang)
    if arguments.full and isinstance(record, Entry):
        from gruebler.catalog.machine_report import machine_report

        text += "\n\n" + machine_report(record).explain(arguments.lang)
    return text


def _list(arguments: argparse.Namespace) -> None:
    machines, tasks = entries().values(), exercises().values()
    if arguments.json:
        print_json([_plain(record, full=False) for records in (machines, tasks) for record in records])
        return
    lang = arguments.lang
    rows = []
    for machine in machines:
        chain = machine.chain()
        rows.append((machine.id, machine.name.in_language(lang), str(chain.n), str(counted(chain)), machine.source))
    print_table(_HEADERS[lang], rows, numbers=(2, 3))
    print("\n" + _EXERCISES[lang])
    print_table(_EXERCISE_HEADERS[lang], [(task.id, task.name.in_language(lang), task.source) for task in tasks])


def _shown(record: Entry | Exercise, lang: str) -> str:
    title = f"{record.name.in_language(lang)} ({record.id})"
    lines = [title, "-" * len(title), f"{_label('source', lang)}: {record.source}"]
    if isinstance(record, Exercise):
        lines.append(f"{_label('task', lang)}: {record.task.in_language(lang)}")
        lines += [f"{_label('case', lang)}: {c.name.in_language(lang)} ({c.machine})" for c in record.cases]
        return "\n".join(lines)
    chain, alphabet = record.chain(), "german" if lang == "de" else "international"
    drives = Mechanism(chain, record.frame or chain.links[0], record.drives).drive_names(alphabet)
    names = ", ".join(f"{link} = {german}" if link != german else link for link, german in record.links.items())
    lines += [
        f"{_label('chain', lang)}: {chain.text(alphabet)}",
        f"{_label('links', lang)}: {names if lang == 'de' else ', '.join(record.links)}",
    ]
    if record.frame:
        lines.append(f"{_label('frame', lang)}: {record.frame}")
    lines += [
        f"{_label(key, lang)}: {', '.join(values)}"
        for key, values in (("drives", drives), ("outputs", record.outputs))
        if values
    ]
    if record.figure_lost:
        lines.append(_label("lost", lang))
    if record.remark:
        lines.append(f"{_label('remark', lang)}: {record.remark.in_language(lang)}")
    return "\n".join(lines)


def _label(key: str, lang: str) -> str:
    return _LABELS[key][lang == "de"]
