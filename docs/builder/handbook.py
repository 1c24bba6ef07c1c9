"""The site as one PDF to print or to keep: `python docs/builder/handbook.py build/docs/html handbook.pdf`.

The pages of the built site, in the order of its navigation, become the chapters of one document; a browser prints it:
links lead from page to page of the PDF, headings are its outline. What is looked up rather than read stays on the site:
names by room, schemas, decisions, the project, tables, changelog.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import unquote, urlsplit

from bs4 import BeautifulSoup, Tag
from pypdf import PdfReader, PdfWriter

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome", "msedge")
_LEFT_OUT = (
    "reference/api/",
    "reference/schema",
    "decisions/",
    "project/",
    "tables/",
    "changelog",
    "cluster",
    "reliability",
)
_WORDS = {
    "en": ("Handbook, version {version}", "Contents"),
    "de": ("Handbuch, Version {version}", "Inhalt"),
}
_STYLE = (Path(__file__).parent / "handbook.css").read_text(encoding="utf-8")
_BARE = 60  # characters: a page with less text is a heading, and the next one follows on the same sheet
_SECONDS = 900  # for one language; a browser that hangs is ended


class Chapter(NamedTuple):
    """A page of the site."""

    path: str
    """Below the folder of the site, such as ``theory/mobility.html``."""
    depth: int
    """1 for an entry of the navigation, 2 for a page below one."""


def chapters(site: Path) -> Iterator[Chapter]:
    """The pages in the order of the navigation, each once."""
    page = BeautifulSoup((site / "index.html").read_text(encoding="utf-8"), "html.parser")
    seen: set[str] = set()
    for link in page.select(".sidebar-tree a.reference.internal"):
        path = str(link["href"])
        if "#" not in path and path not in seen and not path.startswith(_LEFT_OUT):
            seen.add(path)
            yield Chapter(path, len([above for above in link.parents if above.name == "ul"]))


def document(site: Path, lang: str) -> str:
    """All chapters as one HTML document; names of places begin with the page, so that none stands twice."""
    pages = list(chapters(site))
    known = {page.path: _name(page.path) for page in pages}
    parts = [str(_article(site, page, known)) for page in pages]
    style = f'<link rel="stylesheet" href="{(site / "_static" / "pygments.css").as_uri()}"><style>{_STYLE}</style>'
    return f'<!doctype html><html lang="{lang}"><meta charset="utf-8">{style}<body>{"".join(parts)}</body></html>'


def _name(path: str) -> str:
    return re.sub(r"\W+", "-", path.removesuffix(".html"))


def _article(site: Path, page: Chapter, known: dict[str, str]) -> Tag:
    """The text of a page as a section, its headings as far down as the page stands in the navigation."""
    parsed = BeautifulSoup((site / page.path).read_text(encoding="utf-8"), "html.parser")
    article = parsed.select_one("article")
    assert isinstance(article, Tag), page.path
    here, name = (site / page.path).parent, known[page.path]
    for needless in article.select(".headerlink, .picture-file, details > summary, .toctree-wrapper"):
        needless.decompose()
    for code in article.select("details"):
        code.name = "div"
    for part in article.select("[id]"):
        part["id"] = f"{name}--{part['id']}"
    for heading in article.select("h1, h2, h3, h4, h5"):
        heading.name = f"h{min(int(heading.name[1]) + page.depth - 1, 6)}"
    for image in article.select("img"):
        image["src"] = (here / unquote(str(image["src"]))).resolve().as_uri()
    for link in article.select("a[href]"):
        target = _target(site, here, page.path, str(link["href"]), known)
        if target is None:
            link.unwrap()
        else:
            link["href"] = target
    bare = " bare" if len(article.get_text(strip=True)) < _BARE else ""
    article.name, article["id"], article["class"] = "section", name, f"chapter depth-{page.depth}{bare}"
    return article


def _target(site: Path, here: Path, path: str, link: str, known: dict[str, str]) -> str | None:
    """Where a link leads in the document; None if to a page that is not in it."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return link
    aim = Path(os.path.relpath(here / unquote(parts.path), site)).as_posix() if parts.path else path
    if aim not in known:
        return None
    return f"#{known[aim]}--{parts.fragment}" if parts.fragment else f"#{known[aim]}"


