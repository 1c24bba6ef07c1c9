"""Commands run inside the tests, without a process of their own."""

from argparse import Namespace

from gruebler import GrueblerError
from gruebler.cli import main
from gruebler.cli.commands import command
from gruebler.cli.link_names import spell_links_alike


def arguments_of(name, *words, **options):
    """The arguments that a command gets from these words, some of them replaced."""
    given = vars(command(name).parser().parse_args(words))
    assert set(options) <= set(given)
    return Namespace(**(given | options))


def run_main(capture, *words):
    """The exit status of a command line, and what it wrote to both streams; bytes need `capfd`, they go past Python."""
    try:
        status = main(words)
    except SystemExit as stop:
        status = stop.code
    return status, *capture.readouterr()


def run_command(capsys, name, *arguments):
    """The exit status of a command, what it printed, and what it said on standard error or refused."""
    chosen = command(name)
    parser = chosen.parser()
    try:
        given = parser.parse_args(arguments)
        spell_links_alike(parser, given)
        status = chosen.module().run(given)
    except SystemExit as stop:
        status = stop.code
    except GrueblerError as error:
        return 2, "", str(error)
    return status, *capsys.readouterr()
