"""Valid inputs of every kind, thousands of damaged ones made of them, and a table of inputs that were once too slow."""

from __future__ import annotations

import argparse
import json
import math
import random
import re
import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import chdir, contextmanager
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import combinations, cycle
from pathlib import Path

from gruebler import Chain, FourBar
from gruebler.cli.commands import command as command_named
from gruebler.files.chain_files import LINES, graph_text
from gruebler.files.linkages import linkage_to_json, linkage_to_toml
from gruebler.structure.isomorphism import code
from gruebler.teaching.catalog import entries
from tests.torture.processes import Outcome, partial_files, run, warm


@dataclass(frozen=True)
class Case:
    """A command with the files it reads; ``{name}`` in an argument stands for the path of the file of that name."""

    arguments: tuple[str, ...]
    files: dict[str, bytes] = field(default_factory=dict)
    only: tuple[int, ...] = ()
    """Arguments that are damaged if there are no files; all behind the command if empty."""
    answer: bytes | None = None
    """What an answer must be, if damage may be noticed but must not change it."""


# --- valid inputs ------------------------------------------------------------------------------------

_SIX = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0)"
_TYPED = "R(frame-crank) R(crank-rod) R(rod-slider) P(slider-frame)"
_MARKED = f"{_SIX}; frame=0; drive=R(0-1)"
_FOUR_BAR = FourBar(a=25, b=70, c=40, d=70).linkage()
_RIGID = "R(a-b-c) R(a-d) R(b-d) G(c-d)"
_GEARS = "sun:24 planet:18 ring:-60 on arm planets=3; hold ring; drive sun=1000; load arm=-50"
_LIFT = "rise 20 60 3-4-5; dwell 30; fall 20 90 cycloidal; dwell"


def _machine(id: str) -> bytes:
    return (Path(__file__).parents[2] / "catalogs" / "machines" / f"{id}.toml").read_bytes()


def _texts(*texts: str) -> list[Case]:
    commands = (
        ("check",),
        ("check", "--explain"),
        ("inversions", "--count"),
        ("extend", "--derivation"),
        ("draw", "-o", "out.svg"),
        ("assur", "--json"),
        ("extend", "--dyad"),
    )
    return [Case((command[0], text, *command[1:]), only=(1,)) for command in commands for text in texts]


def _notation() -> list[Case]:
    spatial = 'spatial: C("a b"-c) R(c-d) S(d-e) U(e-"a b")'
    return [*_texts(_SIX, _TYPED, _MARKED), *(Case(("check", text), only=(1,)) for text in (spatial, _RIGID))]


def _codes() -> list[Case]:
    chains = [entries()[id].chain() for id in ("vcomp", "diff", "lambda")]
    return _texts(*(code(chain) for chain in chains), code(chains[0]) + ";frame=0")


def _graph6() -> list[Case]:
    made = [Case(("check", "{chains.g6}"), {"chains.g6": b"GCpdd_\nGCQf@o\nEEh_\n"})]
    return made + [Case((command, "g6:EEh_"), only=(1,)) for command in ("check", "inversions", "assur")]


_NOT_TAKEN = {("check", "made.json"), ("check", "lambda.json")}


def _linkages() -> list[Case]:
    files: list[tuple[str, bytes]] = [
        ("made.toml", linkage_to_toml(_FOUR_BAR).encode()),
        ("short.toml", b'unit = "mm"\n[four_bar]\na = 25\nb = 70\nc = 40\nd = 70\n'),
    ]
    for id in ("lambda", "crankrocker", "crane_cyl", "cam_roller"):
        files.append((f"{id}.toml", linkage_to_toml(entries()[id].linkage()).encode()))
    files.append(("made.json", json.dumps(linkage_to_json(_FOUR_BAR)).encode()))
    files.append(("lambda.json", json.dumps(linkage_to_json(entries()["lambda"].linkage())).encode()))
    commands = (
        ("analyse", "--range", "0:90:30", "--json"),
        ("check", "--explain"),
        ("draw", "-o", "out.svg"),
        ("inversions", "--count"),
        ("animate", "-o", "out.svg"),
        ("plot", "--kind", "transfer", "-o", "out.svg"),
    )
    return [
        Case((command[0], f"{{{name}}}", *command[1:]), {name: content})
        for command in commands
        for name, content in files
        if (command[0], name) not in _NOT_TAKEN
    ]


