"""Pages of tables that are German throughout: the glossary and the misprints."""

import re
from pathlib import Path

import pytest
from babel.messages.pofile import read_po

DOCS = Path(__file__).parents[2] / "docs"
SAME = {"f = 0, u = b"}  # one word or letter in both languages


def rows(page):
    """The rows of all tables, without their heads."""
    lines = (DOCS / f"{page}.md").read_text(encoding="utf-8").splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]
    rules = {number for number, row in enumerate(cells) if set(row[0]) == {"-"}}
    return [row for number, row in enumerate(cells) if not {number, number + 1} & rules]


@pytest.mark.parametrize(("page", "least"), [("glossary", 200), ("misprints", 20)])
def test_every_cell_is_german_on_the_german_page(page, least):
    with (DOCS / f"locale/de/LC_MESSAGES/{page}.po").open("rb") as file:
        catalog = {entry.id: entry.string for entry in read_po(file, locale="de")}
    assert len(rows(page)) > least
    texts = {cell for row in rows(page) for cell in row if re.search("[a-z]{3}", cell)} - SAME
    # Terms are set apart there: a text that equals its original counts as not translated.
    assert {text for text in texts if catalog.get(text, text) == text} == set()
    words = re.compile(r"\b(the|and|that|which|turns|has)\b")
    said = {re.sub(r"\*[^*]*\*", "", catalog[text]) for text in texts}  # English terms are in italics
    assert {text for text in said if words.search(text)} == set()
