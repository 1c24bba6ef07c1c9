"""ARCHITECTURE.md: the files, folders and names that it gives are there, and its questions lead to the answer."""

import ast
import re
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
TABLE = dict(re.findall(r"^\| ([^|`]+) \| (.*) \|$", PAGE.split("## Where is ...?")[1], re.MULTILINE)[1:])


def exists(name):
    """Whether a dotted name below gruebler leads to a module, a value, or a field of a class."""
    parts = re.sub(r"^(gr|gruebler)\.", "", name).split(".")
    parts = ["gruebler", *parts]
    for k in range(len(parts), 0, -1):
        try:
            value = import_module(".".join(parts[:k]))
        except ModuleNotFoundError:
            continue
        for part in parts[k:]:
            if not hasattr(value, part):
                return part in getattr(value, "__annotations__", {})  # a field of a class
            value = getattr(value, part)
        return True
    return False


def place(word):
    """The file or folder of this name, below the package, in a wing or at the top; None if there is none."""
    package = ROOT / "src" / "gruebler"
    places = [package / word, ROOT / word, *(wing / word for wing in package.iterdir())]
    return next((path for path in places if path.exists()), None)


def names_in(path):
    """What a file defines: functions, classes and their members, constants; of a catalog of texts its entries."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".po":
        return set(re.findall(r'^msgid "(.*)"$', text, re.MULTILINE))
    return {name for node in ast.parse(text).body for name in defined(node)}


def defined(node):
    if isinstance(node, ast.Assign | ast.AnnAssign):
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        yield from (target.id for target in targets if isinstance(target, ast.Name))
    elif isinstance(node, ast.FunctionDef | ast.ClassDef):
        yield node.name
        if isinstance(node, ast.ClassDef):
            yield from (f"{node.name}.{name}" for member in node.body for name in defined(member))
    elif isinstance(node, ast.If):  # for type checking
        yield from (name for member in node.body for name in defined(member))


def missing(cell):
    """The words of a cell that are neither a file or folder nor a name in the file before them, nor a command."""
    path = None
    for word in re.findall(r"`([^`]+)`", cell):
        if "/" in word or re.search(r"\.(py|md|po)$", word):
            path = place(word)
            if path is None:
                yield word
        elif path is not None and path.suffix in {".py", ".po"} and word not in names_in(path):
            yield f"{path.name}: {word}"


@pytest.mark.parametrize("question", TABLE)
def test_what_the_table_names_is_there(question):
    assert list(missing(TABLE[question])) == []


def test_every_noun_is_there():
    rows = re.findall(r"^\| .*\|([^|]*)\|$", PAGE.split("## Nouns")[1].split("\n## ")[0], re.MULTILINE)
    nouns = {name for cell in rows for name in re.findall(r"`([a-z_.]+\.\w+)`", cell)}
    assert len(nouns) > 40
    assert [name for name in sorted(nouns) if not exists(name)] == []


def test_every_file_on_the_page_is_there():
    words = re.findall(r"`([\w./]+(?:/|\.py|\.md|\.po))`", PAGE)
    assert len(words) > 80
    assert [word for word in words if place(word.rstrip("/")) is None] == []


def test_a_wrong_name_is_seen():
    assert list(missing("`mechanics/fourbar/four_bar.py` `FourBar.dead_center`")) == [
        "four_bar.py: FourBar.dead_center"
    ]
    assert list(missing("`base/locale/de/LC_MESSAGES/gruebler.po` `dead center`")) == ["gruebler.po: dead center"]
    assert list(missing("`no_such_room/x.py`")) == ["no_such_room/x.py"]


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        ("dead centre of a four-bar", "`FourBar.dead_centres`"),
        ("file format", "`FORMATS`"),
        ("message for a joint", "`Chain.joint_number`"),
        ("RRR dyad", "`core/src/motion/dyads.cpp`"),
        ('German for "dead centre"', "`base/locale/de/LC_MESSAGES/gruebler.po`"),
    ],
)
def test_a_reader_with_fresh_eyes_gets_an_answer(words, answer):
    """The questions that a newcomer was given, each answered by one row."""
    assert [answer in cell for question, cell in TABLE.items() if words in question] == [True]
