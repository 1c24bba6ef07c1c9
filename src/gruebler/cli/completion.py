"""`gruebler completion`: what bash, zsh and fish need to complete commands, options, values and catalog entries."""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Iterator

from gruebler.cli.command_tree import Argument, CommandNode, command_tree
from gruebler.cli.parser import Parser


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Print a script that completes commands, options, their values and catalog entries in a shell. "
        "Write it to a file that the shell reads at startup.",
        epilog="Examples: gruebler completion bash > ~/.local/share/bash-completion/completions/gruebler; "
        "gruebler completion zsh > ~/.zfunc/_gruebler; "
        "gruebler completion fish > ~/.config/fish/completions/gruebler.fish",
    )
    parser.take("shell SHELL {bash,zsh,fish}  bash, zsh or fish")


def run(arguments: argparse.Namespace) -> int:
    """Print the script of a shell."""
    lines = {"bash": _bash, "zsh": _zsh, "fish": _fish}[arguments.shell]
    print("\n".join(lines(command_tree(arguments.lang))))
    return 0


def _entries() -> str:
    from gruebler.teaching.catalog import entries

    return " ".join(sorted(entries()))


def _each(commands: tuple[CommandNode, ...]) -> Iterator[CommandNode]:
    """Every command that takes arguments: those without actions, then the actions."""
    for node in commands:
        yield from node.actions or (node,)


def _with_actions(commands: tuple[CommandNode, ...]) -> list[CommandNode]:
    return [node for node in commands if node.actions]


def _last(node: CommandNode) -> str:
    return node.name.split()[-1]


# --- bash ------------------------------------------------------------------------------------------


def _bash(commands: tuple[CommandNode, ...]) -> Iterator[str]:
    names = " ".join(node.name for node in commands)
    yield "# bash completion of gruebler"
    yield "_gruebler() {"
    yield '    local current="${COMP_WORDS[COMP_CWORD]}" previous="${COMP_WORDS[COMP_CWORD-1]}" key="${COMP_WORDS[1]}"'
    yield "    local words='' options='' files='' first=2"
    yield f"    local entries={shlex.quote(_entries())}"
    yield "    COMPREPLY=()"
    yield "    if ((COMP_CWORD == 1)) || { ((COMP_CWORD == 2)) && [[ $key == help ]]; }; then"
    yield f'        COMPREPLY=($(compgen -W {shlex.quote(names + " help --help --version")} -- "$current"))'
    yield "        return"
    yield "    fi"
    yield "    case $key in"
    for node in _with_actions(commands):
        yield f"        {node.name})"
        offered = f"COMPREPLY=($(compgen -W '{' '.join(map(_last, node.actions))}' -- \"$current\"))"
        yield f"            if ((COMP_CWORD == 2)); then {offered}; return; fi"
        yield '            key="$key ${COMP_WORDS[2]}" first=3 ;;'
    yield "    esac"
    yield '    case "$key" in'
    for node in _each(commands):
        options = " ".join(option for each in node.arguments for option in each.options)
        positional = [each for each in node.arguments if not each.options]
        words = " ".join(choice for each in positional for choice in each.choices)
        entries = " $entries" if any(each.takes_entry for each in positional) else ""
        files = "yes" if any(each.takes_file for each in positional) else ""
        yield f"        '{node.name}') options='{options}' words=\"{words}{entries}\" files='{files}' ;;"
    yield "    esac"
    yield "    if ((COMP_CWORD > first)) || [[ $previous == -* ]]; then"
    yield '        case "$key $previous" in'
    for node in _each(commands):
        for each in node.arguments:
            if each.options and each.placeholder:
                pattern = "|".join(f"'{node.name} {option}'" for option in each.options)
                files = "yes" if each.takes_file else ""
                yield f"            {pattern}) options='' words='{' '.join(each.choices)}' files='{files}' ;;"
    yield "        esac"
    yield "    fi"
    yield '    if [[ $current == -* ]]; then words="$options"; files=""; fi'
    yield '    COMPREPLY=($(compgen -W "$words" -- "$current"))'
    yield '    if [[ -n $files ]]; then COMPREPLY+=($(compgen -f -- "$current")); fi'
    yield "}"
    yield "complete -o filenames -F _gruebler gruebler"


