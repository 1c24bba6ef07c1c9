"""The page with a slider, and animations as pictures: complete in themselves, and as fast as they were asked to be."""

import json
import re
import shutil
import subprocess
from html.parser import HTMLParser
from io import BytesIO

import numpy as np
import pytest

from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.mechanics.fourbar import FourBar
from gruebler.pictures.canvas.frames import FRAMES
from gruebler.pictures.canvas.styles import COLOURS
from gruebler.pictures.linkage import animation_frames
from gruebler.pictures.linkage.animation import scene
from gruebler.pictures.linkage.animation_frames import animated_frames
from gruebler.pictures.linkage.animation_page import animated_page
from gruebler.teaching.catalog import entry

CRANK_ROCKER = FourBar(25, 70, 40, 70).linkage({"K": (35, 20)})
# A page is run by a clock that is set by hand: what is seen at some times, after the slider, after the button.
RUN = """
const script = require("fs").readFileSync(0, "utf8"), [times, slid] = JSON.parse(process.argv[1]);
let clock = 0, paused = false, frame;
const made = {}, node = () => ({textContent: "", value: 0, setAttribute() {}, click() { this.onclick() }});
const svg = {getCurrentTime: () => clock, setCurrentTime: t => { clock = t },
  pauseAnimations() { paused = true }, unpauseAnimations() { paused = false }};
globalThis.document = {getElementById: n => made[n] ??= node(), querySelector: () => svg, body: {}};
globalThis.matchMedia = () => ({matches: false});
globalThis.requestAnimationFrame = f => { frame = f };
(0, eval)(script.replace("onkeydown=", "globalThis.onkeydown="));
const seen = times.map(t => { clock = t; frame(); return made.value.textContent });
made.drive.value = slid; made.drive.oninput();
const after = [clock, made.value.textContent, paused, made.play.textContent];
onkeydown({key: " ", target: document.body, preventDefault() {}});
console.log(JSON.stringify([seen, after, paused]));
"""


class Tags(HTMLParser):
    """All tags with their attributes, and whether they are closed in order."""

    def __init__(self, text):
        super().__init__()
        self.found, self.open = [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))
        if tag not in ("meta", "input"):
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.mark.parametrize(("lang", "button", "label"), [("en", "Play", "Drive"), ("de", "Abspielen", "Antrieb")])
def test_the_page_is_complete_and_small(lang, button, label):
    page = animated_page(CRANK_ROCKER, curves=["K"], lang=lang)
    tags = Tags(page)
    assert tags.open == []
    kinds = [tag for tag, _ in tags.found]
    assert (kinds.count("svg"), kinds.count("script"), kinds.count("button")) == (1, 1, 1)
    assert not any({"src", "href", "onclick"} & set(attrs) for _, attrs in tags.found)
    attrs = dict(tags.found)["input"]
    assert (attrs["type"], attrs["aria-label"]) == ("range", label)
    assert float(attrs["max"]) - float(attrs["min"]) == 360
    assert f">{button}</button>" in page
    assert f'<html lang="{lang}">' in page
    assert "prefers-color-scheme:dark" in page
    assert "prefers-reduced-motion" in page
    assert len(page) < 15_000
    assert page == animated_page(CRANK_ROCKER, curves=["K"], lang=lang)


def test_wicked_names_stay_text():
    page = animated_page(
        FourBar(25, 70, 40, 70).linkage({"</script>": (1, 2)}), name="</script><script>alert(1)</script>"
    )
    assert page.count("<script") == 1
    assert page.count("</script>") == 1
    assert "&lt;/script&gt;&lt;script&gt;alert(1)" in page


@pytest.mark.skipif(
    shutil.which("node") is None,
    reason="node stands in for the browser that runs the page's script",
)
@pytest.mark.parametrize(
    ("linkage", "between", "slid", "shown"),
    [
        (CRANK_ROCKER, None, 90.0, "90.0°"),
        (entry("watt_axle").linkage(), (-0.9, 0.5), 0.0, "0.0°"),
        (entry("crane_cyl").linkage(), (34.5, 47.0), 40.0, "40.0 mm"),
    ],
)
def test_the_script_tells_the_drive_of_the_pose_that_is_seen(linkage, between, slid, shown):
    page = animated_page(linkage, between=between, seconds=2)
    script = re.search(r"<script>\n(.*)\n</script>", page, re.DOTALL)[1]
    scenery = scene(linkage, between=between, seconds=2)
    rows = scenery.rows
    chosen = [0, 9, len(rows) // 3, len(rows) // 2, len(rows) - 3]
    times = [scenery.seconds * k / (len(rows) - 1) for k in chosen]
    done = subprocess.run(
        [shutil.which("node"), "-e", RUN, json.dumps([times, slid])],
        input=script,
        capture_output=True,
        text=True,
        check=True,
    )
    seen, (clock, text, paused, button), again = json.loads(done.stdout)
    drives = scenery.posed.path.drives[:, 0]
    turning = scenery.posed.cycle.turning_drive
    wanted = np.degrees(drives) if turning else drives
    assert [float(word.split()[0].rstrip("°")) for word in seen] == pytest.approx(
        [wanted[rows[k]] for k in chosen], abs=0.051
    )
    assert (text, paused, button, again) == (shown, True, "Play", False)
    row = clock / scenery.seconds * (len(rows) - 1)
    assert np.interp(row, np.arange(len(wanted)), wanted) == pytest.approx(slid, abs=0.02)


@pytest.fixture
def few(monkeypatch):
    """Fewer pictures, so that it is quick."""
    pytest.importorskip("matplotlib")
    monkeypatch.setattr(animation_frames, "_MOST", 12)


@pytest.mark.parametrize("kind", FRAMES)
def test_frames(few, kind):
    from PIL import Image

    content = animated_frames(CRANK_ROCKER, kind, seconds=1.5, zoom=0.5)
    picture = Image.open(BytesIO(content))
    assert picture.n_frames == 12
    total, seen, grounds = 0.0, set(), set()
    for k in range(picture.n_frames):
        picture.seek(k)
        picture.load()
        total += picture.info["duration"]
        seen.add(picture.convert("RGB").tobytes())
        grounds.add(picture.convert("RGB").getpixel((1, 1)))
    assert total == pytest.approx(1500, abs=1)
    assert len(seen) == 12
    assert grounds == {(255, 255, 255)}
    assert picture.info.get("loop", 0) == 0
    assert content == animated_frames(CRANK_ROCKER, kind, seconds=1.5, zoom=0.5)


def test_frames_on_dark_ground_go_to_and_fro(few):
    from PIL import Image

    content = animated_frames(entry("watt_axle").linkage(), "gif", between=(-0.9, 0.5), zoom=0.5, dark=True)
    picture = Image.open(BytesIO(content))
    assert picture.n_frames == 12
    paper = tuple(int(COLOURS["paper"][1][k : k + 2], 16) for k in (1, 3, 5))
    pixels = []
    for k in range(12):
        picture.seek(k)
        pixels.append(picture.convert("RGB").tobytes())
        assert picture.convert("RGB").getpixel((1, 1)) == paper
    assert all(pixels[k] == pixels[-k] for k in range(1, 12))


def test_wrong_kinds_are_told():
    with pytest.raises(GrueblerError, match="gif, webp, png"):
        animated_frames(CRANK_ROCKER, "mp4")
    with pytest.raises(LinkageError, match="number of seconds"):
        animated_page(CRANK_ROCKER, seconds=0)


def test_without_matplotlib(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    with pytest.raises(GrueblerError, match=r"gruebler\[plot\]"):
        animated_frames(CRANK_ROCKER, "gif")
