"""`gruebler man`: the manual page of all commands, in the format of `man`."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator

from gruebler.base.text import translate
from gruebler.cli.command_tree import CommandNode, command_tree
from gruebler.cli.parser import Parser


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Print the manual page of all commands for man. Write it to a folder of MANPATH.",
        epilog="Example: gruebler man > ~/.local/share/man/man1/gruebler.1",
    )


def run(arguments: argparse.Namespace) -> int:
    """Print the page."""
    print("\n".join(_page(arguments.lang)))
    return 0


def _page(lang: str) -> Iterator[str]:
    from gruebler import __version__

    summary = translate("structural synthesis of mechanisms", lang)
    yield f'.TH GRUEBLER 1 "" "gruebler {__version__}"'
    yield ".ad l"
    yield from (f".SH {translate('NAME', lang)}", _roff(f"gruebler - {summary}"))
    yield from (f".SH {translate('SYNOPSIS', lang)}", r"\fBgruebler\fR \fICOMMAND\fR ...")
    yield f".SH {translate('COMMANDS', lang)}"
    for node in command_tree(lang):
        yield from _command(node)
        for action in node.actions:
            yield from _command(action)
    yield f".SH {translate('ENVIRONMENT', lang)}"
    yield from (".TP", r"\fBGRUEBLER_LANG\fR", _roff(translate("language of the output: en or de", lang)))


def _command(node: CommandNode) -> Iterator[str]:
    yield f'.SS "{_roff(node.name)}"'
    yield from (_roff(node.description), ".PP", rf"\fB{_roff(node.usage)}\fR")
    for each in node.arguments:
        if {"--help", "--lang"} & set(each.options):
            continue
        names = ", ".join(rf"\fB{_roff(option)}\fR" for option in each.options)
        value = rf"\fI{_roff(each.placeholder)}\fR" if each.placeholder else ""
        yield from (".TP", f"{names} {value}".strip(), _roff(each.help))
    if node.epilog:
        yield from (".PP", _roff(node.epilog))


def _roff(text: str) -> str:
    """Text as roff takes it: backslashes and hyphens are escaped, no line begins with a control character."""
    escaped = re.sub(r"[\\-]", lambda sign: {"\\": r"\e", "-": r"\-"}[sign[0]], text)
    return rf"\&{escaped}" if escaped.startswith((".", "'")) else escaped
