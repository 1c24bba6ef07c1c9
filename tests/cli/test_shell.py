"""`gruebler` alone, the completions of three shells, the manual page."""

import os
import shlex
import shutil
import subprocess

import pytest

from gruebler.cli.command_tree import command_tree
from gruebler.cli.commands import FIRST_STEPS, command_names
from gruebler.teaching.catalog import entries
from tests.commands import run_command
from tests.docs_session import Session


def completions_of_bash(script, line):
    """What bash offers for a command line; its last word is the one to complete."""
    words = line.split(" ")
    array = " ".join(shlex.quote(word) for word in words)
    program = (
        f'{script}\nCOMP_WORDS=({array}); COMP_CWORD={len(words) - 1}; _gruebler; printf "%s\\n" "${{COMPREPLY[@]}}"'
    )
    ran = subprocess.run(["bash", "--norc", "-c", program], capture_output=True, text=True, check=True)
    assert ran.stderr == ""
    return ran.stdout.split()


@pytest.fixture
def script(capsys):
    return lambda shell: run_command(capsys, "completion", shell)[1]


def test_gruebler_alone_shows_five_commands_that_run(capsys, tmp_path):
    from gruebler.cli import main

    assert main([]) == 0
    shown = capsys.readouterr().out
    assert len(FIRST_STEPS) == 5
    session = Session(tmp_path)
    for title, example in FIRST_STEPS:
        assert f"  {title} " in shown
        assert example in shown
        assert session.command(example)[0] == 0, example
    assert main(["--lang", "de"]) == 0
    assert "gruebler analyse four-bar:25,70,40,70" in capsys.readouterr().out


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_bash_completes(script, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wipe.toml").write_text("", encoding="utf-8")
    text = script("bash")
    assert set(command_names()) <= set(completions_of_bash(text, "gruebler "))
    assert completions_of_bash(text, "gruebler enu") == ["enumerate"]
    assert completions_of_bash(text, "gruebler help enu") == ["enumerate"]
    assert completions_of_bash(text, "gruebler check --sp") == ["--space"]
    assert completions_of_bash(text, "gruebler check --space s") == ["spherical", "spatial"]
    assert completions_of_bash(text, "gruebler catalog s") == ["show", "search"]
    assert "--full" in completions_of_bash(text, "gruebler catalog show --")
    assert completions_of_bash(text, "gruebler analyse wip") == ["wiper", "wiper_opposed", "wiper_rssr", "wipe.toml"]
    assert completions_of_bash(text, "gruebler draw wiper -o wip") == ["wipe.toml"]
    assert completions_of_bash(text, "gruebler table gr") == ["grashof"]
    assert completions_of_bash(text, "gruebler check --b ") == []
    assert set(entries()) <= set(completions_of_bash(text, "gruebler draw "))


@pytest.mark.skipif(shutil.which("fish") is None, reason="needs fish")
def test_fish_completes(script, tmp_path):
    path = tmp_path / "gruebler.fish"
    path.write_text(script("fish"), encoding="utf-8")

    def offered(line):
        program = f"source {shlex.quote(str(path))}; complete -C {shlex.quote(line)}"
        environment = os.environ | {"HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path)}
        ran = subprocess.run(
            ["fish", "--no-config", "-c", program],
            capture_output=True,
            text=True,
            check=True,
            cwd=tmp_path,
            env=environment,
        )
        assert ran.stderr == ""
        return [row.partition("\t")[0] for row in ran.stdout.splitlines()]

    assert set(command_names()) <= set(offered("gruebler "))
    assert offered("gruebler check --sp") == ["--space"]
    assert sorted(offered("gruebler check --space s")) == ["spatial", "spherical"]
    assert sorted(offered("gruebler catalog s")) == ["search", "show"]
    assert "--full" in offered("gruebler catalog show --")
    assert "wiper" in offered("gruebler analyse wip")


@pytest.mark.skipif(shutil.which("zsh") is None, reason="needs zsh")
def test_zsh_completes(script, tmp_path):
    """The functions of zsh that offer words print what they are given."""
    path = tmp_path / "_gruebler"
    path.write_text(script("zsh"), encoding="utf-8")

    def offered(*words):
        program = f"""
            compdef() {{ }}
            _arguments() {{ print -rl -- "$@" }}
            _describe() {{ print -rl -- "${{(P@)@[-1]}}" }}
            source {shlex.quote(str(path))}
            words=({" ".join(map(shlex.quote, words))} ''); CURRENT={len(words) + 1}
            _gruebler"""
        ran = subprocess.run(["zsh", "-f", "-c", program], capture_output=True, text=True, check=False)
        assert ran.stderr == ""
        return ran.stdout.splitlines()

    assert {row.partition(":")[0] for row in offered("gruebler")} == set(command_names())
    assert [row.partition(":")[0] for row in offered("gruebler", "catalog")] == ["list", "show", "search"]
    space = next(row for row in offered("gruebler", "check") if "--space" in row)
    assert space.endswith("(planar spherical spatial)")
    assert any(row.endswith(":_gruebler_input") for row in offered("gruebler", "check"))
    assert any("--full" in row for row in offered("gruebler", "catalog", "show"))


def test_the_manual_page_has_every_command_and_option(capsys, tmp_path):
    status, page, _ = run_command(capsys, "man")
    assert status == 0
    assert page.startswith('.TH GRUEBLER 1 ""')
    plain = page.replace(r"\-", "-")
    for node in command_tree():
        for each in node.actions or (node,):
            assert f'.SS "{each.name}"' in plain
            for argument in each.arguments:
                if "--lang" not in argument.options and "--help" not in argument.options:
                    assert all(option in plain for option in argument.options)
    if shutil.which("man"):
        path = tmp_path / "gruebler.1"
        path.write_text(page, encoding="utf-8")
        ran = subprocess.run(
            ["man", "--warnings", "-l", str(path)],
            capture_output=True,
            text=True,
            check=True,
            env=os.environ | {"MANWIDTH": "100"},
        )
        assert ran.stderr == ""
        assert "GRUEBLER_LANG" in ran.stdout
