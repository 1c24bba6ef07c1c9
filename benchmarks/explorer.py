"""Frames of the page in a real browser: a joint is dragged, the linkage and its whole cycle drawn anew each time.

Machines in space are played.
"""

import shutil
import statistics
import tempfile
from pathlib import Path
from typing import Any

from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.linkages import Linkage
from gruebler.page.model import model_of
from gruebler.page.page import single_file
from gruebler.page.space_page import machine_model, space_file
from gruebler.structure.mechanism import Mechanism

IN_SPACE = ("wiper_rssr", "schatz", "diff_bevel", "delta", "gough")
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")

JANSEN = "R(0-1) R(1-2-4) R(2-3) R(0-3-5) R(3-6) R(6-7) R(4-5-7); frame=0; drive=R(0-1)"
CLASS_THREE = "R(0-1) R(1-2) R(2-3) R(3-4) R(0-4) R(3-5) R(0-5); drive=R(0-1)"
TRIANGLE = {0: (0, 0), 1: (0, 20), 2: (40, 60), 3: (90, 70), 4: (110, 0), 5: (70, 40), 6: (60, 0)}


def meeting(one: complex, two: complex, first: float, second: float, side: int) -> complex:
    """Where circles about two points meet, left (1) or right (-1) of the line from the first to the second."""
    way = two - one
    d = abs(way)
    along = (d * d + first * first - second * second) / (2 * d)
    return one + way / d * complex(along, side * (first * first - along * along) ** 0.5)


def jansens_leg() -> Linkage:
    """Jansen's leg with its usual lengths: crank 15, then b 41.5, c 39.3, d 40.1, e 55.8, f 39.4, g 36.7, h 65.7, i 49,
    j 50, k 61.9; the frame's second pivot lies 38 to the left and 7.8 below."""
    crank, pivot = 15 + 0j, -38 - 7.8j
    upper = meeting(crank, pivot, 50.0, 41.5, -1)
    lower = meeting(crank, pivot, 61.9, 39.3, 1)
    ear = meeting(upper, pivot, 55.8, 40.1, -1)
    knee = meeting(ear, lower, 39.4, 36.7, -1)
    foot = meeting(knee, lower, 65.7, 49.0, -1)
    drawn = {number: (z.real, z.imag) for number, z in enumerate((0j, crank, upper, pivot, ear, knee, lower))}
    return Linkage.from_drawing(Mechanism.parse(JANSEN), drawn, points={"foot": ("7", foot.real, foot.imag)})


def samples() -> dict[str, tuple[Linkage, str]]:
    """What is dragged, and at which joint."""
    bar = FourBar(25, 70, 40, 70).linkage({"K": (45, 40)})
    six = Linkage.from_drawing(Mechanism.parse(CLASS_THREE), TRIANGLE, points={"K": ("3", 70.0, 90.0)})
    return {
        "four-bar": (bar, "R(coupler-rocker)"),
        "Jansen's leg": (jansens_leg(), "R(2-3)"),
        "six-bar of class III": (six, "R(3-4)"),
    }


def main() -> None:
    """Print median and 95 % of the work of a frame, and of the time from frame to frame."""
    path = next((found for name in BROWSERS if (found := shutil.which(name))), None)
    if path is None:
        print("no browser is here")
        return
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as made, sync_playwright() as play:
        browser = play.chromium.launch(executable_path=path, args=["--no-sandbox"])
        for name, (linkage, joint) in samples().items():
            file = Path(made) / "page.html"
            file.write_text(single_file(model_of(linkage, name=name)), encoding="utf-8")
            page = browser.new_page(viewport={"width": 1280, "height": 860})
            page.goto(file.as_uri())
            page.wait_for_timeout(1500)
            box = page.locator(f'.stage [data-joint="{joint}"] .joint').bounding_box()
            assert box is not None
            x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
            page.evaluate(
                "() => { window.beats = []; let last = performance.now(); const beat = (now) => {"
                "beats.push(now - last); last = now; window.beating = requestAnimationFrame(beat); };"
                "requestAnimationFrame(beat); gruebler.motion.frames.length = 0; }"
            )
            page.mouse.move(x, y)
            page.mouse.down()
            for k in range(300):
                page.mouse.move(x + 14 * (k % 40 - 20) / 20, y + 9 * (k % 56 - 28) / 28)
            page.mouse.up()
            work, beats = page.evaluate("[gruebler.motion.frames, window.beats]")
            cycle = page.evaluate("gruebler.motion.linkage.cycle.values.length")
            print(f"{name:22} {cycle} poses: work {shown(work)}, frame to frame {shown(beats[1:])}, {len(work)} frames")
            page.close()
        browser.close()
        options = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]
        browser = play.chromium.launch(executable_path=path, args=options)
        for id in IN_SPACE:
            file = Path(made) / "space.html"
            file.write_text(space_file(machine_model(id)), encoding="utf-8")
            page = browser.new_page(viewport={"width": 900, "height": 700})
            page.goto(file.as_uri())
            work = [played(page) for _ in range(3)]
            print(f"{id:22} played: {min(work):.1f} ms of processor time a frame")
            page.close()
        browser.close()


def played(page: Any, seconds: float = 4.0) -> float:
    """Milliseconds of processor time of the page's thread for a frame, while the machine plays."""
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    page.evaluate(
        "() => { window.frames_ = 0; const count = () => { window.frames_++; requestAnimationFrame(count); };"
        "requestAnimationFrame(count); }"
    )

    def state() -> tuple[float, int]:
        metrics = {each["name"]: each["value"] for each in session.send("Performance.getMetrics")["metrics"]}
        return metrics["TaskDuration"], page.evaluate("window.frames_")

    start, first = state()
    page.wait_for_timeout(1000 * seconds)
    end, last = state()
    return 1000 * (end - start) / (last - first)


def shown(values: list[float]) -> str:
    """Median and 95 % in milliseconds."""
    ordered = sorted(values)
    return f"{statistics.median(ordered):5.1f} ms (95 %: {ordered[int(0.95 * (len(ordered) - 1))]:5.1f} ms)"
