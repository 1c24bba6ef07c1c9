"""All commands with their arguments as plain values, for shell completions and the manual page."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass

from gruebler.base.text import translate
from gruebler.cli.commands import GROUPS
from gruebler.cli.parser import Parser

_FILES = ("FILE", "DIR", "IN", "OUT")


@dataclass(frozen=True, slots=True, kw_only=True)
class Argument:
    """An option or a positional argument."""

    options: tuple[str, ...]
    """Its names, such as ``-o`` and ``--out``; empty for a positional argument."""
    placeholder: str
    """What stands for its value; empty if it takes none."""
    choices: tuple[str, ...]
    """The values that it can have; empty if it is not a choice."""
    help: str
    takes_file: bool
    """Whether a value may be the name of a file."""
    takes_entry: bool
    """Whether a value may be an entry of the catalog."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandNode:
    """A command or an action of one."""

    name: str
    """As it is typed, such as `catalog show`."""
    summary: str
    description: str
    usage: str
    epilog: str
    arguments: tuple[Argument, ...]
    actions: tuple[CommandNode, ...]


def command_tree(lang: str = "en") -> tuple[CommandNode, ...]:
    """Every command, with texts in a language.

    >>> [action.name for node in command_tree() if node.name == "catalog" for action in node.actions]
    ['catalog list', 'catalog show', 'catalog search']
    """
    return tuple(
        _node(each.name, each.summary.in_language(lang), each.parser(lang)) for _, group in GROUPS for each in group
    )


def _node(name: str, summary: str, parser: Parser) -> CommandNode:
    actions = []
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            summaries = {choice.dest: choice.help for choice in action._choices_actions}
            for word, below in action.choices.items():
                actions.append(_node(f"{name} {word}", translate(summaries[word] or "", parser.lang), below))
    arguments = tuple(_arguments(parser))
    described, after = (translate(text or "", parser.lang) for text in (parser.description, parser.epilog))
    usage = " ".join(parser.format_usage().split()).partition(": ")[2]
    return CommandNode(
        name=name,
        summary=summary,
        description=described,
        usage=usage,
        epilog=after,
        arguments=arguments,
        actions=tuple(actions),
    )


def _arguments(parser: Parser) -> Iterator[Argument]:
    kinds = [set(_placeholder(action).replace("|", " ").split()) for action in parser._actions]
    parser.translate_placeholders()
    for action, words in zip(parser._actions, kinds, strict=True):
        if isinstance(action, argparse._SubParsersAction) or action.help is argparse.SUPPRESS:
            continue
        yield Argument(
            options=tuple(action.option_strings),
            placeholder=_placeholder(action),
            choices=tuple(map(str, action.choices or ())),
            help=" ".join(parser._get_formatter()._expand_help(action).split()) if action.help else "",
            takes_file=not words.isdisjoint(_FILES),
            takes_entry="ID" in words,
        )


def _placeholder(action: argparse.Action) -> str:
    """What stands for the value of an argument; empty if it takes none."""
    if action.nargs == 0:
        return ""
    if isinstance(action.metavar, tuple):
        return " ".join(action.metavar)
    return action.metavar or "|".join(map(str, action.choices or ())) or action.dest.upper()
