"""Many pictures on one page: self-contained HTML without script, suitable for printing on A4."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from html import escape

from gruebler.base.notebook import brief
from gruebler.pictures.canvas.figure import Figure, svg
from gruebler.pictures.canvas.page_policy import policy_element
from gruebler.pictures.canvas.styles import COLOURS
from gruebler.pictures.canvas.svg import style_sheet


@dataclass(frozen=True, slots=True)
class Item:
    """A picture with its caption."""

    figure: Figure
    caption: str
    code: str = ""
    moving: str = ""
    """SVG that moves, shown on a page instead of the figure."""


@brief
@dataclass(frozen=True, slots=True, repr=False)
class Section:
    """Pictures under a heading."""

    heading: str
    items: tuple[Item, ...]
    wide: bool = False
    """Pictures with much to read in them: a few side by side."""


def gallery_html(title: str, sections: Iterable[Section], *, lang: str = "en", note: str = "") -> str:
    """The page: a heading and a note, then each section with its pictures side by side.

    >>> gallery_html("Six links & more", [], note="2 chains").count("&amp;")
    2
    """
    parts = [_section(section) for section in sections]
    return _PAGE.format(
        lang=lang,
        policy=policy_element(),
        title=escape(title),
        note=escape(note),
        pictures=style_sheet(),
        ink=COLOURS["ink"],
        paper=COLOURS["paper"],
        faint=COLOURS["faint"],
        body="\n".join(parts),
    )


def _section(section: Section) -> str:
    heading = f"<h2>{escape(section.heading)}</h2>\n" if section.heading else ""
    row = "row wide" if section.wide else "row"
    return f'<section>\n{heading}<div class="{row}">\n{"".join(map(_item, section.items))}</div>\n</section>'


def _item(item: Item) -> str:
    code = f"<code>{escape(item.code)}</code>" if item.code else ""
    picture = item.moving or svg(item.figure, styled=False)
    return f"<figure>{picture}<figcaption>{escape(item.caption)}{code}</figcaption></figure>\n"


_PAGE = """<!DOCTYPE html>
<html lang="{lang}">
<head>
<meta charset="utf-8">
{policy}
<meta name="viewport" content="width=device-width">
<meta name="color-scheme" content="light dark">
<title>{title}</title>
<style>
{pictures}
body{{font-family:sans-serif;margin:1.5rem;color:{ink[0]};background:{paper[0]}}}
h1{{font-size:1.4rem;margin:0 0 .3rem}}
h2{{font-size:1.05rem;margin:1.2rem 0 .4rem;break-after:avoid}}
p{{margin:0 0 .6rem}}
.row{{display:grid;grid-template-columns:repeat(auto-fill,minmax(11rem,1fr));gap:.8rem;align-items:end}}
.wide{{grid-template-columns:repeat(auto-fill,minmax(20rem,1fr))}}
figure{{margin:0;text-align:center;break-inside:avoid}}
figure svg{{max-width:100%;max-height:14rem;height:auto}}
.wide figure svg{{max-height:22rem}}
.wide figure:only-child{{grid-column:1/-1;text-align:left}}.wide figure:only-child svg{{max-height:none}}
figcaption{{font-size:.85rem}}
code{{display:block;font-size:.62rem;color:{faint[0]};overflow-wrap:anywhere}}
@media(prefers-color-scheme:dark){{body{{color:{ink[1]};background:{paper[1]}}}code{{color:{faint[1]}}}}}
@page{{size:A4;margin:14mm}}
@media print{{body{{margin:0;color:#000;background:#fff}}
.row{{grid-template-columns:repeat(5,1fr)}}figure svg{{max-height:36mm}}
.wide{{grid-template-columns:repeat(2,1fr)}}.wide figure svg{{max-height:80mm}}}}
</style>
</head>
<body>
<h1>{title}</h1>
<p>{note}</p>
{body}
</body>
</html>
"""
