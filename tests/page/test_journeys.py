"""Five journeys of somebody who has not read anything, with counted clicks: on desk and phone, in both languages.

The counts are what the shortest way takes today; a view that needs more of them has become worse.
"""

import os
import re
from pathlib import Path

import pytest

from gruebler.files.values import write
from gruebler.mechanics.fourbar import FourBar

pytestmark = pytest.mark.slow

PICTURES = os.environ.get("GRUEBLER_JOURNEYS", "")
"""A folder for a picture of the end of each journey."""


class Reader:
    """Somebody at a page, who clicks or taps; a field that is filled counts as one."""

    def __init__(self, tab, address: str, width: int, locale: str) -> None:
        height = 900 if width > 500 else 844
        self.touch, self.name = width < 500, f"{width}-{locale[:2]}"
        self.tab = tab(width=width, height=height, locale=locale, touch=self.touch).open(address)
        self.page, self.clicks = self.tab.page, 0
        self.page.set_default_timeout(60_000)

    def click(self, selector: str, number: int = 0) -> None:
        found = self.page.locator(selector).nth(number)
        if self.touch:
            found.tap()
        else:
            found.click()
        self.clicks += 1

    def fill(self, selector: str, text: str, number: int = 0) -> None:
        field = self.page.locator(selector).nth(number)
        field.fill(text)
        field.press("Enter")
        self.clicks += 1

    def put(self, screen: str, *places: tuple[float, float]) -> None:
        """Click at places of a plane; `screen` gives the pixel of the window of $x, $y."""
        for x, y in places:
            at = self.page.evaluate(screen.replace("$x", str(x)).replace("$y", str(y)))
            if self.touch:
                self.page.touchscreen.tap(*at)
            else:
                self.page.mouse.click(*at)
            self.clicks += 1

    def plays(self) -> None:
        """Play, and see that it moves."""
        before = self.page.evaluate("gruebler.motion.linkage.drives[0]")
        self.click(".transport .play")
        self.tab.until(f"gruebler.motion.linkage.drives[0] !== {before}")

    def end(self, journey: str, most: int) -> None:
        if PICTURES:
            self.page.screenshot(path=Path(PICTURES) / f"{journey}-{self.name}.png")
        assert self.clicks <= most


@pytest.fixture(
    params=[(1440, "en-US"), (1440, "de-DE"), (390, "en-US"), (390, "de-DE")], ids=lambda one: str(one[0]) + one[1]
)
def reader(request, tab, server):
    return Reader(tab, server.address, *request.param)


def test_a_six_bar_moves_and_draws_a_curve(reader):
    reader.click('[data-view="structure"]')
    reader.page.locator("[data-chain]").wait_for()  # one: that of the four-bar at hand
    reader.fill('[data-page="structure"] input[type="number"]', "6")
    reader.page.locator("[data-chain]").nth(1).wait_for()
    reader.click("[data-chain]")
    reader.click('[data-list="inversions"] .card')
    reader.click('[data-list="driven"] .card')
    reader.click('[data-act="realise"]')
    reader.tab.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.own === 6", 40)
    reader.click('[data-panel="points"] summary')
    reader.click('[data-act="add-point"]')
    assert reader.page.evaluate("gruebler.motion.linkage.sizes.points.length") == 1
    reader.plays()
    reader.end("six-bar", 9)


def test_a_watt_six_bar_is_drawn_and_moved(reader):
    reader.click('[data-view="build"]')
    plane = (
        "(([u, v], { left, top }) => [left + u, top + v])(gruebler.views.build.viewport.screen($x, $y),"
        " gruebler.views.build.root.getBoundingClientRect())"
    )
    for tool, places in (
        ("ground", [(0, 0)]),
        ("link", [(0, 0), (0, 20)]),
        ("dyad", [(0, 20), (60, 40), (70, 0)]),
        ("ground", [(70, 0)]),
        ("dyad", [(30, 30), (40, 80), (110, 60)]),
        ("ground", [(110, 60)]),
    ):
        reader.click(f'[data-tool="{tool}"]')
        reader.page.evaluate("window.scrollTo(0, 0)")
        reader.put(plane, *places)
    reader.click('[data-offer="drive"]')
    reader.click('[data-act="move"]')
    reader.tab.until("gruebler.view === 'motion' && gruebler.motion.linkage.model.joints.length === 7", 40)
    # joints keep the letters of the drawing, in the sizes and on the stage
    sizes = reader.page.locator('[data-panel="sizes"] label b').all_text_contents()
    assert {"A–B", "B–C", "B–E", "C–E", "C–D", "A–D"} < set(sizes)
    assert {*"ABCDEFG"} < set(reader.page.locator(".stage text.name").all_text_contents())
    reader.plays()
    reader.end("drawn", 21)


