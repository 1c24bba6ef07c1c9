"""The handbook: pages of a site as one PDF, with its outline, page numbers and links from page to page."""

import shutil
import sys
from pathlib import Path

import pytest
from pypdf import PdfReader

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / "docs"))
from builder import handbook  # noqa: E402  after the path is set

INDEX = """<div class="sidebar-tree"><ul>
<li><a class="reference internal" href="start.html">Start</a></li>
<li><a class="reference internal" href="theory/index.html">Theory</a><ul>
<li><a class="reference internal" href="theory/cams.html">Cams</a></li>
<li><a class="reference internal" href="theory/cams.html#lift">Lift</a></li></ul></li>
<li><a class="reference internal" href="changelog.html">Changelog</a></li></ul></div>"""
START = """<nav>left out</nav><article><section id="start"><h1>Start<a class="headerlink" href="#start">¶</a></h1>
<p>See <a href="theory/cams.html#lift">the lift of a cam</a> and <a href="changelog.html">what is new</a>, on a page of
its own; more words follow here.</p></section></article>"""
THEORY = '<article><section id="theory"><h1>Theory</h1></section></article>'
CAMS = """<article><section id="cams"><h1>Cams</h1><section id="lift"><h2>Lift</h2>
<p>Back to <a href="../start.html">the start</a>, <a href="#cams">to the top</a>.</p></section></section></article>"""


@pytest.fixture
def site(tmp_path):
    (tmp_path / "_static").mkdir()
    (tmp_path / "_static" / "pygments.css").touch()
    (tmp_path / "theory").mkdir()
    pages = {"index": INDEX, "start": START, "theory/index": THEORY, "theory/cams": CAMS}
    for name, text in pages.items():
        (tmp_path / f"{name}.html").write_text(text, encoding="utf-8")
    return tmp_path


def test_pages_stand_in_the_order_of_the_navigation_each_once(site):
    assert list(handbook.chapters(site)) == [("start.html", 1), ("theory/index.html", 1), ("theory/cams.html", 2)]


def test_links_lead_from_page_to_page_of_the_document(site):
    html = handbook.document(site, "en")
    assert '<a href="#theory-cams--lift">the lift of a cam</a>' in html
    assert '<a href="#start">the start</a>' in html
    assert '<a href="#theory-cams--cams">to the top</a>' in html
    assert "what is new" in html, "a link to a page on the site alone leaves its words"
    assert "changelog" not in html
    assert "left out" not in html
    assert not handbook.broken_links(html)
    assert handbook.broken_links(html.replace('id="theory-cams--lift"', "")) == {"#theory-cams--lift"}


def test_headings_lie_below_those_of_the_page_above(site):
    html = handbook.document(site, "en")
    assert "<h2>Cams</h2>" in html
    assert "<h3>Lift</h3>" in html


@pytest.mark.skipif(not any(map(shutil.which, handbook.BROWSERS)), reason="no browser that prints")
def test_the_pdf_has_contents_outline_and_page_numbers(site, tmp_path):
    target = tmp_path / "made" / "handbook.pdf"
    assert handbook.write_handbook(site, target, "de", "9.9") == 4
    reader = PdfReader(target)
    texts = [page.extract_text() for page in reader.pages]
    assert "Version 9.9" in texts[0]
    assert texts[1].split()[-6:] == ["Start", "1", "Theory", "2", "Cams", "2"]
    assert ["1" in texts[2].split(), "2" in texts[3].split()] == [True, True], "the numbers at the foot"
    start, theory, below = reader.outline[:3]
    assert (start.title, theory.title, below[0].title) == ("Start", "Theory", "Cams")
    assert [reader.get_destination_page_number(entry) for entry in (start, theory, below[0])] == [2, 3, 3]
    assert reader.page_labels == ["i", "ii", "1", "2"]
