"""The glossary in German: what terms mean, and where they come from."""

from pathlib import Path

from babel.messages.pofile import read_po

DOCS = Path(__file__).parents[2] / "docs"


def rows():
    """The rows of all tables: English, German, symbol, meaning, source."""
    lines = (DOCS / "glossary.md").read_text(encoding="utf-8").splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]
    return [row for row in cells if row[0] != "English" and set(row[0]) != {"-"}]


def test_every_meaning_is_german_in_the_german_glossary():
    with (DOCS / "locale/de/LC_MESSAGES/glossary.po").open("rb") as file:
        catalog = {entry.id: entry.string for entry in read_po(file, locale="de")}
    assert len(rows()) > 200
    assert [row[0] for row in rows() if row[3] and catalog.get(row[3], row[3]) == row[3]] == []
    # The terms themselves stay, set apart: a text equal to its original counts as not translated.
    assert [row[0] for row in rows() if not catalog.get(row[0], "").strip()] == []
    assert [row[1] for row in rows() if not catalog.get(row[1], "").strip()] == []
    texts = {row[3] for row in rows()}
    english = {" ".join(words) for words in (("of", "the"), ("that", "is"), ("turns", "fully"))}
    assert [text for text in texts if any(part in catalog.get(text, "") for part in english)] == []