def test_three_positions_are_designed(reader):
    reader.click('[data-view="synthesis"]')
    reader.click('[data-value="positions"]')
    plane = "(({ a, d, e, f }) => [e + a * $x, f - d * $y])(gruebler.root.querySelector('.plane > g').getScreenCTM())"
    reader.put(plane, (-40, 0), (0, 25), (35, 10))
    for number, angle in enumerate((12, 35, 70), 1):
        reader.fill(f'[aria-label$="{number} φ [°]"]', str(angle))
    reader.click('[data-field="crank"]')
    reader.click('[data-act="synthesise"]')
    first = reader.page.locator('[data-list="designs"] .card').first
    first.wait_for(timeout=60_000)
    # their count and the first of them are in sight, under what stays there
    seen = [reader.page.locator(".designs h2").bounding_box(), first.bounding_box()]
    low = reader.page.viewport_size["height"] - 40
    assert all(0 < box["y"] < box["y"] + min(40, box["height"]) < low for box in seen), seen
    if reader.page.viewport_size["width"] < 500:
        bar = reader.page.locator(".doing").bounding_box()
        assert bar["y"] + bar["height"] <= seen[0]["y"] + 1
        reader.page.locator('[data-act="back"]').click()
    assert reader.page.locator('[data-value="points"]').bounding_box()["y"] > 0
    reader.click('[data-list="designs"] .card')
    reader.tab.until("gruebler.view === 'motion' && gruebler.motion.linkage.beside.targets?.length === 3", 40)
    reader.plays()
    reader.end("positions", 12)
    # on the way back all is as it was left: targets, list, the chosen type, the place on the page
    reader.page.go_back()
    reader.tab.until("gruebler.view === 'synthesis'")
    kinds = reader.page.locator('[data-field="form"]')
    total = int(reader.page.locator(".designs h2").inner_text().split()[0])
    everyone, *names = kinds.locator("option").all_inner_texts()
    counts = [total, *(int(name.split()[-1]) for name in names)]
    assert not any(letter.isdigit() for letter in everyone)  # that is said above
    assert counts[0] == sum(counts[1:]) > counts[1]
    cards = reader.page.locator('[data-list="designs"] .card')
    everything = reader.page.locator(".designs .card")  # those much like others, too
    assert everything.count() == total  # as it is said above
    kinds.select_option(index=2)
    assert everything.count() == counts[2]
    cards.last.scroll_into_view_if_needed()
    place = "(view) => window.scrollY + view.scrollTop"
    view = reader.page.locator('[data-page="synthesis"]')
    left = view.evaluate(place)
    assert left > 200
    cards.last.click()
    reader.tab.until("gruebler.view === 'motion'")
    assert reader.page.evaluate("window.scrollY") == 0
    reader.page.go_back()
    reader.tab.until("gruebler.view === 'synthesis'")
    reader.page.wait_for_timeout(300)
    assert everything.count() == counts[2]
    assert reader.page.locator("[data-point]").count() == 3
    assert abs(view.evaluate(place) - left) < 60  # a tap brings its card into sight itself


def test_a_file_of_another_program_is_saved_as_dxf(reader, tmp_path):
    path = write(FourBar(25, 70, 40, 70).linkage(), tmp_path / "leg.linkage2", left_out=[])
    with reader.page.expect_file_chooser() as chosen:
        reader.click('[data-icon="open"]')
    chosen.value.set_files(path)
    reader.tab.until("gruebler.motion.linkage.model.name === 'leg'", 40)
    reader.click('[data-icon="save"]')
    with reader.page.expect_download() as saved:
        reader.click('[data-panel="export"] button:text-is("DXF")')
    assert saved.value.suggested_filename == "leg.dxf"
    reader.end("file", 3)


def test_an_exercise_is_solved_and_marked(reader):
    reader.click('[data-view="exercises"]')
    reader.page.locator("[data-answer]").first.wait_for()
    joints = re.findall(r"[RD]\((\d+(?:-\d+)+)\)", reader.page.locator(".task p").first.inner_text())
    links = {link for joint in joints for link in joint.split("-")}
    g1 = sum(joint.count("-") for joint in joints)
    right = {"n": len(links), "g1": g1, "g2": 0, "F": 3 * (len(links) - 1) - 2 * g1}
    for key, value in right.items():
        reader.fill(f'input[data-answer="{key}"]', str(value))
    if not reader.page.locator("[data-result]").text_content():
        reader.click('[data-act="mark"]')
    reader.page.locator("[data-result].good").wait_for()
    reader.end("exercise", 6)