def _screws() -> list[Case]:
    plane = (
        b'joints = "R(frame-a) R(a-b) R(b-c) R(frame-c)"\nframe = "frame"\ndrives = ["R(frame-a)"]\n'
        b'[screws]\nunit = "mm"\n[screws.joints]\n"R(frame-a)" = { at = [0, 0] }\n"R(a-b)" = { at = [10, 20] }\n'
        b'"R(b-c)" = { at = [60, 35] }\n"R(frame-c)" = { at = [70, 0] }\n'
    )
    space = (
        b'joints = "R(frame-a) C(a-b) S(b-c) R(frame-c)"\nspace = "spatial"\nframe = "frame"\ndrives = ["R(frame-a)"]\n'
        b'[screws]\nunit = "mm"\n[screws.joints]\n"R(frame-a)" = { at = [0, 0, 0], z = [0, 0, 1] }\n'
        b'"C(a-b)" = { at = [10, 20, 0], z = [1, 0, 0] }\n"S(b-c)" = { at = [60, 35, 10] }\n'
        b'"R(frame-c)" = { at = [70, 0, 0], z = [0, 1, 0] }\n'
    )
    commands = (("check", "{s.toml}", "--explain"), ("check", "{s.toml}", "--json"))
    return [Case(command, {"s.toml": text}) for text in (plane, space) for command in commands]


def _records() -> list[Case]:
    ids = ("vcomp", "loco3", "lambda", "diff", "crane_cyl")
    return [Case(("check", "{record.toml}"), {"record.toml": _machine(id)}) for id in ids]


def _cams() -> list[Case]:
    turn = [math.radians(15 * k) for k in range(24)]
    contour = "\n".join(f"{40 * math.cos(a) + 5} {40 * math.sin(a)}" for a in turn).encode()
    lifts = (_LIFT, "rise 8 75; fall 8 75; dwell", "rise 10 120 v0=0 a0=0 v1=5 a1=0; fall 10 240")
    return [
        *(Case(("cam", lift, "--base", "40", "--roller", "10", "--json"), only=(1,)) for lift in lifts),
        Case(("cam", _LIFT, "--base", "40", "--flat", "--step", "30"), only=(1, 3, 6)),
        Case(("cam", _LIFT, "--base", "40", "--knife", "-o", "out.svg"), only=(1, 3)),
        Case(("cam", "--contour", "{c.txt}", "--roller", "5", "--json"), {"c.txt": contour}),
    ]


def _tasks() -> list[Case]:
    """Tasks of synthesis: every kind, in each of the three kinds of files."""
    rows = [(0, 0, 0), (-2, 3.8, 81), (-0.1, 3.4, -16), (1.5, 0.8, -32), (-1.8, 2.2, 55)]
    points = ((0, 0), (1, 0.5), (2, 0.4), (2.5, 0), (3, -1))
    along = {"points": points, "fixed_pivots": ((0, -2), (3, -3))}
    timed = {"points": points, "crank_angles": (0, 20, 45, 70, 100)}
    around = {"points": [(round(math.cos(k), 3), round(0.7 * math.sin(k), 3)) for k in range(6)], "closed": True}
    tasks: list[tuple[str, Mapping[str, object]]] = [
        ("positions", {"positions": rows}),
        ("positions", {"unit": "mm", "positions": rows[:3], "moving_pivots": ((1, 0), (0, 1))}),
        ("function", {"inputs": (0, 20, 40), "outputs": (0, 15, 33)}),
        ("function", {"inputs": (0, 20, 40), "outputs": (0, 15, 33), "output": "travel", "start_output": False}),
        ("path", along),
        ("path", timed),
        ("path", around),
        ("dead-centres", {"swing": 60, "time_ratio": 1.2}),
        ("dead-centres", {"stroke": 60, "crank_angle": 190}),
    ]
    tables = (
        ("positions", "x,y,angle", rows),
        ("path", "x,y,crank", [(*p, turn) for p, turn in zip(points, timed["crank_angles"], strict=True)]),
        ("function", "input,travel", [(0, 0), (20, 15), (40, 33)]),
        ("dead-centres", "swing,time_ratio", [(60, 1.2)]),
    )
    written = [
        *((kind, "task.json", json.dumps(task)) for kind, task in tasks),
        *((kind, "task.toml", "".join(f"{k} = {json.dumps(v)}\n" for k, v in task.items())) for kind, task in tasks),
        *(
            (kind, "task.csv", "\n".join([header, *(",".join(map(str, row)) for row in table)]))
            for kind, header, table in tables
        ),
    ]
    asked = (("--json",), ("-o", "best.toml"), ("--draw", "best.svg", "--lang", "de"))
    return [
        Case(("synthesise", kind, f"{{{name}}}", *asked[k % len(asked)]), {name: text.encode()})
        for k, (kind, name, text) in enumerate(written)
    ]