# --- printing --------------------------------------------------------------------------------------


def broken_links(html: str) -> set[str]:
    """Links of a document to places that it does not have."""
    parsed = BeautifulSoup(html, "html.parser")
    places = {f"#{part['id']}" for part in parsed.select("[id]")}
    return {str(link["href"]) for link in parsed.select('a[href^="#"]')} - places


def printed(html: str, target: Path, folder: Path) -> None:
    """Print a document by the browser that is installed."""
    browser = os.environ.get("BROWSER_FOR_PDF") or next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        sys.exit(f"no browser is here that prints: {', '.join(BROWSERS)}; BROWSER_FOR_PDF=PATH names one")
    source = folder / "handbook.html"
    source.write_text(html, encoding="utf-8")
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer"]
    command += ["--generate-pdf-document-outline", "--virtual-time-budget=20000", f"--user-data-dir={folder / 'user'}"]
    subprocess.run(
        [*command, f"--print-to-pdf={target}", source.as_uri()], check=True, capture_output=True, timeout=_SECONDS
    )


def contents(outline: list[Any], reader: PdfReader, depth: int = 1) -> Iterator[tuple[str, int, int]]:
    """Title, page and depth of the chapters, and of the pages below them."""
    for entry in outline:
        if isinstance(entry, list):
            if depth < 2:
                yield from contents(entry, reader, depth + 1)
        else:
            number = reader.get_destination_page_number(entry)
            yield str(entry.title), (0 if number is None else number) + 1, depth


def _front(rows: list[tuple[str, int, int]], lang: str, version: str) -> str:
    """Title page and table of contents."""
    title, heading = _WORDS[lang]
    lines = "".join(
        f'<div class="row depth-{depth}"><span>{escape(text)}</span><i></i><span>{page}</span></div>'
        for text, page, depth in rows
    )
    style = f"{_STYLE} @page {{ @bottom-center {{ content: none }} }}"
    return (
        f'<!doctype html><html lang="{lang}"><meta charset="utf-8"><style>{style}</style>'
        f'<body><div class="title"><p class="name">gruebler</p><p>{title.format(version=version)}</p></div>'
        f'<div class="contents"><p class="heading">{heading}</p>{lines}</div></body></html>'
    )


def write_handbook(site: Path, target: Path, lang: str, version: str) -> int:
    """Write the PDF of one language; returns the number of its pages."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        html = document(site.resolve(), lang)
        if broken := broken_links(html):
            sys.exit(f"links that lead nowhere: {', '.join(sorted(broken))}")
        printed(html, folder / "chapters.pdf", folder)
        reader = PdfReader(folder / "chapters.pdf")
        rows = list(contents(reader.outline, reader))
        printed(_front(rows, lang, version), folder / "front.pdf", folder)
        writer = PdfWriter(clone_from=reader)
        front = PdfReader(folder / "front.pdf")
        for number, page in enumerate(front.pages):
            writer.insert_page(page, number)
        writer.set_page_label(0, len(front.pages) - 1, style="/r")
        writer.set_page_label(len(front.pages), len(writer.pages) - 1, style="/D", start=1)
        writer.page_mode = "/UseOutlines"
        writer.add_metadata({"/Title": f"gruebler {version}: {_WORDS[lang][0].split(',')[0]}"})
        target.parent.mkdir(parents=True, exist_ok=True)
        writer.write(target)
        return len(writer.pages)


def main() -> None:
    """Write the handbook of one language."""
    parser = argparse.ArgumentParser(description="The built site as one PDF.")
    parser.add_argument("site", type=Path, help="folder of the built site in one language")
    parser.add_argument("target", type=Path, help="the PDF")
    parser.add_argument("--lang", choices=sorted(_WORDS), default="en")
    given = parser.parse_args()
    import gruebler

    pages = write_handbook(given.site, given.target, given.lang, gruebler.__version__)
    print(f"{given.target}: {pages} pages")


if __name__ == "__main__":
    main()
