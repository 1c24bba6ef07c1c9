"""Commands run inside the tests, without a process of their own."""

from argparse import Namespace

from gruebler import GrueblerError
from gruebler.cli.commands import command


def arguments_of(name, *words, **options):
    """The arguments that a command gets from these words, some of them replaced."""
    given = vars(command(name).parser().parse_args(words))
    assert set(options) <= set(given)
    return Namespace(**(given | options))


def run_command(capsys, name, *arguments):
    """The exit status of a command, what it printed, and what it said on standard error or refused."""
    chosen = command(name)
    try:
        status = chosen.module().run(chosen.parser().parse_args(arguments))
    except SystemExit as stop:
        status = stop.code
    except GrueblerError as error:
        return 2, "", str(error)
    return status, *capsys.readouterr()