# --- zsh -------------------------------------------------------------------------------------------


def _zsh(commands: tuple[CommandNode, ...]) -> Iterator[str]:
    yield "#compdef gruebler"
    yield "_gruebler_input() {"
    yield f"    local -a entries=({_entries()})"
    yield "    _describe -t entries 'catalog' entries"
    yield "    _files"
    yield "}"
    yield "_gruebler() {"
    yield "    local -a commands=("
    for node in commands:
        yield f"        {_zsh_pair(node.name, node.summary)}"
    yield "    )"
    yield "    if ((CURRENT == 2)) || { ((CURRENT == 3)) && [[ $words[2] == help ]]; }; then"
    yield "        _describe -t commands 'command' commands"
    yield "        return"
    yield "    fi"
    yield "    local key=$words[2]"
    yield "    shift words; ((CURRENT--))"
    yield "    local -a actions"
    yield "    case $key in"
    for node in _with_actions(commands):
        pairs = " ".join(_zsh_pair(_last(each), each.summary) for each in node.actions)
        yield f"        {node.name})"
        yield f"            actions=({pairs})"
        yield "            if ((CURRENT == 2)); then _describe -t actions 'action' actions; return; fi"
        yield '            key="$key $words[2]"; shift words; ((CURRENT--)) ;;'
    yield "    esac"
    yield '    case "$key" in'
    for node in _each(commands):
        yield f"        '{node.name}')"
        yield "            _arguments -s \\"
        for each in node.arguments:
            yield f"                {_zsh_argument(each)} \\"
        yield "                && return ;;"
    yield "    esac"
    yield "}"
    yield 'if [[ $funcstack[1] == _gruebler ]]; then _gruebler "$@"; else compdef _gruebler gruebler; fi'


def _zsh_pair(name: str, text: str) -> str:
    return shlex.quote(f"{name}:{text}")


def _zsh_argument(each: Argument) -> str:
    value = ""
    if each.placeholder:
        escaped = each.placeholder.replace(":", r"\:")
        what = f"({' '.join(each.choices)})" if each.choices else ""
        what = "_gruebler_input" if each.takes_entry else "_files" if each.takes_file else what or " "
        value = f":{escaped}:{what}"
    if not each.options:
        return shlex.quote(f"*{value}")
    text = each.help.replace("[", r"\[").replace("]", r"\]").replace(":", r"\:")
    if len(each.options) == 1:
        return shlex.quote(f"*{each.options[0]}[{text}]{value}")
    return f"'({' '.join(each.options)})'{{{','.join(each.options)}}}{shlex.quote(f'[{text}]{value}')}"


# --- fish ------------------------------------------------------------------------------------------


def _fish(commands: tuple[CommandNode, ...]) -> Iterator[str]:
    yield "# fish completion of gruebler"
    yield "complete -c gruebler -f"
    for node in commands:
        yield f"complete -c gruebler -n __fish_use_subcommand -a {node.name} -d {_fish_quoted(node.summary)}"
    names = " ".join(node.name for node in commands)
    yield f"complete -c gruebler -n '__fish_seen_subcommand_from help' -a '{names}'"
    for node in _with_actions(commands):
        actions = " ".join(map(_last, node.actions))
        for each in node.actions:
            condition = f"__fish_seen_subcommand_from {node.name}; and not __fish_seen_subcommand_from {actions}"
            yield f"complete -c gruebler -n '{condition}' -a {_last(each)} -d {_fish_quoted(each.summary)}"
    for node in _each(commands):
        condition = "; and ".join(f"__fish_seen_subcommand_from {word}" for word in node.name.split())
        for argument in node.arguments:
            yield f"complete -c gruebler -n '{condition}' {_fish_argument(argument)}"


def _fish_argument(each: Argument) -> str:
    words = " ".join(each.choices) or (_entries() if each.takes_entry else "")
    values = f" -a {_fish_quoted(words)}" if words else ""
    files = " -F" if each.takes_file else ""
    if not each.options:
        return f"{files}{values}".strip() or "-f"
    names = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in each.options)
    required = " -r" if each.placeholder else ""
    return f"{names}{required}{files}{values} -d {_fish_quoted(each.help)}"


def _fish_quoted(text: str) -> str:
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"
