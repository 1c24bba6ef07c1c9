"""`gruebler catalog`: what comes with the library, listed, shown and searched."""

from __future__ import annotations

import argparse
import json
from typing import Any

import msgspec

from gruebler.catalog import Entry, Exercise, Query, entries, entry, exercises, search
from gruebler.cli.tables import print_table
from gruebler.mobility import counted

__all__ = ["run"]

_HEADERS = {"en": ("id", "name", "n", "F", "source"), "de": ("Kennung", "Name", "n", "F", "Quelle")}
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
_NOTHING = {"en": "No entry answers.", "de": "Kein Eintrag passt."}


def run(arguments: argparse.Namespace) -> int:
    """List, show or search."""
    match arguments.action:
        case "list":
            _list(list(entries().values()), list(exercises().values()), arguments)
        case "search":
            query = Query(
                tuple(arguments.words),
                arguments.links,
                arguments.joints,
                arguments.mobility,
                tuple(arguments.pair),
                arguments.drive,
            )
            _list(search(query), [], arguments)
        case "show":
            records = [exercises().get(id) or entry(id) for id in arguments.ids]
            if arguments.json:
                _print_json(records)
            else:
                print("\n\n".join(_shown(record, arguments.lang) for record in records))
    return 0


def _print_json(records: list[Any]) -> None:
    print(json.dumps([msgspec.to_builtins(record) for record in records], ensure_ascii=False, indent=2))


def _list(machines: list[Entry], tasks: list[Exercise], arguments: argparse.Namespace) -> None:
    if arguments.json:
        _print_json([*machines, *tasks])
        return
    lang = arguments.lang
    rows = []
    for machine in machines:
        chain = machine.chain()
        rows.append((machine.id, machine.name.said(lang), str(chain.n), str(counted(chain)), machine.source))
    rows += [(task.id, task.name.said(lang), "", "", task.source) for task in tasks]
    if rows:
        print_table(_HEADERS[lang], rows, numbers=(2, 3))
    else:
        print(_NOTHING[lang])


def _shown(record: Entry | Exercise, lang: str) -> str:
    title = f"{record.name.said(lang)} ({record.id})"
    lines = [title, "-" * len(title), f"{_label('source', lang)}: {record.source}"]
    if isinstance(record, Exercise):
        lines.append(f"{_label('task', lang)}: {record.task.said(lang)}")
        lines += [f"{_label('case', lang)}: {c.name.said(lang)} ({c.machine})" for c in record.cases]
        return "\n".join(lines)
    chain = record.chain()
    names = ", ".join(f"{link} = {german}" if link != german else link for link, german in record.links.items())
    lines += [
        f"{_label('chain', lang)}: {chain.text('german' if lang == 'de' else 'international')}",
        f"{_label('links', lang)}: {names if lang == 'de' else ', '.join(record.links)}",
    ]
    if record.frame:
        lines.append(f"{_label('frame', lang)}: {record.frame}")
    lines += [
        f"{_label(key, lang)}: {', '.join(values)}"
        for key, values in (("drives", record.drives), ("outputs", record.outputs))
        if values
    ]
    if record.figure_lost:
        lines.append(_label("lost", lang))
    if record.remark:
        lines.append(f"{_label('remark', lang)}: {record.remark.said(lang)}")
    return "\n".join(lines)


def _label(key: str, lang: str) -> str:
    return _LABELS[key][lang == "de"]
