"""What the README and its longer page show is what happens."""

import doctest
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

README = Path(__file__).parents[1] / "README.md"
TOUR = README.parent / "docs" / "reference" / "tour.md"
PICTURES = {
    "lambda.svg": "animate lambda --curve C",
    "eight.svg": "gallery --links 8",
    "mu.svg": "plot four-bar:25,70,40,70 --kind transmission",
}


@pytest.mark.parametrize("page", [README, TOUR], ids=["readme", "tour"])
def test_examples_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = doctest.testfile(str(page), module_relative=False, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert result.attempted > 5
    assert result.failed == 0


def test_the_readme_is_short():
    text = README.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 120
    assert set(re.findall(r'src="docs/_static/([^"]*)"', text)) == set(PICTURES)


@pytest.mark.parametrize("name", PICTURES)
def test_pictures_of_the_readme_are_drawn_by_their_commands(name, tmp_path):
    """The same texts, shapes and styles; places may differ in the last digit between processors."""
    path = tmp_path / name
    subprocess.run([sys.executable, "-m", "gruebler", *PICTURES[name].split(), "-o", path], check=True)
    drawn, kept = (
        [(element.tag, element.get("class"), element.text) for element in ElementTree.parse(file).iter()]
        for file in (path, README.parent / "docs" / "_static" / name)
    )
    assert drawn == kept


def test_links_between_pages_lead_somewhere():
    root = README.parent
    others = {".venv", "build", "node_modules"}
    pages = [path for path in root.rglob("*.md") if not others & set(path.relative_to(root).parts)]
    assert len(pages) > 5
    for page in pages:
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", page.read_text(encoding="utf-8")):
            assert "://" in target or (page.parent / target).exists(), f"{page.name}: {target}"
