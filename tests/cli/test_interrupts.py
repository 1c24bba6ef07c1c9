"""An interrupt at any moment: one word, status 130, no traceback."""

import os
import subprocess
import sys

import pytest

from gruebler.cli import main

PROGRAM = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # also below a job in the background
import gruebler_command

class Interrupt:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupt())
sys.exit(gruebler_command.main())
"""

pytestmark = pytest.mark.skipif(os.name != "posix", reason="a process sends itself no interrupt elsewhere")


def interrupted(module, *words, **environment):
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.format(module=module), *words],
        capture_output=True,
        text=True,
        env=os.environ | environment,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


MODULES = ["gruebler", "lazy_loader", "gruebler.base.errors", "gruebler.cli.commands", "gruebler.cli.check", "numpy"]


@pytest.mark.parametrize("module", [*MODULES, "gruebler.structure.mobility", "gruebler.structure.mobility.placement"])
def test_an_interrupt_while_a_module_is_loaded(module):
    assert interrupted(module, "check", "R(0-1) R(1-2) R(2-0)") == (130, "", "\ngruebler: stopped\n")


def test_an_interrupt_of_a_search_that_is_kept_says_where_it_goes_on(monkeypatch, capsys, tmp_path):
    def stopped(*_, **__):
        raise KeyboardInterrupt(tmp_path / "search.npz")

    monkeypatch.setattr("gruebler.cli.synthesise.synthesise_six_bars", stopped)
    words = ["synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "60", "--six-bars"]
    assert main(words) == 130
    said = f"stopped; run the same command again to continue from {tmp_path / 'search.npz'}"
    assert capsys.readouterr().err == f"\ngruebler: {said}\n"


def test_an_interrupt_in_german():
    assert interrupted("gruebler.base.text", "check", "vcomp", "--lang", "de")[2] == "\ngruebler: abgebrochen\n"
    assert interrupted("gruebler.base.text", "check", "vcomp", GRUEBLER_LANG="de")[2] == "\ngruebler: abgebrochen\n"
    assert interrupted("gruebler.base.text", "check", "vcomp", "--lang=de")[2] == "\ngruebler: abgebrochen\n"
    assert interrupted("gruebler.base.text", "check", "de")[2] == "\ngruebler: stopped\n"
    assert interrupted("gruebler.base.text", "check", "--lang", "en", GRUEBLER_LANG="de")[2] == "\ngruebler: stopped\n"
    assert (
        interrupted("gruebler.structure.mobility", "check", "vcomp", "--lang", "de")[2] == "\ngruebler: abgebrochen\n"
    )


def test_other_programs_keep_their_own_interrupts():
    """The library itself does not touch what an interrupt does."""
    program = (
        "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
        "import gruebler; from gruebler.cli import main; main(['grashof', '25', '70', '40', '70']); "
        "assert signal.getsignal(signal.SIGINT) is signal.default_int_handler"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
