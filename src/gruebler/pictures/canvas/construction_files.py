"""Files of a construction: a page with a slider for the steps, PDF with one page for each, all pictures in one."""

from __future__ import annotations

import json
from html import escape

from gruebler.base.text import translate
from gruebler.pictures.canvas.arrangement import pictures_in_one
from gruebler.pictures.canvas.construction import Construction
from gruebler.pictures.canvas.files import picture_bytes
from gruebler.pictures.canvas.page_policy import policy_element, script_element
from gruebler.pictures.canvas.styles import COLOURS
from gruebler.pictures.canvas.svg import style_sheet

CONSTRUCTION_SUFFIXES = ("html", "pdf", "svg", "png", "tex")


def construction_bytes(whole: Construction, suffix: str, lang: str = "en", *, step: int | None = None) -> bytes:
    """The content of a file: all steps, or one of them (from 1; not with ``html``).

    ``html`` is one page with a slider, ``pdf`` has one page for each step; ``svg``, ``png`` and ``tex`` show the
    pictures side by side. `GrueblerError` if there is no such step, or if matplotlib is needed and missing.
    """
    if step is not None:
        return picture_bytes(whole.figure(step, lang), "svg" if suffix == "html" else suffix)
    if suffix == "html":
        return steps_html(whole, lang).encode("utf-8")
    figures = whole.figures(lang)
    if suffix == "pdf":
        from gruebler.pictures.canvas.matplotlib_files import pages_pdf

        return pages_pdf(whole.title.in_language(lang), figures)
    return picture_bytes(pictures_in_one(figures, whole.title.in_language(lang)), suffix)


_STYLE = (
    ":root{{color-scheme:light dark}}body{{margin:0;font:16px sans-serif;background:{light};color:{ink}}}"
    "main{{max-width:46rem;margin:auto;padding:1rem}}h1{{font-size:1.2rem}}figure{{margin:0 0 1rem}}"
    "svg{{width:100%;height:auto}}figcaption{{font-size:1.05rem;line-height:1.4;min-height:4.2em}}"
    "nav{{display:none;gap:.7rem;align-items:center;margin:.6rem 0}}.on nav{{display:flex}}"
    "button{{font:inherit;padding:.4rem .9rem}}input{{flex:1;accent-color:{accent}}}"
    ".on figure{{display:none}}.on figure.seen{{display:block}}"
    "@media(prefers-color-scheme:dark){{body{{background:{dark};color:{pale}}}}}"
    "@media print{{nav{{display:none!important}}.on figure{{display:block;break-inside:avoid}}}}"
)
# Without script all steps stand below one another.
_SCRIPT = """\
const m=document.querySelector("main"),f=[...m.querySelectorAll("figure")],s=document.getElementById("step"),
o=document.getElementById("value"),n=%s;m.classList.add("on");
const show=k=>{k=Math.max(0,Math.min(f.length-1,k));f.forEach((e,j)=>e.classList.toggle("seen",j==k));
s.value=k+1;o.textContent=n.replace("#",k+1)};
s.oninput=()=>show(+s.value-1);
document.getElementById("back").onclick=()=>show(+s.value-2);
document.getElementById("next").onclick=()=>show(+s.value);
onkeydown=e=>{if(e.target!=document.body)return;const d={ArrowLeft:-1,ArrowRight:1}[e.key];if(d)show(+s.value-1+d)};
show(0);"""


def steps_html(whole: Construction, lang: str = "en") -> str:
    """One page with a slider for the steps, self-contained; printed, it shows all of them."""
    figures = whole.figures(lang, captions=False)
    count = len(figures)
    title = escape(whole.title.in_language(lang))
    colours = dict(zip(("light", "dark"), COLOURS["paper"], strict=True))
    colours |= {"ink": COLOURS["ink"][0], "pale": COLOURS["ink"][1], "accent": COLOURS["motion"][0]}
    shown = json.dumps(translate("step {number} of {count}", lang, number="#", count=count), ensure_ascii=False)
    pictures = "\n".join(
        f"<figure>{figure.svg(styled=False)}<figcaption>{k}. {escape(figure.description)}</figcaption></figure>"
        for k, figure in enumerate(figures, 1)
    )
    used = sorted({"ground", *(shape.style for figure in figures for shape in figure.shapes)})
    back, following, slider = translate("Back", lang), translate("Next", lang), translate("Step", lang)
    script = f"\n{_SCRIPT % shown.replace('<', chr(92) + 'u003c')}\n"
    return (
        f'<!doctype html>\n<html lang="{lang}">\n<meta charset="utf-8">\n{policy_element(script)}\n'
        f'<meta name="viewport" content="width=device-width,initial-scale=1">\n<title>{title}</title>\n'
        f"<style>{style_sheet(used)}{_STYLE.format(**colours)}</style>\n<main>\n<h1>{title}</h1>\n"
        f'<nav><button type="button" id="back">{back}</button>'
        f'<input type="range" id="step" min="1" max="{count}" value="1" aria-label="{slider}">'
        f'<button type="button" id="next">{following}</button><output id="value" for="step"></output></nav>\n'
        f"{pictures}\n</main>\n{script_element(script)}\n</html>\n"
    )
