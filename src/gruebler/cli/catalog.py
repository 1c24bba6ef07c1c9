"""`gruebler catalog`: list, show and search the machines and exercises that come with the library."""

from __future__ import annotations

import argparse
from typing import Any

import msgspec

from gruebler.base.documents import infinities_as_words
from gruebler.base.text import translate
from gruebler.cli import search
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.files import Entry, Exercise
from gruebler.files.catalog_records import source_text
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mobility import counted
from gruebler.teaching.catalog import entries, entry, exercises


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(description="The machines and exercises of the teaching documents.")
    parser.set_defaults(action="list", json=False, all=False, out=None)
    listing = parser.add_command("list", help="list all entries; done without a word, too")
    show = parser.add_command("show", help="show entries in full")
    show.take(
        """
        ids ID +  a catalog entry or an exercise
        --full  with everything derived: mobility, finite mobility, features, measures, paths
        """
    )
    for action in (listing, show):
        action.add_printed(help="print JSON")
    search.add(
        parser.add_command(
            "search",
            help="find machines by words and features, or list all structures with given features",
            description="Find machines of the catalog by words and by features: numbers of drives, output links, "
            "links and joints. With --enumerate, list all planar mechanisms with these features, each once.",
            epilog="Examples: gruebler catalog search --links 4 --drives 1 --drives-at-frame 1 "
            "--output-links-at-frame 0 --pairs D:4 --binary 4; gruebler catalog search --enumerate --links 6 "
            "--pairs S:1 --drives 1 --limit 20. "
            "Exit status: 0 success, 2 wrong usage or features that contradict each other.",
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
                print_text("\n\n".join(_described(record, arguments) for record in records))
    return 0


def _plain(record: Entry | Exercise, full: bool) -> Any:
    if full and isinstance(record, Entry):
        from gruebler.teaching.catalog.machine_report import machine_report

        return machine_report(record).to_json()
    return infinities_as_words(msgspec.to_builtins(record))


def _described(record: Entry | Exercise, arguments: argparse.Namespace) -> str:
    text = _shown(record, arguments.lang)
    if arguments.full and isinstance(record, Entry):
        from gruebler.teaching.catalog.machine_report import machine_report

        text += "\n\n" + machine_report(record.in_language(arguments.lang)).explain(arguments.lang)
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
        rows.append(
            (
                machine.id,
                machine.name.in_language(lang),
                str(chain.n),
                str(counted(chain)),
                source_text(machine.source, lang),
            )
        )
    id, name, source = translate("id", lang), translate("name", lang), translate("source", lang)
    print_table([id, name, "n", "F", source], rows, numbers=(2, 3))
    print("\n" + translate("Exercises on these machines (gruebler check ID, gruebler exercise show ID):", lang))
    print_table(
        [id, name, source], [(task.id, task.name.in_language(lang), source_text(task.source, lang)) for task in tasks]
    )


def _shown(record: Entry | Exercise, lang: str) -> str:
    title = f"{record.name.in_language(lang)} ({record.id})"
    lines = [title, "-" * len(title), translate("Source: {source}", lang, source=source_text(record.source, lang))]
    if isinstance(record, Exercise):
        lines.append(translate("Task: {task}", lang, task=record.task.in_language(lang)))
        lines += [
            translate("Case: {case} ({machine})", lang, case=case.name.in_language(lang), machine=case.machine)
            for case in record.cases
        ]
        return "\n".join(lines)
    names = record.link_names(lang).items()
    links = ", ".join(link if link == name else f"{link} = {name}" for link, name in names)
    record = record.in_language(lang)
    chain, alphabet = record.chain(), Alphabet.of_language(lang)
    drives = Mechanism(chain, record.frame or chain.links[0], record.drives).drive_names(alphabet)
    lines += [
        translate("Chain: {chain}", lang, chain=chain.text(alphabet)),
        translate("Links: {links}", lang, links=links),
    ]
    if record.frame:
        lines.append(translate("Frame: {frame}", lang, frame=record.frame))
    if drives:
        lines.append(translate("Drives: {drives}", lang, drives=", ".join(drives)))
    if record.outputs:
        lines.append(translate("Outputs: {outputs}", lang, outputs=", ".join(record.outputs)))
    if record.figure_lost:
        lines.append(translate("Figure lost: the structure is an assumption.", lang))
    if record.remark:
        lines.append(translate("Remark: {remark}", lang, remark=record.remark.in_language(lang)))
    return "\n".join(lines)