def _gears() -> list[Case]:
    texts = (
        _GEARS,
        "a:20 b:40; c:15 d:60 on arm; a=1",
        "belt a:100 b:200; drive a=10",
        "screw spindle slide lead=5; spindle=2",
    )
    return [
        *(Case(("gears", text, "--json"), only=(1,)) for text in texts),
        Case(("gears", _GEARS, "-o", "out.svg"), only=(1,)),
        Case(("gears", "{t.txt}"), {"t.txt": _GEARS.replace("; ", "\n").encode()}),
    ]


def _answers() -> list[Case]:
    return [
        Case(("exercise", "check", "mobility-2-7", "n=8", "F=1"), only=(2, 3, 4)),
        Case(("exercise", "check", "grashof-1-7", "type=crank-rocker", "--json"), only=(2, 3)),
        Case(("exercise", "check", "dead-centre-1-3", "H=40,5", "--lang", "de"), only=(2, 3)),
        Case(("exercise", "show", "transmission-angle-1-3"), only=(2,)),
        Case(("exercise", "solve", "15", "--lang", "de"), only=(2,)),
    ]


def _words() -> list[Case]:
    """Every command with arguments that it takes, for options with hostile values."""
    four_bar = "four-bar:25,70,40,70"
    return [
        Case(arguments)
        for arguments in (
            ("check", _SIX),
            ("catalog", "show", "vcomp"),
            ("catalog", "search", "crank"),
            ("enumerate", "--links", "8", "--count"),
            ("enumerate", "--links", "6"),
            ("enumerate", "--links", "8", "--assortments"),
            ("inversions", _SIX),
            ("variants", "--links", "4", "--prismatic", "1", "--count"),
            ("assur", _MARKED),
            ("assur", "--list", "2"),
            ("extend", _SIX, "--derivation"),
            ("extend", "vcomp", "--dyad"),
            ("analyse", four_bar, "--range", "0:90:30"),
            ("grashof", "25", "70", "40", "70"),
            ("gears", _GEARS),
            ("cam", _LIFT, "--base", "40", "--roller", "10"),
            ("geneva", "4", "--distance", "100"),
            ("curve", "25,70,40,70", "45,40", "--cognates"),
            ("curve", "25,70,40,70", "45,40", "--straight", "--band", "1"),
            ("draw", "vcomp", "-o", "out.svg"),
            ("draw", four_bar, "--at", "30", "-o", "out.svg"),
            ("animate", four_bar, "-o", "out.svg"),
            ("gallery", "--links", "4", "-o", "out.html"),
            ("plot", four_bar, "--kind", "transfer", "-o", "out.svg"),
            ("curve", four_bar, "coupler:45,40"),
            ("curve", "--guidance", "lambda"),
            ("synthesise", "dead-centres", "--swing", "60", "--time-ratio", "1.2"),
            ("synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "60"),
            ("statics", four_bar, "--load", "R(crank-coupler)=0,-10", "--at", "30"),
            ("check", four_bar, "--explain"),
            ("sheet", "show", "mzc"),
            ("exercise", "new", "--kind", "mobility", "--level", "1", "--seed", "7"),
            ("table", "grashof"),
        )
    ]


_FILES_OF_OTHERS = Path(__file__).parents[1] / "files" / "samples"


def _of_other_programs() -> list[Case]:
    commands = (
        ("check", "--explain"),
        ("analyse", "--json"),
        ("convert", "out.toml"),
        ("convert", "out.dxf"),
        ("convert", "out.mjcf"),
        ("draw", "-o", "out.svg"),
    )
    files = [path for path in sorted(_FILES_OF_OTHERS.iterdir()) if path.suffix != ".md" and path.stem != "arm"]
    return [
        Case((command[0], f"{{{path.name}}}", *command[1:]), {path.name: path.read_bytes()})
        for command, path in zip(cycle(commands), files, strict=False)
    ]


def _graph_files() -> list[Case]:
    chain = Chain.parse(_SIX)
    forms = {"graphml": "graphml", "gml": "gml", "dot": "dot", "edgelist": "edge-list", "adj": "matrix"}
    texts = {f"g.{ending}": graph_text(chain, form, []) for ending, form in forms.items()}
    texts |= {"g.g6": "EEh_\n", "g.s6": LINES["sparse6"][1](chain) + "\n"}
    commands = (("check",), ("convert", "out.txt"), ("inversions", "--count"))
    return [
        Case((command[0], f"{{{name}}}", *command[1:]), {name: text.encode()})
        for command in commands
        for name, text in texts.items()
        if command[0] != "inversions" or not name.endswith("6")
    ]


def _queries() -> list[Case]:
    queries = (
        "select code from chains where links = 6",
        "select links, count(*) as number from chains group by links order by links",
        "select chain, frame from mechanisms where links = 4",
    )
    return [
        Case(("atlas", "query", query, *more), only=(2,))
        for query in queries
        for more in ((), ("--json",), ("-o", "out.csv"))
    ]


@cache
def _checkpoint() -> tuple[dict[str, bytes], bytes]:
    """The files of a complete checkpoint and the answer."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        outcome = run([*_COUNTING, "--checkpoint", "kept"], folder)
        assert outcome.status == 0, outcome.err
        return {path.name: path.read_bytes() for path in (folder / "kept").iterdir()}, outcome.out


_COUNTING = ("enumerate", "--links", "9", "--mobility", "2", "--fractionated", "all", "--count", "--json")


def _checkpoints() -> list[Case]:
    files, answer = _checkpoint()
    named = {f"kept/{name}": content for name, content in files.items()}
    return [Case((*_COUNTING, "--checkpoint", "kept"), named, answer=answer)]


VALID: dict[str, Callable[[], list[Case]]] = {
    "notation": _notation,
    "codes": _codes,
    "graph6": _graph6,
    "linkage files": _linkages,
    "screw files": _screws,
    "catalog records": _records,
    "cams": _cams,
    "gears": _gears,
    "synthesis tasks": _tasks,
    "exercise answers": _answers,
    "checkpoints": _checkpoints,
    "options": _words,
    "files of other programs": _of_other_programs,
    "graph files": _graph_files,
    "queries": _queries,
    "one token": lambda: [
        one for make in (_linkages, _screws, _tasks, _of_other_programs, _graph_files) for one in make()
    ],
}
ONE_TOKEN = "one token"
"""Inputs that stay as good as sound: a single number, word or sign is exchanged, so that most get past the parser."""


# --- damage ------------------------------------------------------------------------------------------

_NUMBERS = ["0", "-0.0", "-1", "1", "2.5", "7", "30", "45.001", "1e-9", "1e9", "-40"]
_NUMBERS += ["3", "65537", "1000000000", "9" * 30, "9" * 5000, "1e400", "-1e400", "1e308", "1e-308"]
_NUMBERS += ["nan", "inf", "-inf", "1_0", "0x10", "1/0", "1/3", "sqrt(-1)", "sqrt(2)", "1,5", "1e", "--1", "١٢", ""]
_TOKENS = [*"()[]{}-;=,:#\"'\\\n\t \0", "\r\n", "\ufeff", "\u202e", "😀", "ä", "a" * 3000]
_TOKENS += ["[" * 500, "{" * 500, "(" * 500]
_TOKENS += ["null", "true", "NaN", "%s", "{0}", "../", "=cmd|1", "<script>", "[[a]]", "a = 1\n", "''' "]
_TOKENS += ["R(0-0)", "R(0-1)", "X(0-1)", "frame=0", "drive="]
_NUMBER = re.compile(r"\d+(?:\.\d+)?")
_WORD = re.compile(r"\w+")


def _damaged(text: str, chance: random.Random) -> str:
    """A text with one change: a number, word or piece of it replaced, removed, doubled or moved."""
    low = chance.randint(0, len(text))
    high = min(len(text), low + chance.choice((1, 1, 2, 5, 20, 100)))
    place = chance.randint(0, len(text))
    before, piece, after = text[:low], text[low:high], text[high:]
    rest = before + after
    letter = chr(chance.choice((0, 7, 127, 160, 0x2028, 0x10FFFF, *range(33, 127))))
    lines = text.splitlines(keepends=True) or [""]
    numbers, words = list(_NUMBER.finditer(text)), list(_WORD.finditer(text))
    changed = [
        rest,
        before + piece * chance.choice((2, 3, 50)) + after,
        rest[:place] + piece + rest[place:],
        before,
        "".join(chance.sample(lines, len(lines))),
        "".join([*lines, "\n", chance.choice(lines)]),
        before + letter + piece + after,
        before + chance.choice(_TOKENS) + after,
        before + chance.choice(_TOKENS) + piece + after,
    ]
    if numbers:
        one = chance.choice(numbers)
        changed += 8 * [text[: one.start()] + chance.choice(_NUMBERS) + text[one.end() :]]
    if words:
        one = chance.choice(words)
        changed += 4 * [text[: one.start()] + chance.choice(words)[0] + text[one.end() :]]
    return chance.choice(changed)


_TOKEN = re.compile(r"\d+(?:\.\d+)?|\w+|[^\w\s]")


def _one_exchanged(content: bytes, chance: random.Random) -> bytes:
    """One number, word or sign exchanged for another of its kind."""
    text = content.decode("utf-8")
    found = list(_TOKEN.finditer(text))
    one = chance.choice(found)
    number = _NUMBER.fullmatch(one[0]) is not None
    likes = [each[0] for each in found if (_NUMBER.fullmatch(each[0]) is not None) == number]
    new = chance.choice(likes + (_NUMBERS if number else _TOKENS))
    return (text[: one.start()] + new + text[one.end() :]).encode("utf-8", errors="surrogatepass")


def _damaged_bytes(content: bytes, chance: random.Random) -> bytes:
    if chance.random() < 0.05 and content:  # no text any more
        at = chance.randrange(len(content))
        return content[:at] + bytes([chance.randrange(256)]) + content[at + 1 :]
    text = content.decode("utf-8", errors="surrogateescape")
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        text = _damaged(text, chance)
    return text.encode("utf-8", errors="surrogatepass" if chance.random() < 0.5 else "replace")


def _with_damage(case: Case, chance: random.Random) -> Case:
    if case.files:
        files = dict(case.files)
        name = chance.choice(sorted(files))
        kind = chance.random() if len(files) > 1 else 1.0
        other = chance.choice(sorted(files))
        if kind < 0.15:
            del files[name]
        elif kind < 0.3:
            files[name] = files[other]
        elif kind < 0.45:
            files[name], files[other] = files[other], files[name]
        else:
            files[name] = _damaged_bytes(files[name], chance)
        return Case(case.arguments, files, case.only, case.answer)
    arguments = list(case.arguments)
    at = chance.choice(case.only or range(1, len(arguments)))
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        arguments[at] = _damaged(arguments[at], chance)
    arguments[at] = arguments[at].replace("\0", "?")  # no argument can hold it
    return Case(tuple(arguments), case.files, case.only)


@cache
def _options(command: tuple[str, ...]) -> list[tuple[str, bool]]:
    """The options of a command, each with whether it takes a value."""
    parser: argparse.ArgumentParser = command_named(command[0]).parser()
    for word in command[1:]:
        inner = [one for one in parser._actions if isinstance(one, argparse._SubParsersAction)]
        if not inner or word not in inner[0].choices:
            break
        parser = inner[0].choices[word]
    return [
        (option, action.nargs != 0)
        for action in parser._actions
        for option in action.option_strings
        if option not in ("-h", "--help", "--yes")  # --yes begins what would be refused for its length
    ]


_VALUES = ("0:360:30", "crank", "R(0-1)", "1,2", "a:1,2", "R@frame", "4,2", "P:1", "5", "12", "svg", "de")
_FILES = ("out.svg", "out.csv", "out.json", "out.html", "out.parquet", "out", "", ".", "no/out.svg", "/dev/null")


def _with_options(case: Case, chance: random.Random) -> Case:
    """More options, with values that nobody expects."""
    arguments = list(case.arguments)
    for _ in range(chance.randint(1, 3)):
        option, takes = chance.choice(_options(tuple(arguments[:2])))
        arguments.append(option)
        if takes and chance.random() < 0.95:
            values = _FILES if option in ("-o", "--out") else (*_NUMBERS, *_TOKENS, *_VALUES)
            arguments.append(chance.choice(values).replace("\0", "?"))
    return Case(tuple(arguments))


# --- too slow once ------------------------------------------------------------------------------------


def _lines(name: str, text: str) -> Case:
    return Case(("check", f"{{{name}}}"), {name: text.encode()})


def _entities(root: str) -> str:
    inner = "".join(f'<!ENTITY x{k + 1} "{f"&x{k};" * 10}">' for k in range(12))
    return f'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY x0 "ha">{inner}]><{root}>&x12;</{root}>'


def _complete(links: int) -> str:
    return " ".join(f"R({a}-{b})" for a, b in combinations(range(links), 2))


def _ring(links: int) -> str:
    return " ".join(f"R({k}-{(k + 1) % links})" for k in range(links))


def _assortments(links: str, *options: str) -> Case:
    return Case(("enumerate", "--links", links, "--assortments", *options))


_SLOW: dict[str, Callable[[], Case]] = {
    "assortments 60": lambda: _assortments("60"),
    "assortments 100": lambda: _assortments("100"),
    "assortments 100,000": lambda: _assortments("100000"),
    "assortments 300 with multiple joints": lambda: _assortments("300", "--multiple-joints"),
    "complete graph of 30 links": lambda: _lines("k.txt", _complete(30)),
    "complete graph of 60 links": lambda: _lines("k.txt", _complete(60)),
    "ring of 10,000 links": lambda: _lines("ring.txt", _ring(10_000)),
    "ring of 30,000 links": lambda: _lines("ring.txt", _ring(30_000)),
    "one joint of 100,000 links": lambda: _lines("joint.txt", f"R({'-'.join(map(str, range(100_000)))})"),
    "5,000 paths of two links": lambda: _lines("paths.txt", " ".join(f"R(a-{k}) R({k}-b)" for k in range(5000))),
    "300 wheels in a row": lambda: Case(("gears", " ".join(f"w{k}:{20 + k % 7}" for k in range(300)) + "; w0=1")),
    "1,000 wheels in a row": lambda: Case(("gears", " ".join(f"w{k}:{20 + k % 7}" for k in range(1000)) + "; w0=1")),
    "a key doubled among 60,000": lambda: Case(
        ("analyse", "{doubled.json}"),
        {"doubled.json": ("{" + ", ".join(f'"k{k}": 1' for k in range(60_000)) + ', "k59999": 2}').encode()},
    ),
    "variants of ten links": lambda: Case(("variants", "--links", "10", "--prismatic", "5", "--count")),
    "Assur groups of ten links": lambda: Case(("assur", "--list", "10", "--count")),
    "mechanisms of fourteen links": lambda: Case(("catalog", "search", "--enumerate", "--links", "14")),
    "a graph6 code of a megabyte": lambda: Case(("check", "{long.g6}"), {"long.g6": b"C" * 10**6}),
    "a key of 10,000 characters": lambda: Case(("analyse", "{key.json}"), {"key.json": b'{"%s": 1}' % (b"k" * 10_000)}),
    "100,000 brackets": lambda: Case(("check", "{deep.json}"), {"deep.json": b"[" * 100_000}),
    "sparse6 with 16 million links": lambda: _lines("q.s6", ":~~?@????"),
    "sparse6 with 68 billion links": lambda: _lines("q.s6", ":~~~~~~~~~~"),
    "graph6 with 4.5 million joints": lambda: _lines("complete.g6", "~?mw" + "~" * 749_750),
    "entities in GraphML": lambda: _lines("bomb.graphml", _entities("graphml")),
    "entities in a file of Linkage": lambda: _lines("bomb.linkage2", _entities("linkage2")),
    "GML nested 100,000 deep": lambda: _lines("deep.gml", "graph [ " + "a [ " * 100_000),
    "TOML nested 100,000 deep": lambda: _lines("deep.toml", "a = " + "[" * 100_000),
    "a TOML key of 100,000 parts": lambda: _lines("dots.toml", "a" + ".a" * 100_000 + " = 1"),
    "RON nested 100,000 deep": lambda: _lines("deep.ron", "(" * 100_000),
    "DOT nested 100,000 deep": lambda: _lines("deep.dot", "graph {" + "{" * 100_000),
    "Pyslvs nested 100,000 deep": lambda: _lines("deep.pyslvs", "M[" * 100_000),
    "an address of 300,000 letters": lambda: _lines("long.pmks", "?2v." + "1.0A," * 60_000),
    "a matrix of 990 links": lambda: _lines(
        "complete.adj", "\n".join(" ".join("1" if i != j else "0" for j in range(990)) for i in range(990))
    ),
    "a query for any number of rows": lambda: Case(("atlas", "query", "select * from range(100000000000)")),
    "a number of 100,000 digits": lambda: Case(("analyse", "{n.json}"), {"n.json": b'{"unit": %s}' % (b"1" * 100_000)}),
}
SLOW = "too slow once"
GROUPS = (*VALID, SLOW)


# --- one input after another --------------------------------------------------------------------------


def case(group: str, number: int, seed: int) -> Case:
    """The input of a number: the same for the same seed, whatever else is run."""
    if group == SLOW:
        return list(_SLOW.values())[number % len(_SLOW)]()
    chance = random.Random(f"{seed}/{group}/{number}")
    chosen = chance.choice(_valid(group))
    if group == ONE_TOKEN:
        return replace(chosen, files={name: _one_exchanged(each, chance) for name, each in chosen.files.items()})
    return _with_options(chosen, chance) if group == "options" else _with_damage(chosen, chance)


@cache
def _valid(group: str) -> list[Case]:
    return VALID[group]()


def size(group: str, inputs: int) -> int:
    """How many inputs of a group there are among so many: even shares, the slow ones once each."""
    return len(_SLOW) if group == SLOW else -(-inputs // len(VALID))


def prepare(folder: Path) -> None:
    """Run every valid input once in this process; all must be answered."""
    wrong = []
    for group in VALID:
        for one in _valid(group):
            with _laid_out(one, folder) as arguments, chdir(folder):
                if warm(arguments, folder) not in (0, 1):
                    wrong.append(f"{group}: {one.arguments}: {(folder / 'out').read_text()}")
    assert not wrong, "\n".join(wrong)


def try_one(one: Case, folder: Path) -> tuple[Outcome, str | None]:
    """Run an input; how it ended, and what is wrong with that."""
    with _laid_out(one, folder) as arguments:
        outcome = run(arguments, folder)
        fault = outcome.fault(arguments)
        if fault is None and (left := partial_files(folder)):
            fault = f"left behind: {left[0].name}"
        if fault is None and one.answer is not None and outcome.status != 2 and outcome.out != one.answer:
            fault = f"another answer: {outcome.out[:200]!r}"
        return outcome, fault


@contextmanager
def _laid_out(one: Case, folder: Path) -> Iterator[list[str]]:
    """The arguments of a case while its files are there."""
    for name, content in one.files.items():
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    known = {f"{{{name}}}": str(folder / name) for name in one.files}
    try:
        yield [known.get(word, word) for word in one.arguments]
    finally:
        for path in folder.iterdir():
            shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()


def try_all(
    inputs: int, seed: int, folder: Path, groups: Sequence[str] = GROUPS
) -> Iterator[tuple[str, int, Case, Outcome, str | None]]:
    """The inputs of groups: group, number, input, outcome and fault."""
    prepare(folder)
    for group in groups:
        for number in range(size(group, inputs)):
            one = case(group, number, seed)
            yield group, number, one, *try_one(one, folder)
