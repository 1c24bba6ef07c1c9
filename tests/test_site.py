"""Everything that README.md and the pages of docs show runs: commands, files, pictures, Python."""

import doctest
import json
import re
import shlex
import shutil
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

import gruebler as gr
from tests.docs_session import DOCS, Session, blocks_of

ROOT = Path(__file__).parents[1]
PAGES = sorted(path for path in DOCS.rglob("*.md") if any(blocks_of(path.read_text(encoding="utf-8"))))
SLOW = {"gallery"}
RUNNER = doctest.DocTestRunner(verbose=False, optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)


def name_of(page):
    return page.relative_to(DOCS).with_suffix("").as_posix()


def run_page(page, folder):
    """Run a page in a folder; returns how many blocks ran."""
    session, number = Session(folder), 0
    for block in blocks_of(page.read_text(encoding="utf-8")):
        number += 1
        if block.kind == "command":
            status, printed = session.command(block.body)
            assert status == int(block.options.get("status", 0)), f"{block.body}\n{printed}"
            assert printed.strip(), block.body
        elif block.kind == "file":
            session.file(block.argument, block.body)
        elif block.kind == "picture":
            assert session.picture(block.body).svg().startswith("<svg"), block.body
        else:
            test = doctest.DocTestParser().get_doctest(block.body + "\n", session.names, page.name, str(page), None)
            assert test.examples, block.body
            report = []
            RUNNER.run(test, out=report.append, clear_globs=False)
            session.names = test.globs
            assert not report, "".join(report)
    return number


def pairs_of(page):
    """The commands of a page with the examples that are to do the same: before those stands "in Python ...:"."""
    text = page.read_text(encoding="utf-8")
    for command, example in pairwise(blocks_of(text)):
        before = text.partition(f"```pycon\n{example.body}\n```")[0]
        if before != text and re.search(r"\bin python\b[^\n]*:\s*\Z", before, re.IGNORECASE):
            yield command, example.body


def ran(python):
    """The names that an example leaves behind."""
    names = {"gr": gr}
    for example in doctest.DocTestParser().get_examples(python):
        exec(compile(example.source, "<example>", "single"), names)
    return names


def same_check(words, said, names):
    """The chain of the text is the chain of the example, and so are the numbers."""
    assert gr.Chain.parse(words[0]) == names["chain"]
    (found,) = json.loads(said)
    report = names["report"].to_json()
    assert report == {key: found[key] for key in report}


def same_piece(words, said, names):
    found = json.loads(said)
    assert found["length"] == pytest.approx(names["piece"].length, rel=1e-9)
    assert found["band"] == pytest.approx(names["piece"].band, rel=1e-9)


def same_variants(words, said, names):
    texts = [item["text"] for item in json.loads(said)["items"]]
    assert texts == [mechanism.text() for mechanism in names["found"]]


SAME = {"check": same_check, "curve": same_piece, "variants": same_variants}


def test_the_same_in_python_is_the_same(tmp_path):
    number = 0
    for page in PAGES:
        for command, python in pairs_of(page):
            assert command.kind == "command", f"{page}: {python}"
            words = shlex.split(command.body.replace("\\\n", " "))[1:]
            verb, rest = words[0], [word for word in words[1:] if word not in ("--explain", "-o", "cylinders.txt")]
            status, said = Session(tmp_path).command(shlex.join(["gruebler", verb, *rest, "--json"]))
            assert status == 0, said
            SAME[verb](rest, said, ran(python))
            number += 1
    assert number >= 4


def test_there_are_pages():
    assert {"start", "gallery", "tutorials/hood-hinge", "how-to/linkages"} <= {name_of(page) for page in PAGES}


@pytest.mark.parametrize(
    "page", [pytest.param(p, id=name_of(p), marks=[pytest.mark.slow] * (name_of(p) in SLOW)) for p in PAGES]
)
def test_pages_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run_page(page, tmp_path) > 0


def test_the_gallery_has_forty_pictures():
    text = (DOCS / "gallery.md").read_text(encoding="utf-8")
    assert len([block for block in blocks_of(text) if block.kind == "picture"]) >= 40


def test_every_name_of_the_front_door_is_stable_or_provisional():
    text = (DOCS / "reference" / "stability.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(\w+)` \| (stable|provisional) \|$", text, re.MULTILINE)
    assert sorted(name for name, _ in rows) == sorted(gr.__all__)


def commands_of(page):
    """The commands of a page in their order, without comments."""
    for row in page.read_text(encoding="utf-8").splitlines():
        found = re.match(r"    (?:\$ (.*)|(gruebler (?!\w+,).*))", row)
        if found:
            yield re.sub(r"\s{2,}#.*| # .*", "", found[1] or found[2])


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("bash") is None, reason="the README is written for bash")
@pytest.mark.parametrize(("page", "least"), [("README.md", 6), ("docs/reference/tour.md", 60)])
def test_commands_of_the_readme(page, least, tmp_path):
    """In their order in one empty folder: every file that a command reads was written by one before it.

    The page's server is left out, which would wait for a browser.
    """
    shell = f'gruebler() {{ "{sys.executable}" -m gruebler "$@"; }}; set -o pipefail; '
    server = re.compile(r"gruebler explore(?!.* -o )")
    commands = [each for each in commands_of(ROOT / page) if not server.match(each)]
    assert len(commands) > least
    for each in commands:
        ran = subprocess.run(["bash", "-c", shell + each], cwd=tmp_path, capture_output=True, text=True, check=False)
        assert ran.returncode in (0, 1), f"{each}\n{ran.stderr}"
        assert ran.returncode == 0 or not ran.stderr, f"{each}\n{ran.stderr}"


def test_every_place_has_the_same_version():
    cited = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(r"^version: (.*)$", cited, re.MULTILINE)[1] == gr.__version__
    changes = re.findall(r"^## (.*)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert changes[0] == "[Unreleased]"
    assert changes[1].startswith(f"[{gr.__version__}] - 20")


def test_changes_stand_in_the_order_of_keep_a_changelog():
    order = ["Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"]
    for version in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").split("\n## ")[1:]:
        titles = re.findall(r"^### (.*)$", version, re.MULTILINE)
        assert titles == [title for title in order if title in titles]
