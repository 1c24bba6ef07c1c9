"""German pages keep up with the English ones: a paragraph that was changed has its German in the same commit.

`make docs` finds every text without translation; this finds changed paragraphs without Sphinx.
"""

import re
from pathlib import Path

import pytest
from babel.messages.pofile import read_po

DOCS = Path(__file__).parents[1] / "docs"
CATALOGS = DOCS / "locale" / "de" / "LC_MESSAGES"
NOT_TEXT = re.compile(r"^(```|:::).*?^\1$", re.MULTILINE | re.DOTALL)


def letters(text):
    """What of a text does not depend on marks, references and line breaks."""
    return re.sub(r"[\W_]+", "", re.sub(r"\]\([^)]*\)|\{\w+\}", "", text))


def translations(page):
    """The texts of a page with their German; none for pages of which only the title is German."""
    with (CATALOGS / page.relative_to(DOCS).with_suffix(".po")).open("rb") as file:
        found = [entry for entry in read_po(file, locale="de") if entry.id and entry.string]
    return found if len(found) > 1 else []


def paragraphs(text):
    """Plain paragraphs of a page, without headings, lists, tables, formulas and what is run."""
    for block in re.split(r"\n\s*\n|\n(?=#)", NOT_TEXT.sub("", text)):
        words = re.findall(r"[A-Za-z]{3,}", block)
        if re.match(r"[A-Z*`\[]\S*\s", block) and len(words) > 8 and not re.search(r"\n( {4}|[-*] |\d+\. |\|)", block):
            yield block


PAGES = [page for page in sorted(DOCS.rglob("*.md")) if (CATALOGS / page.relative_to(DOCS).with_suffix(".po")).exists()]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(DOCS).as_posix())
def test_every_paragraph_of_a_german_page_has_its_german(page):
    known = {letters(entry.id) for entry in translations(page)}
    without = [p for p in paragraphs(page.read_text(encoding="utf-8")) if letters(p) not in known]
    assert not known or not without
