"""What a command gives in each language: links by their names there, and JSON whose keys are always the same."""

import argparse
import json
import re
from itertools import chain
from pathlib import Path

import pytest

from gruebler.cli import main
from gruebler.cli.commands import GROUPS, command, command_names
from gruebler.files.catalog_records import source_text
from gruebler.files.linkages import linkage_from_json, linkage_to_json
from gruebler.structure.isomorphism import code
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries, exercises

FOUR_BAR = "four-bar:25,70,40,70"
ENGINE = str(Path(__file__).with_name("engine.toml"))
SWING = str(Path(__file__).with_name("swing.toml"))
QUAD = "R(0-1) R(1-2) R(2-3) R(3-0)"

JSON = {
    "analyse": [
        ["lambda", "--output", "rocker", "--point", "C", "--poles", "--curvature", "--at", "30", "--speed", "60"],
        ["excavator", "--at", "1000,900,700", "--speed", "1", "--speed", "2", "--speed", "0"],
        ["four-bar:25,70,40,150"],
    ],
    "atlas": [["query", "select * from chains where links = 6"], ["columns"]],
    "assur": [["lambda"], [QUAD], ["--list", "2"]],
    "cam": [["rise 20 90; fall 20 90; dwell", "--base", "40", "--roller", "10"], ["--laws"]],
    "catalog": [
        ["list"],
        ["show", "lambda", "--full"],
        ["show", "excavator", "--full"],
        ["search", "--links", "4", "--drives", "1"],
    ],
    "check": [["lambda"], [FOUR_BAR, "--at", "30"], [QUAD], ["vcomp"]],
    "curve": [
        [FOUR_BAR, "coupler:45,40"],
        [FOUR_BAR, "45,40", "--cognates"],
        ["lambda", "C", "--straight", "--centre", "180", "--ratio", "0.01"],
        ["lambda", "C", "--cognates"],
        ["--guidance"],
    ],
    "enumerate": [["--links", "6"], ["--links", "6", "--assortments"], ["--links", "6", "--count"]],
    "construct": [[], ["geneva"], ["dead-centres", "slider-crank:17,60,15"]],
    "design": [[SWING]],
    "exercise": [["list"], ["show", "exercise-1"], ["solve", "example-3.5.4-lambda"]],
    "extend": [["lambda", "--dyad"], ["quad_strut", "--derivation"]],
    "gears": [["sun:24 planet:18 ring:-60 on arm planets=3; hold ring; drive sun=1000; load arm=-50"]],
    "geneva": [["4", "--distance", "100"]],
    "grashof": [[FOUR_BAR], ["25", "70", "40", "--free", "d"]],
    "inversions": [["lambda"], ["lambda", "--drives", "--with-output"]],
    "realise": [["lambda"]],
    "sheet": [["list"]],
    "dynamics": [[ENGINE, "--speed", "300", "--range", "0:90:30"]],
    "balance": [[ENGINE], [ENGINE, "--partly", "crank", "--speed", "60", "--irregularity", "0.1"]],
    "simulate": [[ENGINE, "--until", "0.1", "--at", "10", "--speed", "300", "--rows", "3"]],
    "statics": [["lambda", "--load", "C=0,-10", "--moment", "rocker=5", "--range", "0:90:30"]],
    "synthesise": [["dead-centres", "--swing", "60", "--time-ratio", "1.2"]],
    "table": [["joints"], ["grashof"], ["counts", "chains"]],
    "variants": [["--links", "4", "--prismatic", "1"]],
}


def _takes_json(parser):
    return any("--json" in each._option_string_actions for each in parser._all())


def test_every_command_with_json_is_in_the_table():
    assert set(JSON) == {name for name in command_names() if _takes_json(command(name).parser())}


def _shape(value):
    """Keys, lengths of lists, numbers, and the names of columns; texts are left out."""
    if isinstance(value, dict):
        name = value.get("name") if set(value) == {"name", "unit"} else None
        return {key: _shape(item) for key, item in value.items()} | ({"name": name} if name else {})
    if isinstance(value, list):
        return [_shape(item) for item in value]
    return "text" if isinstance(value, str) else value


@pytest.mark.parametrize(
    ("name", "words"), [pytest.param(name, words, id=" ".join([name, *words])) for name in JSON for words in JSON[name]]
)
def test_json_has_the_same_keys_and_numbers_in_every_language(capsys, name, words):
    shapes = []
    for lang in ("en", "de"):
        assert main([name, *words, "--json", "--lang", lang]) in (0, 1)
        shapes.append(_shape(json.loads(capsys.readouterr().out)))
    assert shapes[0] == shapes[1]
    assert shapes[0]


@pytest.mark.parametrize("id", entries())
def test_an_entry_with_german_names_is_the_same_machine(id):
    english, german = entries()[id], entries()[id].in_language("de")
    names = dict(zip(english.links, german.links, strict=True))
    assert len(set(names.values())) == len(names)
    assert german.chain() == english.chain().renamed(names)
    assert (german.frame, german.outputs) == (names.get(english.frame), tuple(names[k] for k in english.outputs))
    assert german.chain() == type(german.chain()).parse(german.chain().text("german"), space=english.space)
    frame = english.frame or english.chain().links[0]
    drawn = Mechanism(english.chain(), frame, english.drives)
    assert drawn.renamed(names) == Mechanism(german.chain(), names[frame], german.drives)
    assert code(german.chain()) == code(english.chain())
    if english.dimensions is not None:
        points = dict(zip(english.points, german.points, strict=True))
        spoken = linkage_to_json(english.linkage().renamed(names))
        spoken["points"] = {points.get(name, name): point for name, point in spoken["points"].items()}
        assert german.linkage() == linkage_from_json(spoken)
    assert (german.placed() is None) == (english.placed() is None)


