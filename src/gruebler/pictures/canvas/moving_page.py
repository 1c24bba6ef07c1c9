"""One HTML page around a moving SVG, with play, pause and a slider for the drive."""

from __future__ import annotations

import json
from html import escape
from typing import TypedDict

from gruebler.base.text import translate
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.page_policy import policy_element, script_element
from gruebler.pictures.canvas.styles import COLOURS

_STYLE = (
    ":root{{color-scheme:light dark}}body{{margin:0;font:16px sans-serif;background:{light};color:{ink}}}"
    "main{{max-width:{width}px;margin:auto;padding:1rem}}h1{{font-size:1.2rem}}svg{{max-width:100%;height:auto}}"
    "div{{display:flex;gap:.7rem;align-items:center}}button{{font:inherit;min-width:7rem;padding:.4rem}}"
    "input{{flex:1;min-width:6rem;accent-color:{accent}}}output{{min-width:5.5rem;text-align:right;"
    "font-variant-numeric:tabular-nums}}"
    "@media(prefers-color-scheme:dark){{body{{background:{dark};color:{pale}}}}}"
)


_SCRIPT = """\
const m=%s,$=n=>document.getElementById(n),v=document.querySelector("svg"),b=$("play"),s=$("drive"),o=$("value");
let on=!matchMedia("(prefers-reduced-motion:reduce)").matches;
const at=t=>m.low+(m.high-m.low)*(m.round?t/m.seconds%%1:Math.sin(Math.PI*t/m.seconds)**2),
time=q=>{const p=Math.min(1,Math.max(0,(q-m.low)/(m.high-m.low)));
return m.seconds*(m.round?p:Math.asin(Math.sqrt(p))/Math.PI)},
show=q=>{o.textContent=q.toFixed(m.places)+m.unit;s.setAttribute("aria-valuetext",o.textContent)},
run=()=>{b.textContent=on?m.pause:m.play;on?v.unpauseAnimations():v.pauseAnimations()},
tick=()=>{if(on){const q=at(v.getCurrentTime());s.value=q;show(q)}requestAnimationFrame(tick)};
b.onclick=()=>{on=!on;run()};
s.oninput=()=>{on=false;run();v.setCurrentTime(time(+s.value));show(+s.value)};
onkeydown=e=>{if(e.target!=document.body)return;const k={ArrowLeft:-1,ArrowDown:-1,ArrowRight:1,ArrowUp:1}[e.key];
if(e.key==" "){e.preventDefault();b.click()}else if(k){e.preventDefault();s.stepUp(8*k);s.oninput()}};
run();show(at(0));tick();"""


class PageSettings(TypedDict):
    """The settings of the script: the range of the drive and the time."""

    low: float
    high: float
    seconds: float
    round: bool
    """Evenly from low to high; else to and fro."""
    places: int
    unit: str


def moving_page_html(picture: str, about: Figure, settings: PageSettings, lang: str) -> str:
    """The page around an animated SVG, with the title and description of a figure."""
    low, high = settings["low"], settings["high"]
    colours = dict(zip(("light", "dark"), COLOURS["paper"], strict=True))
    colours |= {"ink": COLOURS["ink"][0], "pale": COLOURS["ink"][1], "accent": COLOURS["motion"][0]}
    play, drive = translate("Play", lang), translate("Drive", lang)
    keys = translate("Space: play or pause. Arrow keys: the drive.", lang)
    known = json.dumps({**settings, "play": play, "pause": translate("Pause", lang)}, ensure_ascii=False)
    script = f"\n{_SCRIPT % known.replace('<', chr(92) + 'u003c')}\n"
    title, description = escape(about.title), escape(about.description)
    slider = f'type="range" id="drive" min="{low:.6g}" max="{high:.6g}" step="{(high - low) / 720:.4g}"'
    return "\n".join(
        [
            f'<!doctype html>\n<html lang="{lang}">\n<meta charset="utf-8">',
            policy_element(script),
            f'<meta name="viewport" content="width=device-width,initial-scale=1">\n<title>{title}</title>',
            f"<style>{_STYLE.format(width=max(480, round(about.width)), **colours)}</style>",
            f"<main>\n<h1>{title}</h1>\n{picture}",
            f'<div><button type="button" id="play">{play}</button>',
            f'<input {slider} aria-label="{drive}"><output id="value" for="drive"></output></div>',
            f"<p><small>{keys}</small></p>\n<p><small>{description}</small></p>\n</main>",
            f"{script_element(script)}\n</html>\n",
        ]
    )