def run(capsys, *words):
    """What a command prints."""
    status = main(list(words))
    out, err = capsys.readouterr()
    assert status == 0, err
    return out


GERMAN = {
    "analyse": ["analyse", "lambda", "--output", "rocker", "--at", "30"],
    "analyse lengths": ["analyse", FOUR_BAR, "--output", "rocker", "--at", "30"],
    "slider-crank": ["analyse", "slider-crank:25,70", "--at", "30", "--output", "slider"],
    "statics": ["statics", "lambda", "--load", "coupler:45,40=0,-10", "--at", "30"],
    "moment": ["statics", FOUR_BAR, "--moment", "rocker=5", "--range", "0:90:30"],
    "check": ["check", "lambda", "--explain"],
    "assur": ["assur", "lambda", "--drive", "R(frame-rocker)"],
    "inversions": ["inversions", "lambda", "--drives", "--with-output"],
    "extend": ["extend", "lambda", "--coupler"],
    "realise": ["realise", "lambda", "--drive", "R(frame-rocker)"],
    "curve": ["curve", "lambda", "R(crank-coupler)"],
    "poles": ["analyse", "crane", "--poles", "--at", "65"],
    "design": ["design", SWING],
    "draw": ["draw", "lambda", "--show", "centrodes", "--output", "coupler", "--curve", "coupler:20,10", "--labels"],
    "structure": ["draw", "lambda", "--drive", "R(frame-rocker)", "--labels"],
    "plot": ["plot", "lambda", "--output", "rocker"],
    "catalog": ["catalog", "show", "lambda", "--full"],
}
ENGLISH_NAME = re.compile(r"\b(frame|crank|coupler|rocker|jib)\b")


@pytest.mark.parametrize("name", GERMAN)
def test_links_have_their_german_names(capsys, name):
    told = run(capsys, *GERMAN[name], "--lang", "de")
    if name in ("catalog", "realise"):  # says once what the file calls the links; the keys of a file
        told = "\n".join(line for line in told.splitlines() if " = " not in line)
    told = re.sub(
        r'(class|id|fill|stroke|href)="[^"]*"|<style>.*?</style>|; frame=|var\([^)]*\)', "", told, flags=re.DOTALL
    )
    assert not ENGLISH_NAME.search(told), ENGLISH_NAME.search(told)


@pytest.mark.parametrize("name", GERMAN)
def test_options_take_either_spelling_of_a_link(capsys, name):
    """The German names with --lang de and without, the English ones likewise: what is printed stays the same."""
    words = {"frame": "Gestell", "crank": "Kurbel", "coupler": "Koppel", "rocker": "Schwinge", "slider": "Schieber"}
    command, thing, *options = GERMAN[name]
    german = [
        option if option.startswith("--") else re.sub(r"\w+", lambda match: words.get(match[0], match[0]), option)
        for option in options
    ]
    for lang in ("en", "de"):
        assert run(capsys, command, thing, *options, "--lang", lang) == run(
            capsys, command, thing, *german, "--lang", lang
        )


def test_a_file_for_programs_keeps_the_names_of_the_catalog(tmp_path, capsys):
    path = tmp_path / "lambda.toml"
    run(capsys, "realise", "lambda", "-o", str(path), "--lang", "de")
    written = path.read_text(encoding="utf-8")
    assert "R(frame-crank)" in written
    assert "Gestell" not in written


def test_the_table_of_a_motion_has_german_column_names(tmp_path, capsys):
    path = tmp_path / "lambda.csv"
    run(capsys, "statics", "lambda", "--load", "C=0,-10", "--range", "0:90:30", "-o", str(path), "--lang", "de")
    assert "Kraft von D(Gestell-Kurbel) auf Kurbel" in path.read_text(encoding="utf-8")


def test_placeholders_of_the_help_are_translated(capsys):
    with pytest.raises(SystemExit):
        main(["statics", "--help", "--lang", "de"])
    german = capsys.readouterr().out
    assert "--load PUNKT=FX,FY" in german
    assert "--range VON:BIS:SCHRITT" in german
    assert not re.search(r"\b(FILE|LINK|JOINT|POINT|LENGTHS|FROM|STEP|VALUE)\b", german)
    with pytest.raises(SystemExit):
        main(["statics", "--lang", "de"])
    assert "DATEI|ID|LÄNGEN" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["statics", "--help"])
    assert "--load POINT=FX,FY" in capsys.readouterr().out


def test_no_source_is_left_in_english():
    """Words of a source that German has no use for."""
    english = re.compile(r"\b(and|of|the|section|exercise|figure|variant|lengths|machine|chapter|not|is)\b")
    sources = [entry.source for entry in entries().values()] + [task.source for task in exercises().values()]
    sources += [entry.dimensions.source for entry in entries().values() if entry.dimensions is not None]
    title = "Design of Machinery"  # of a book: it stays
    german = [source_text(source, "de").replace(title, "") for source in sources]
    assert [text for text in german if english.search(text)] == []
    assert any(english.search(source_text(source, "en")) for source in sources)


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("command", [each for _, commands in GROUPS for each in commands], ids=lambda each: each.name)
def test_every_help_can_be_printed(command, lang):
    """To argparse a lone per cent sign is a place for a value: "0.1 % a" printed all values, "0,1 % f" was an error."""
    parser = command.parser(lang)
    below = [action.choices.values() for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    for each in [parser, *chain.from_iterable(below)]:
        assert "{'" not in each.format_help()
